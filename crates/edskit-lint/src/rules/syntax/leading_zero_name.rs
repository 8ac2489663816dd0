use super::repeats;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Section, SectionKind};
use std::collections::HashSet;

rule! {
    /// A section's name is not just the numbers of the object
    ///
    /// ## What it does
    /// Reports section names of objects and sub-objects whose numbers are written with leading zeros, `0x`, the `h` of the
    /// manuals, blanks, or another sign that does not belong there. An index below 1000h that is filled up to four digits
    /// is left alone, because python-canopen needs four of them.
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
    for section in odd.filter(|section| !repeated.contains(&section.kind())) {
        let Some(name) = section.kind().canonical_name() else { continue };
        let written = section.name();
        let is_misspelt = section.kind().is_misspelt(section.name_span().slice(context.source()));
        let message = if is_misspelt {
            format!(
                "the name `{written}` is more than the number{}",
                if matches!(section.kind(), SectionKind::SubObject(..)) { "s" } else { "" }
            )
        } else if written.to_ascii_lowercase().contains("0x") {
            format!("the name `{written}` has `0x`")
        } else {
            format!("the name `{written}` has a leading zero")
        };
        report
            .add(section.name_span(), message)
            .help(format!("write `[{name}]`"))
            .safe_fix("Write the short name", vec![Edit::replace(section.name_span(), name)]);
    }
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
        let text = "[1000h]\n[1018 sub1]\n[1018hsub02h]\n[$1001]\n[1003hValue]\n";
        assert_eq!(
            findings(&LEADING_ZERO_NAME, text),
            [
                "1:2 warning: the name `1000h` is more than the number",
                "2:2 warning: the name `1018 sub1` is more than the numbers",
                "3:2 warning: the name `1018hsub02h` is more than the numbers",
                "4:2 warning: the name `$1001` is more than the number",
                "5:2 warning: the name `1003hValue` is more than the number",
            ]
        );
        assert_eq!(fixed(&LEADING_ZERO_NAME, text), "[1000]\n[1018sub1]\n[1018sub2]\n[1001]\n[1003Value]\n");
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
