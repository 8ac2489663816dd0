use super::by_object::by_object;
use super::repeats;
use crate::rule::rule;
use crate::wording::FEW;
use crate::{Context, Edit, Report};
use edskit_model::{Section, SectionKind};
use std::collections::HashSet;

rule! {
    /// A section's name is not just the numbers of the object
    ///
    /// ## What it does
    /// Reports section names of objects and sub-objects whose numbers are written with leading zeros, `0x`, the `h` of the
    /// manuals, blanks, or another sign that does not belong there. An index below 1000h that is filled up to four digits
    /// is left alone, because python-canopen needs four of them. The names of one object are one finding.
    ///
    /// ## Why is this bad
    /// Names are texts, not numbers. Many readers compare them as such, and then do not find the object.
    ///
    /// ## Example
    /// ```eds
    /// [1A00sub0A]
    /// ParameterName=Mapped object 10
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1A00subA]
    /// ParameterName=Mapped object 10
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2 and 4.6.3.2.
    pub(crate) static LEADING_ZERO_NAME = {
        code: "SYN016",
        name: "leading-zero-name",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [CanChkEds("12"), EdsDcfCheck("OBJ011")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let mut odd = context.sheet.sections().filter(|section| is_odd(context, *section)).peekable();
    if odd.peek().is_none() {
        return;
    }
    // A section that stands in two spellings is the matter of SYN015.
    let repeated: HashSet<SectionKind> =
        repeats::of_cia_306(context).map(|(_, again)| again.kind()).collect();
    let odd = odd.filter(|section| !repeated.contains(&section.kind()));
    let named = odd.filter_map(|section| {
        let name = section.kind().canonical_name()?;
        Some((section.kind(), (section, name)))
    });
    for group in by_object(named) {
        report_object(context, &group, report);
    }
}

/// Reports the odd names of one object, or that of another section.
fn report_object(context: &Context<'_>, names: &[(Section<'_>, String)], report: &mut Report) {
    let Some(((first, name), rest)) = names.split_first() else { return };
    let written = first.name();
    let what = if first.kind().is_misspelt(first.name_span().slice(context.source())) {
        let is_sub = matches!(first.kind(), SectionKind::SubObject(..));
        if is_sub { "is more than the numbers" } else { "is more than the number" }
    } else if written.to_ascii_lowercase().contains("0x") {
        "has `0x`"
    } else {
        "has a leading zero"
    };
    let more = match rest.len() {
        0 => String::new(),
        1 => ", and one more name of the object is as odd".to_owned(),
        more => format!(", and {more} more names of the object are as odd"),
    };
    let finding = report.add(first.name_span(), format!("the name `{written}` {what}{more}"));
    for (section, name) in rest.iter().take(FEW) {
        finding.label(section.name_span(), format!("`[{name}]` is meant"));
    }
    let title = if rest.is_empty() { "Write the short name" } else { "Write the short names" };
    let edits = names.iter().map(|(section, name)| Edit::replace(section.name_span(), name.as_str()));
    finding.help(format!("write `[{name}]`")).safe_fix(title, edits.collect());
}

fn is_odd(context: &Context<'_>, section: Section<'_>) -> bool {
    let kind = section.kind();
    // Blanks around the name only make it longer, so most names are done here.
    if !kind.is_alternative_spelling(section.line().section_name(context.source()).slice(context.source())) {
        return false;
    }
    let name = section.name_span().slice(context.source());
    // The second spelling of this section has a rule of its own.
    kind.is_alternative_spelling(name)
        && !section.has_decimal_sub_index()
        && kind != SectionKind::DeviceCommissioning
        && !is_filled_up(kind, name)
}

/// Whether an index below 1000h has four digits, and the rest of the name is as it should be.
fn is_filled_up(kind: SectionKind, name: &[u8]) -> bool {
    let zeros = kind.index().map_or(0, |index| (index.0 | 1).leading_zeros() as usize / 4);
    zeros > 0
        && name.iter().take(zeros).all(|&digit| digit == b'0')
        && kind.canonical_name().is_some_and(|canonical| {
            name.get(zeros..).is_some_and(|rest| rest.eq_ignore_ascii_case(canonical.as_bytes()))
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn every_number_of_a_name_counts() {
        let text =
            "[1018sub01]\n[0x1000]\n[01001]\n[1002sub0x2]\n[M01ModuleInfo]\n[01600Value]\n[1003SUB0A]\n";
        assert_eq!(
            findings(&LEADING_ZERO_NAME, text),
            [
                "1:2 warning: the name `1018sub01` has a leading zero",
                "2:2 warning: the name `0x1000` has `0x`",
                "3:2 warning: the name `01001` has a leading zero",
                "4:2 warning: the name `1002sub0x2` has `0x`",
                "5:2 warning: the name `M01ModuleInfo` has a leading zero",
                "6:2 warning: the name `01600Value` has a leading zero",
                "7:2 warning: the name `1003SUB0A` has a leading zero",
            ]
        );
        assert_eq!(
            fixed(&LEADING_ZERO_NAME, text),
            "[1018sub1]\n[1000]\n[1001]\n[1002sub2]\n[M1ModuleInfo]\n[1600Value]\n[1003subA]\n"
        );
    }

    #[test]
    fn signs_that_do_not_belong_into_a_name() {
        let text = "[1000h]\n[1018 sub1]\n[1019hsub02h]\n[$1001]\n[1003hValue]\n";
        assert_eq!(
            findings(&LEADING_ZERO_NAME, text),
            [
                "1:2 warning: the name `1000h` is more than the number",
                "2:2 warning: the name `1018 sub1` is more than the numbers",
                "3:2 warning: the name `1019hsub02h` is more than the numbers",
                "4:2 warning: the name `$1001` is more than the number",
                "5:2 warning: the name `1003hValue` is more than the number",
            ]
        );
        assert_eq!(fixed(&LEADING_ZERO_NAME, text), "[1000]\n[1018sub1]\n[1019sub2]\n[1001]\n[1003Value]\n");
    }

    #[test]
    fn one_slip_in_all_names_of_an_object_is_one_finding() {
        let text = "[1018h]\n[1018hsub0]\n[1018hsub1]\n[2000 h]\n[2000 h sub1]\n[Index 2001]\n[M1Fixed02000]\n[M1Fixed02000sub1]\n";
        assert_eq!(
            findings(&LEADING_ZERO_NAME, text),
            [
                "1:2 warning: the name `1018h` is more than the number, and 2 more names of the object are as odd",
                "4:2 warning: the name `2000 h` is more than the number, and one more name of the object is as odd",
                "6:2 warning: the name `Index 2001` is more than the number",
                "7:2 warning: the name `M1Fixed02000` has a leading zero",
                "8:2 warning: the name `M1Fixed02000sub1` has a leading zero",
            ]
        );
        assert_eq!(
            fixed(&LEADING_ZERO_NAME, text),
            "[1018]\n[1018sub0]\n[1018sub1]\n[2000]\n[2000sub1]\n[2001]\n[M1Fixed2000]\n[M1Fixed2000sub1]\n"
        );
    }

    #[test]
    fn what_is_fine_or_owned_by_another_rule() {
        for text in [
            "[1000]\n[1018sub0]\n[5]\n[0005]\n[0005sub1]\n[0040sub0]\n[0000]\n",
            "[1018sub1]\n[1018sub01]\n",
            "[DeviceCommissioning]\n",
            "[00x1]\n",
        ] {
            assert_eq!(findings(&LEADING_ZERO_NAME, text), [""; 0], "{text}");
        }
        assert_eq!(findings(&LEADING_ZERO_NAME, "[00005]\n[0006sub01]\n[007]\n[00]\n").len(), 4);
    }
}
