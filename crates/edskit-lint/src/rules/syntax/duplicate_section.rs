use super::repeats;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Section, SectionKind};
use std::collections::HashMap;

rule! {
    /// A section stands twice
    ///
    /// ## What it does
    /// Reports a section whose name has already been used, in whatever case. Both places are shown.
    ///
    /// ## Why is this bad
    /// Readers differ: some refuse the file, some merge the sections, some take the first one, some the last one. So
    /// the same file gives different devices.
    ///
    /// ## Example
    /// ```eds
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// DefaultValue=0
    ///
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// DefaultValue=1000
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// DefaultValue=1000
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static DUPLICATE_SECTION = {
        code: "SYN013",
        name: "duplicate-section",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [CanChkEds("4"), EdsDcfCheck("INI002")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    // Two spellings of one section are the matter of SYN015.
    let same_name =
        |(first, again): &(Section<'_>, Section<'_>)| first.name().eq_ignore_ascii_case(&again.name());
    for (first, again) in repeats::of_cia_306(context).filter(same_name) {
        repeated(first, again, report);
    }
    let mut unknown: HashMap<String, Section<'_>> = HashMap::new();
    for section in context.sheet.sections().filter(|section| section.kind() == SectionKind::Unknown) {
        let first = *unknown.entry(section.name().to_ascii_lowercase()).or_insert(section);
        if first.id() != section.id() {
            repeated(first, section, report);
        }
    }
}

fn repeated(first: Section<'_>, again: Section<'_>, report: &mut Report) {
    report
        .add(again.span(), format!("section `[{}]` stands a second time", again.name()))
        .here("the second one")
        .label(first.span(), "the first one")
        .help("keep one of the two, or give this one the index that was meant");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn case_does_not_matter() {
        assert_eq!(
            findings(&DUPLICATE_SECTION, "[1a00]\n[1A00]\n[1A01]\n[x]\n[X]\n"),
            [
                "2:1 error: section `[1A00]` stands a second time",
                "5:1 error: section `[X]` stands a second time"
            ]
        );
    }
}
