use crate::rule::rule;
use crate::{Context, FileKind, Report};
use edskit_model::{KeyName, SectionKind, Span};

rule! {
    /// An EDS holds what belongs into a DCF
    ///
    /// ## What it does
    /// Reports entries with a value that only a device configuration file has: `ParameterValue`, `Denotation`,
    /// `UploadFile`, `DownloadFile`, `ParamRefd`, and the sections `[xxxxValue]`, `[xxxxDenotation]` and
    /// `[ConnectedModules]`. There is one finding for each kind.
    ///
    /// ## Why is this bad
    /// An EDS describes every device of a type, a DCF one device in its network. Readers of an EDS ignore these
    /// entries, so the values in them are lost; or they take them for the defaults of the device.
    ///
    /// ## Example
    /// ```eds
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// DataType=0x0006
    /// AccessType=rw
    /// DefaultValue=0
    /// ParameterValue=500
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// DataType=0x0006
    /// AccessType=rw
    /// DefaultValue=500
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 5.3.
    pub(crate) static DCF_ENTRY_IN_EDS = {
        code: "DCF005",
        name: "dcf-entry-in-eds",
        group: Configuration,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

/// How many places are shown besides the first one.
const SHOWN: usize = 3;

const KEYS: [KeyName; 5] = [
    KeyName::ParameterValue,
    KeyName::Denotation,
    KeyName::UploadFile,
    KeyName::DownloadFile,
    KeyName::ParamRefd,
];

fn check(context: &Context<'_>, report: &mut Report) {
    // With commissioning data it is a DCF that is called .eds (DCF001).
    if context.kind != FileKind::Eds || context.sheet.commissioning().is_some() {
        return;
    }
    let mut places: [Vec<Span>; KEYS.len()] = Default::default();
    for entry in context.sheet.entries() {
        if let Some(position) = KEYS.iter().position(|key| *key == entry.key().name)
            && !entry.is_empty()
        {
            places[position].push(entry.span());
        }
    }
    for (key, places) in KEYS.iter().zip(&places) {
        let [first, others @ ..] = &places[..] else { continue };
        let key = key.spelling();
        let message = match others.len() {
            0 => format!("the EDS has a `{key}`, which belongs into a DCF"),
            count => format!("the EDS has {} entries `{key}`, which belong into a DCF", count + 1),
        };
        let finding = report.add(*first, message);
        for place in others.iter().take(SHOWN) {
            finding.label(*place, "");
        }
        let help = match key {
            "ParameterValue" => "write `DefaultValue` if it is that of each device, or name the file .dcf",
            _ => "take it out, or name the file .dcf",
        };
        finding.help(help);
    }
    for section in context.sheet.other_sections() {
        let is_of_dcf = matches!(
            section.kind(),
            SectionKind::CompactValues(_)
                | SectionKind::CompactDenotations(_)
                | SectionKind::ConnectedModules
        );
        if is_of_dcf {
            let message = format!("the EDS has a section `[{}]`, which belongs into a DCF", section.name());
            report.add(section.span(), message).help("take it out, or name the file .dcf");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};

    #[test]
    fn one_finding_for_each_kind() {
        let text = "[1017]\nParameterValue=1\nDenotation=\n[1018sub1]\nParameterValue=5\nUploadFile=a.bin\n[2000Value]\nNrOfEntries=0\n[ConnectedModules]\n";
        assert_eq!(
            findings(&DCF_ENTRY_IN_EDS, text),
            [
                "2:1 warning: the EDS has 2 entries `ParameterValue`, which belong into a DCF",
                "6:1 warning: the EDS has a `UploadFile`, which belongs into a DCF",
                "7:1 warning: the EDS has a section `[2000Value]`, which belongs into a DCF",
                "9:1 warning: the EDS has a section `[ConnectedModules]`, which belongs into a DCF"
            ]
        );
        assert!(findings_in(&DCF_ENTRY_IN_EDS, "a.dcf", text.as_bytes()).is_empty());
        assert!(findings(&DCF_ENTRY_IN_EDS, &format!("{text}[DeviceComissioning]\n")).is_empty());
    }
}
