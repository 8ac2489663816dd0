use super::parts::{self, Role};
use crate::rule::rule;
use crate::{Context, Report};
use std::collections::HashSet;

rule! {
    /// An object of a module is described, but not listed
    ///
    /// ## What it does
    /// Reports a section `[MxFixed...]` whose index is not in `[MxFixedObjects]`, and a section `[MxSubExt...]` whose
    /// index is not in `[MxSubExtends]`.
    ///
    /// ## Why is this bad
    /// Readers go by the lists, so they never see the section.
    ///
    /// ## Example
    /// ```eds
    /// [M1Fixed2100]
    /// ParameterName=Filter time of the inputs
    /// DataType=0x0006
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [M1FixedObjects]
    /// NrOfEntries=1
    /// 1=0x2100
    ///
    /// [M1Fixed2100]
    /// ParameterName=Filter time of the inputs
    /// DataType=0x0006
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 6.3.
    pub(crate) static MODULE_OBJECT_NOT_LISTED = {
        code: "MOD006",
        name: "module-object-not-listed",
        group: Modules,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("51-55")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for part in parts::of(context) {
        let listed: HashSet<_> = part.items.iter().map(|(index, _)| *index).collect();
        for (index, section) in part.described.iter().filter(|(index, _)| !listed.contains(index)) {
            let list = match part.role {
                Role::Fixed => format!("M{}FixedObjects", part.module),
                Role::Extended => format!("M{}SubExtends", part.module),
            };
            let finding = report
                .add(section.span(), format!("`[{}]` is not listed in `[{list}]`", section.name()))
                .help(format!("add `{}=0x{:04X}` there", part.items.len() + 1, index.0));
            if let Some(list) = part.list {
                finding.label(list.span(), "the list");
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn each_section_is_listed() {
        let text = "[M1FixedObjects]\n1=0x2000\n[M1Fixed2000]\n[M1Fixed2001]\n[M1SubExt2000]\n";
        assert_eq!(
            findings(&MODULE_OBJECT_NOT_LISTED, text),
            [
                "4:1 warning: `[M1Fixed2001]` is not listed in `[M1FixedObjects]`",
                "5:1 warning: `[M1SubExt2000]` is not listed in `[M1SubExtends]`"
            ]
        );
    }
}
