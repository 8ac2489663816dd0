use crate::rule::rule;
use crate::wording::few;
use crate::{Context, Edit, Report};
use edskit_model::Object;

rule! {
    /// Sub-objects are numbered in decimal
    ///
    /// ## What it does
    /// Reports an object whose sub-objects go on with `sub10` after `sub9`, where sub-index 00h counts them only if
    /// these names are read in decimal.
    ///
    /// ## Why is this bad
    /// The sub-index in a name is hexadecimal: `sub10` is sub-index 16. The device has it at 10, so masters read and
    /// write past it.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Inputs
    /// ObjectType=0x8
    /// SubNumber=11
    ///
    /// [2010sub0]
    /// DataType=0x0005
    /// DefaultValue=10
    ///
    /// [2010sub1]
    /// [2010sub2]
    /// [2010sub3]
    /// [2010sub4]
    /// [2010sub5]
    /// [2010sub6]
    /// [2010sub7]
    /// [2010sub8]
    /// [2010sub9]
    /// [2010sub10]
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Inputs
    /// ObjectType=0x8
    /// SubNumber=11
    ///
    /// [2010sub0]
    /// DataType=0x0005
    /// DefaultValue=10
    ///
    /// [2010sub1]
    /// [2010sub2]
    /// [2010sub3]
    /// [2010sub4]
    /// [2010sub5]
    /// [2010sub6]
    /// [2010sub7]
    /// [2010sub8]
    /// [2010sub9]
    /// [2010subA]
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static DECIMAL_SUB_INDEX = {
        code: "OBJ028",
        name: "decimal-sub-index",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Object(check),
    }
}

fn check(context: &Context<'_>, object: Object<'_>, report: &mut Report) {
    if !context.sheet.has_decimal_sub_indices() {
        return;
    }
    let subs = object.sub_objects().filter(|sub| sub.section().has_decimal_sub_index());
    let named: Vec<_> = subs.filter_map(|sub| Some((sub, sub.section().kind().canonical_name()?))).collect();
    let Some(((first, right), rest)) = named.split_first() else { return };
    let index = object.index();
    let name = first.section().name();
    let digits = name.to_ascii_lowercase().rsplit_once("sub").map(|(_, digits)| digits.to_owned());
    let read = match digits {
        Some(digits) if digits.len() <= 2 => format!("sub-index {digits}h of {index}"),
        _ => format!("no sub-index of {index}"),
    };
    let count = named.last().map_or(0, |(sub, _)| sub.sub_index().0);
    let meant = first.sub_index().0;
    let message = format!("`[{name}]` is {read}, but the count of {count} fits only if it is {meant}");
    let finding = report.add(first.section().span(), message);
    finding.here(format!("`[{right}]` is meant"));
    for (sub, name) in rest.iter().take(crate::wording::FEW) {
        finding.label(sub.section().span(), format!("`[{name}]` is meant"));
    }
    let names = named.iter().map(|(_, name)| format!("`[{name}]`"));
    finding.help(format!("sub-indices in names are hexadecimal: write {}", few(names)));
    let mut edits: Vec<Edit> =
        named.iter().map(|(sub, name)| Edit::replace(sub.section().name_span(), name.as_str())).collect();
    edits.sort_by_key(|edit| edit.span);
    finding.unsafe_fix("Write the sub-indices in hexadecimal", edits);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn object(index: &str, code: u8, count: &str, names: &[&str]) -> String {
        let mut text =
            format!("[{index}]\nObjectType={code}\n[{index}sub0]\nDataType=5\nDefaultValue={count}\n");
        for name in names {
            text += &format!("[{index}sub{name}]\n");
        }
        text
    }

    const NINE: [&str; 9] = ["1", "2", "3", "4", "5", "6", "7", "8", "9"];

    #[test]
    fn the_count_decides() {
        let eleven = [&NINE[..], &["10", "11"]].concat();
        for (index, code) in [("6401", 8), ("2000", 9), ("1A00", 9)] {
            let text = object(index, code, "11", &eleven);
            assert_eq!(
                findings(&DECIMAL_SUB_INDEX, &text),
                [format!(
                    "15:1 error: `[{index}sub10]` is sub-index 10h of {index}h, but the count of 11 fits only if it is 10"
                )]
            );
            let mended = text.replace("sub10", "subA").replace("sub11", "subB");
            assert_eq!(fixed(&DECIMAL_SUB_INDEX, &text), mended);
            for count in ["17", "0x11", "9", "4", "", "x"] {
                assert_eq!(
                    findings(&DECIMAL_SUB_INDEX, &object(index, code, count, &eleven)),
                    [""; 0],
                    "{count}"
                );
            }
        }
        let names: Vec<String> = (1..=21).map(|number: u8| number.to_string()).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        assert_eq!(findings(&DECIMAL_SUB_INDEX, &object("2000", 8, "0x15", &names)).len(), 1);
        let mended = fixed(&DECIMAL_SUB_INDEX, &object("2000", 8, "21", &names));
        assert!(mended.ends_with("[2000sub13]\n[2000sub14]\n[2000sub15]\n"), "{mended}");
    }

    #[test]
    fn an_array_that_really_goes_on_is_no_case() {
        let hex = [&NINE[..], &["A", "B", "C", "D", "E", "F", "10"]].concat();
        assert_eq!(findings(&DECIMAL_SUB_INDEX, &object("2000", 8, "16", &hex)), [""; 0]);
        let gap = [&NINE[..8], &["10"]].concat();
        assert_eq!(findings(&DECIMAL_SUB_INDEX, &object("2000", 8, "10", &gap)), [""; 0]);
    }
}
