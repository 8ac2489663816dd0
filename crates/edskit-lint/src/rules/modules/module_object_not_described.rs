use super::parts;
use crate::rule::rule;
use crate::{Context, Report};
use std::collections::HashSet;

rule! {
    /// An object of a module is not described
    ///
    /// ## What it does
    /// Reports an index in `[MxFixedObjects]` without its section `[MxFixed...]`, one in `[MxSubExtends]` without its
    /// section `[MxSubExt...]`, and sub-objects of a module whose object has no section.
    ///
    /// ## Why is this bad
    /// The module promises an object of which nobody knows the type, the access or the name.
    ///
    /// ## Example
    /// ```eds
    /// [M1FixedObjects]
    /// NrOfEntries=1
    /// 1=0x2100
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
    pub(crate) static MODULE_OBJECT_NOT_DESCRIBED = {
        code: "MOD005",
        name: "module-object-not-described",
        group: Modules,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("51-55")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for part in parts::of(context) {
        let mut reported = HashSet::new();
        let listed = part.items.iter().map(|(index, entry)| (*index, entry.value_span(), true));
        let subs = part.subs.iter().map(|(index, section)| (*index, section.span(), false));
        for (index, span, is_listed) in listed.chain(subs) {
            if part.describes(index) || !reported.insert(index) {
                continue;
            }
            let name = part.role.section_name(part.module, index);
            let what = if is_listed { "is listed" } else { "has sub-objects" };
            report
                .add(
                    span,
                    format!("{index} of module {} {what}, but there is no section `[{name}]`", part.module),
                )
                .help(format!("add the section `[{name}]`"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn each_listed_object_has_a_section() {
        let text = "[M1FixedObjects]\n1=0x2000\n2=0x2001\n[M1Fixed2000]\n[M1Fixed2001sub1]\n[M1Fixed2002sub1]\n[M1Fixed2002sub2]\n[M2SubExtends]\n1=0x6000\n2=0x6100\n[M2SubExt6100]\n";
        assert_eq!(
            findings(&MODULE_OBJECT_NOT_DESCRIBED, text),
            [
                "3:3 error: 2001h of module 1 is listed, but there is no section `[M1Fixed2001]`",
                "6:1 error: 2002h of module 1 has sub-objects, but there is no section `[M1Fixed2002]`",
                "9:3 error: 6000h of module 2 is listed, but there is no section `[M2SubExt6000]`"
            ]
        );
    }
}
