use crate::listing::{Item, List};
use crate::rule::rule;
use crate::wording::{FEW, few};
use crate::{Context, Report};
use edskit_types::{Index, ObjectArea};
use std::collections::HashSet;

rule! {
    /// An object is listed as mandatory that CANopen does not demand
    ///
    /// ## What it does
    /// Reports objects of the communication profile in `[MandatoryObjects]` other than 1000h, 1001h and 1018h, all in
    /// one finding. Objects of device profiles are left alone: their profile may demand them.
    ///
    /// ## Why is this bad
    /// Nothing breaks, but the list is for what every CANopen device has. Some checkers accept only these three
    /// objects there.
    ///
    /// ## Example
    /// ```eds
    /// [MandatoryObjects]
    /// SupportedObjects=4
    /// 1=0x1000
    /// 2=0x1001
    /// 3=0x1018
    /// 4=0x1017
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [MandatoryObjects]
    /// SupportedObjects=3
    /// 1=0x1000
    /// 2=0x1001
    /// 3=0x1018
    ///
    /// [OptionalObjects]
    /// SupportedObjects=1
    /// 1=0x1017
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.1.
    pub(crate) static EXTRA_MANDATORY = {
        code: "LST009",
        name: "extra-mandatory",
        group: Lists,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("28"), Dcfchk("object is not mandatory")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let is_extra = |item: &&Item| {
        item.index.is_some_and(|index| {
            index.area() == ObjectArea::Communication && List::of(index) == Some(List::Optional)
        })
    };
    let mut extra: Vec<&Item> = context.listing().items_of(List::Mandatory).iter().filter(is_extra).collect();
    if !extra.is_empty() {
        // What the optional list names, too, is the matter of LST006.
        let optional = context.listing().items_of(List::Optional).iter().filter_map(|item| item.index);
        let optional: HashSet<Index> = optional.collect();
        extra.retain(|item| item.index.is_none_or(|index| !optional.contains(&index)));
    }
    let Some(first) = extra.first() else { return };
    let indices: Vec<Index> = extra.iter().filter_map(|item| item.index).collect();
    let verb = if indices.len() == 1 { "is" } else { "are" };
    let document = context.document();
    let message = format!(
        "{} {verb} listed as mandatory, but not every device needs to have {}",
        few(indices.iter()),
        if indices.len() == 1 { "it" } else { "them" }
    );
    let finding = report.add(first.value_span(document), message);
    for item in extra.iter().take(FEW).skip(1) {
        finding.label(item.value_span(document), "this one, too");
    }
    finding.help("list other objects than 1000h, 1001h and 1018h in `[OptionalObjects]`");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn only_the_communication_profile_is_looked_at() {
        assert_eq!(
            findings(
                &EXTRA_MANDATORY,
                "[MandatoryObjects]\n1=0x1000\n2=0x1005\n3=0x1008\n4=0x6040\n5=0x2000\n"
            ),
            ["3:3 info: 1005h and 1008h are listed as mandatory, but not every device needs to have them"]
        );
        assert!(findings(&EXTRA_MANDATORY, "[OptionalObjects]\n1=0x1005\n").is_empty());
        let twice = "[MandatoryObjects]\n1=0x1005\n[OptionalObjects]\n1=0x1005\n";
        assert!(findings(&EXTRA_MANDATORY, twice).is_empty());
    }
}
