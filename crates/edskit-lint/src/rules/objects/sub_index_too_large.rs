use super::structure::beyond_ff;
use crate::rule::rule;
use crate::wording::count;
use crate::{Context, Report};
use edskit_model::Section;
use edskit_types::Index;

rule! {
    /// A section name has a sub-index above FFh
    ///
    /// ## What it does
    /// Reports sections such as `[2010sub100]`, once for all that follow each other in one object.
    ///
    /// ## Why is this bad
    /// FFh is the highest sub-index, so readers drop the section. Sub-indexes in section names are hexadecimal; most
    /// often they have been counted in decimal, and then those from `sub10` on are wrong too, though nobody notices.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Cell voltages
    /// ObjectType=0x8
    ///
    /// [2010sub99]
    /// ParameterName=Voltage of cell 99
    ///
    /// [2010sub100]
    /// ParameterName=Voltage of cell 100
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Cell voltages
    /// ObjectType=0x8
    ///
    /// [2010sub63]
    /// ParameterName=Voltage of cell 99
    ///
    /// [2010sub64]
    /// ParameterName=Voltage of cell 100
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static SUB_INDEX_TOO_LARGE = {
        code: "OBJ027",
        name: "sub-index-too-large",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [Dcfchk("invalid sub-index")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let mut run: Option<(Section<'_>, Index, usize)> = None;
    for section in context.sheet.sections() {
        run = match (run, beyond_ff(section)) {
            (Some((first, index, count)), Some(next)) if next == index => Some((first, index, count + 1)),
            (ended, next) => {
                if let Some(ended) = ended {
                    add(ended, report);
                }
                next.map(|index| (section, index, 1))
            }
        };
    }
    if let Some(last) = run {
        add(last, report);
    }
}

fn add((first, index, length): (Section<'_>, Index, usize), report: &mut Report) {
    let name = first.name();
    let digits = name
        .to_ascii_lowercase()
        .rsplit_once("sub")
        .map_or_else(String::new, |(_, digits)| digits.to_owned());
    let finding = report.add(
        first.span(),
        format!(
            "`[{name}]` names sub-index {}h of {index}, but FFh is the highest",
            digits.to_ascii_uppercase()
        ),
    );
    if length > 1 {
        finding.here(format!("and {} behind it", count(length - 1, "such section")));
    }
    match digits.parse::<u8>() {
        Ok(decimal) => finding.help(format!(
            "sub-indexes in section names are hexadecimal: {decimal} is written `[{:X}sub{decimal:X}]`",
            index.0
        )),
        Err(_) => finding.help("give the sub-object a sub-index from 0 to FE, in hexadecimal"),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, lint};
    use edskit_model::Datasheet;

    #[test]
    fn one_finding_for_a_run_of_sections() {
        let text = "[2000sub99]\n[2000sub100]\n[2000sub101]\n[2001sub1FF]\n[2001]\n[2001SUB0100]\n[2000subFF]\n[2000submarine]\n[sub100]\n[2000sub]\n";
        assert_eq!(
            findings(&SUB_INDEX_TOO_LARGE, text),
            [
                "2:1 error: `[2000sub100]` names sub-index 100h of 2000h, but FFh is the highest",
                "4:1 error: `[2001sub1FF]` names sub-index 1FFh of 2001h, but FFh is the highest",
                "6:1 error: `[2001SUB0100]` names sub-index 0100h of 2001h, but FFh is the highest"
            ]
        );
        let found = lint(&SUB_INDEX_TOO_LARGE, "a.eds", &Datasheet::parse(text.as_bytes()));
        let help = "sub-indexes in section names are hexadecimal: 100 is written `[2000sub64]`";
        assert_eq!(found[0].help.as_deref(), Some(help));
        assert_eq!(found[0].labels[0].text, "and 1 such section behind it");
    }
}
