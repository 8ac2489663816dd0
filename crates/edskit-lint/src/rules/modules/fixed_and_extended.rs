use super::parts::{self, Role};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::Span;
use edskit_types::Index;
use std::collections::HashMap;

rule! {
    /// An object is brought by one module and extended by another
    ///
    /// ## What it does
    /// Reports an index that stands both in `[MxFixedObjects]` and in `[MxSubExtends]`, of the same module or of two.
    ///
    /// ## Why is this bad
    /// A fixed object is there once, whatever modules are plugged in. An extended one grows with each module. The
    /// same object cannot do both.
    ///
    /// ## Example
    /// ```eds
    /// [M1FixedObjects]
    /// NrOfEntries=1
    /// 1=0x6000
    ///
    /// [M2SubExtends]
    /// NrOfEntries=1
    /// 1=0x6000
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [M1SubExtends]
    /// NrOfEntries=1
    /// 1=0x6000
    ///
    /// [M2SubExtends]
    /// NrOfEntries=1
    /// 1=0x6000
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 6.3.
    pub(crate) static FIXED_AND_EXTENDED = {
        code: "MOD004",
        name: "fixed-and-extended",
        group: Modules,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("51-55")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let parts = parts::of(context);
    let mut fixed: HashMap<Index, (u16, Span)> = HashMap::new();
    for part in parts.iter().filter(|part| part.role == Role::Fixed) {
        for (index, span) in part.objects() {
            fixed.entry(index).or_insert((part.module, span));
        }
    }
    for part in parts.iter().filter(|part| part.role == Role::Extended) {
        for (index, span) in part.objects() {
            let Some((other, first)) = fixed.get(&index) else { continue };
            report
                .add(
                    span,
                    format!(
                        "module {} extends {index}, but module {other} brings it as a fixed object",
                        part.module
                    ),
                )
                .label(*first, "fixed")
                .help("let all modules extend it, or give the fixed object another index");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn of_one_module_or_of_two() {
        let text = "[M1FixedObjects]\n1=0x2000\n2=0x2001\n[M1SubExtends]\n1=0x2000\n[M2SubExt2001]\n[M2SubExt2002]\n";
        assert_eq!(
            findings(&FIXED_AND_EXTENDED, text),
            [
                "5:1 error: module 1 extends 2000h, but module 1 brings it as a fixed object",
                "6:1 error: module 2 extends 2001h, but module 1 brings it as a fixed object"
            ]
        );
    }
}
