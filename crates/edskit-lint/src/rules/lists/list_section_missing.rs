use super::edits;
use crate::listing::List;
use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::wording::{few, series};
use crate::{Context, Edit, Report, Severity};
use edskit_types::Index;

rule! {
    /// A list of objects is missing
    ///
    /// ## What it does
    /// Reports which of the sections `[MandatoryObjects]`, `[OptionalObjects]` and `[ManufacturerObjects]` the file
    /// lacks, all in one finding. Without the first one it is an error.
    ///
    /// ## Why is this bad
    /// All three are mandatory, a list without objects says `SupportedObjects=0`. Readers that load the objects of
    /// the lists refuse the file, or do not see the objects that should be in the missing one.
    ///
    /// ## Example
    /// ```eds
    /// [MandatoryObjects]
    /// SupportedObjects=1
    /// 1=0x1000
    ///
    /// [OptionalObjects]
    /// SupportedObjects=0
    ///
    /// [1000]
    /// ParameterName=Device type
    ///
    /// [2000]
    /// ParameterName=Speed
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [MandatoryObjects]
    /// SupportedObjects=1
    /// 1=0x1000
    ///
    /// [OptionalObjects]
    /// SupportedObjects=0
    ///
    /// [ManufacturerObjects]
    /// SupportedObjects=1
    /// 1=0x2000
    ///
    /// [1000]
    /// ParameterName=Device type
    ///
    /// [2000]
    /// ParameterName=Speed
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.1.
    pub(crate) static LIST_SECTION_MISSING = {
        code: "LST001",
        name: "list-section-missing",
        group: Lists,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("1"), EdsDcfCheck("MND001")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let is_absent =
        |list: &List| list.section(context.sheet).is_none() && !lost_header::hides(context, list.kind());
    let absent: Vec<List> = List::ALL.into_iter().filter(is_absent).collect();
    if absent.is_empty() {
        return;
    }
    let names: Vec<String> = absent.iter().map(|list| format!("`[{}]`", list.name())).collect();
    let finding = report.add(context.start(), format!("the file has no section {}", series(&names, "or")));
    if absent.contains(&List::Mandatory) {
        finding.severity(Severity::Error);
    }
    let lacking: Vec<(List, Vec<Index>)> =
        absent.iter().map(|&list| (list, context.listing().unlisted(context.sheet, list))).collect();
    let advice: Vec<String> = lacking.iter().map(|(list, indices)| advice(*list, indices)).collect();
    finding.help(format!("add {}", series(&advice, "and")));
    // A list without the mandatory objects would only be another error.
    if lacking.iter().any(|(list, indices)| *list == List::Mandatory && indices.is_empty()) {
        return;
    }
    let edits = vec![insertion(context, &lacking)];
    if lacking.iter().all(|(_, indices)| indices.is_empty()) {
        finding.safe_fix("Add the empty list", edits);
    } else {
        finding.unsafe_fix("Add the list with the objects that are described", edits);
    }
}

fn advice(list: List, indices: &[Index]) -> String {
    let section = format!("`[{}]` with `SupportedObjects={}`", list.name(), indices.len());
    if indices.is_empty() { section } else { format!("{section} for {}", few(indices.iter())) }
}

/// The missing lists, behind the last list that is there or at the end of the file.
fn insertion(context: &Context<'_>, lacking: &[(List, Vec<Index>)]) -> Edit {
    let present = List::ALL.into_iter().filter_map(|list| list.section(context.sheet));
    let last = present.map(|section| section.end().start).max();
    let offset = last.unwrap_or(context.document().end().start);
    let ending = context.document().line_ending().as_str();
    let mut text = String::new();
    for (list, indices) in lacking {
        text.push_str(&format!(
            "{ending}{ending}[{}]{ending}SupportedObjects={}",
            list.name(),
            indices.len()
        ));
        text.push_str(&edits::items(context, 0, indices));
    }
    Edit::insert(offset, text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed, lint};
    use crate::{Applicability, FileKind};
    use edskit_model::Datasheet;

    #[test]
    fn absent_lists_come_in_one_finding() {
        assert_eq!(
            findings(&LIST_SECTION_MISSING, "[FileInfo]\n"),
            [
                "1:1 error: the file has no section `[MandatoryObjects]`, `[OptionalObjects]` or `[ManufacturerObjects]`"
            ]
        );
        let text = "[MandatoryObjects]\n[OptionalObjects]\n[manufacturerobjects]\n";
        assert!(findings(&LIST_SECTION_MISSING, text).is_empty());
    }

    #[test]
    fn an_empty_list_is_safe_and_others_are_filled() {
        let text =
            "[MandatoryObjects]\nSupportedObjects=0\n[OptionalObjects]\nSupportedObjects=0\n\n[1017]\n";
        assert_eq!(
            fixed(&LIST_SECTION_MISSING, text),
            "[MandatoryObjects]\nSupportedObjects=0\n[OptionalObjects]\nSupportedObjects=0\n\n[ManufacturerObjects]\nSupportedObjects=0\n\n[1017]\n"
        );
        let findings = lint(&LIST_SECTION_MISSING, "a.eds", &Datasheet::parse(text.as_bytes()));
        assert_eq!(findings[0].fix.as_ref().unwrap().applicability, Applicability::Safe);
        assert_eq!(
            fixed(&LIST_SECTION_MISSING, "[1000]\n[1017]\n[2000]\n[1008]"),
            "[1000]\n[1017]\n[2000]\n[1008]\n\n[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n\n[OptionalObjects]\nSupportedObjects=2\n1=0x1008\n2=0x1017\n\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000"
        );
    }

    #[test]
    fn a_node_list_has_no_objects() {
        assert!(!LIST_SECTION_MISSING.files.contains(&FileKind::Cpj));
    }
}
