use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_types::Index;

rule! {
    /// An object has an index that is reserved
    ///
    /// ## What it does
    /// Reports a described object at 0000h, 0026h to 003Fh, 0260h to 0FFFh, or from C000h on. The objects 1004h, 100Bh,
    /// 100Eh and 100Fh, which editions before CiA 301 v4 had, are an info.
    ///
    /// ## Why is this bad
    /// CiA 301 keeps these indices for later editions. A tool that knows such an edition takes the object for another
    /// one. Often a digit of the index is wrong.
    ///
    /// ## Example
    /// ```eds
    /// [C100]
    /// ParameterName=Speed
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2100]
    /// ParameterName=Speed
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.4.1.
    pub(crate) static RESERVED_INDEX = {
        code: "LST010",
        name: "reserved-index",
        group: Lists,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

const RESERVED: [(u16, u16); 4] = [(0, 0), (0x0026, 0x003F), (0x0260, 0x0FFF), (0xC000, 0xFFFF)];

const OBSOLETE: [(Index, &str); 4] = [
    (Index(0x1004), "the number of PDOs"),
    (Index(0x100B), "the node-ID"),
    (Index(0x100E), "the COB-ID of node guarding"),
    (Index(0x100F), "the number of SDOs"),
];

fn check(context: &Context<'_>, report: &mut Report) {
    for (first, last) in RESERVED {
        for object in context.sheet.objects_in(Index(first)..=Index(last)) {
            let finding = report.add(object.name_span(), format!("{} is reserved", object.index()));
            finding.here(format!("CiA 301 keeps {} for later", range(first, last)));
            finding.help(
                "give the object an index of the manufacturer, 2000h to 5FFFh, or the one that was meant",
            );
        }
    }
    for (index, meaning) in OBSOLETE {
        if let Some(object) = context.sheet.object(index) {
            report
                .add(object.name_span(), format!("{index} is obsolete"))
                .severity(Severity::Info)
                .here(format!("it was {meaning} before CiA 301 v4"))
                .help("leave the object out if the device can do without it");
        }
    }
}

fn range(first: u16, last: u16) -> String {
    if first == last { Index(first).to_string() } else { format!("{} to {}", Index(first), Index(last)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn ranges_are_exact() {
        let text = "[0000]\n[0025]\n[0026]\n[003F]\n[0040]\n[025F]\n[0260]\n[0FFF]\n[1000]\n[BFFF]\n[C000]\n";
        assert_eq!(
            findings(&RESERVED_INDEX, text),
            [
                "1:2 warning: 0000h is reserved",
                "3:2 warning: 0026h is reserved",
                "4:2 warning: 003Fh is reserved",
                "7:2 warning: 0260h is reserved",
                "8:2 warning: 0FFFh is reserved",
                "11:2 warning: C000h is reserved"
            ]
        );
    }

    #[test]
    fn objects_of_the_past_are_an_info() {
        assert_eq!(findings(&RESERVED_INDEX, "[100B]\n[100C]\n"), ["1:2 info: 100Bh is obsolete"]);
    }
}
