//! DCF: device configuration files.

use super::base::{Kind, Section};
use super::defect::{Defect, added, header, missing, once, value};
use super::dictionary::without_object;
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [commissioning(), entries_of_eds(), configured()].into_iter().flatten().collect()
}

fn commissioning() -> Vec<Defect> {
    vec![
        once("DCF001", "a DCF without `[DeviceComissioning]`", |base| {
            let section = base.section(COMMISSIONING)?;
            Some(Mutant::of(base).delete_section(section).expect_first())
        }),
        once("DCF001", "an EDS with `[DeviceComissioning]`", |base| {
            let line = base.section("DummyUsage").filter(|_| base.kind == Kind::Eds)?.header;
            let entries = [
                "NodeID=5",
                "NodeName=Five",
                "Baudrate=250",
                "NetNumber=1",
                "NetworkName=Line",
                "LSS_SerialNumber=0",
            ];
            Some(Mutant::of(base).insert_section(line, COMMISSIONING, &entries))
        }),
        header("DCF002", "`[DeviceCommissioning]` with two m", is_commissioning, |_| {
            "[DeviceCommissioning]".to_owned()
        }),
        value("DCF003", "a node-ID of 0", "NodeID", is_commissioning, "0"),
        value("DCF003", "a node-ID of 128", "NodeID", is_commissioning, "128"),
        value("DCF003", "a node-ID that is not set yet", "NodeID", is_commissioning, "255"),
        value("DCF004", "a bit rate of 100 kbit/s", "Baudrate", is_commissioning, "100"),
        value("DCF004", "a bit rate in bit/s", "Baudrate", is_commissioning, "50000"),
        value("DCF004", "a bit rate that the device does not support", "Baudrate", is_commissioning, "800"),
        once("DCF004", "the device does not support the bit rate any more", |base| {
            base.section(COMMISSIONING)?;
            Some(Mutant::of(base).set(base.entry("DeviceInfo", "BaudRate_250")?, "0"))
        })
        .by_label(),
        missing("DCF011", "no NodeID", "NodeID", is_commissioning),
        missing("DCF011", "no Baudrate", "Baudrate", is_commissioning),
        missing("DCF011", "no NetworkName", "NetworkName", is_commissioning),
        missing("DCF011", "no LSS_SerialNumber", "LSS_SerialNumber", is_commissioning),
        value("DCF011", "an empty NodeID", "NodeID", is_commissioning, ""),
        value("DCF010", "another serial number than in 1018h", "LSS_SerialNumber", has_serial_number, "999"),
        once("DCF009", "a manager without NMT startup", |base| {
            let manager = base.entry(COMMISSIONING, "CANopenManager")?;
            let mutant =
                if base.object(0x1F80).is_some() { without_object(base, 0x1F80)? } else { Mutant::of(base) };
            Some(mutant.set(manager, "1"))
        }),
    ]
}

fn entries_of_eds() -> Vec<Defect> {
    vec![
        in_eds("a ParameterValue in an EDS", "ParameterValue=1"),
        in_eds("a Denotation in an EDS", "Denotation=Left"),
        in_eds("a ParamRefd in an EDS", "ParamRefd=A1"),
        Defect::new("DCF005", "values of compact sub-objects in an EDS", |base| {
            let objects = base
                .sections_where(|section| base.kind == Kind::Eds && section.entry("CompactSubObj").is_some());
            let name = |section: &Section| format!("{}Value", section.name);
            let list = |section: &Section| {
                Mutant::of(base).append_section(&name(section), &["NrOfEntries=1", "1=5"])
            };
            objects.into_iter().map(list).collect()
        }),
        Defect::new("DCF005", "connected modules in an EDS", |base| {
            let is_info = |section: &Section| base.kind == Kind::Eds && section.name.ends_with("ModuleInfo");
            let infos = base.sections_where(is_info).into_iter();
            let entries = ["NrOfEntries=1", "1=1"];
            infos
                .map(|info| Mutant::of(base).insert_section(info.header, "ConnectedModules", &entries))
                .collect()
        }),
    ]
}

fn in_eds(kind: &'static str, line: &'static str) -> Defect {
    Defect::new("DCF005", kind, move |base| {
        let sections = base.sections_where(|section| base.kind == Kind::Eds && is_writable_number(section));
        sections.into_iter().map(|section| Mutant::of(base).insert(section.behind_entries(), line)).collect()
    })
}

fn configured() -> Vec<Defect> {
    vec![
        Defect::new("DCF006", "a configured value of a constant", |base| {
            let is_constant = |section: &Section| {
                base.kind == Kind::Dcf
                    && section.is_variable()
                    && section.value("AccessType") == "const"
                    && section.number("DefaultValue").is_some()
            };
            let sections = base.sections_where(is_constant).into_iter();
            sections
                .map(|section| Mutant::of(base).insert(section.behind_entries(), "ParameterValue=9"))
                .collect()
        }),
        Defect::new("DCF006", "a configured product code", |base| {
            let sections =
                base.sections_where(|section| base.kind == Kind::Dcf && section.name == "1018sub2");
            sections
                .into_iter()
                .map(|section| Mutant::of(base).insert(section.behind_entries(), "ParameterValue=9"))
                .collect()
        }),
        added("DCF007", "a DownloadFile of a number", is_configured_number, "DownloadFile=motion.tab"),
        value("DCF007", "a DownloadFile that does not exist", "DownloadFile", |_| true, "lost.tab"),
        value(
            "DCF007",
            "a DownloadFile of an object that cannot be written",
            "AccessType",
            has_download,
            "ro",
        )
        .by_label(),
        Defect::new("DCF007", "an UploadFile of an object that cannot be read", |base| {
            let sections = base.sections_where(has_download).into_iter();
            let changed = sections.filter_map(|section| {
                let line = section.entry("DownloadFile")?.line;
                let mutant = Mutant::of(base).rewrite(line, "UploadFile=motion.tab");
                Some(mutant.set_too(section.entry("AccessType")?, "wo"))
            });
            changed.collect()
        }),
        value("DCF008", "the COB-ID of another node", "ParameterValue", is_own_pdo, "0x207"),
        value("DCF008", "the COB-ID of another node's TPDO", "ParameterValue", is_own_tpdo, "0x40000187"),
        once("DCF008", "an EMCY message of another node", |base| {
            let emcy = base.section("1014").filter(|_| base.kind == Kind::Dcf)?;
            Some(Mutant::of(base).insert(emcy.behind_entries(), "ParameterValue=0x87"))
        }),
        once("DCF008", "another node-ID than in the COB-IDs", |base| {
            base.entry("1400sub1", "ParameterValue")?;
            Some(Mutant::of(base).set(base.entry(COMMISSIONING, "NodeID")?, "9"))
        })
        .by_label(),
    ]
}

const COMMISSIONING: &str = "DeviceComissioning";

fn is_commissioning(section: &Section) -> bool {
    section.name == COMMISSIONING
}

fn has_serial_number(section: &Section) -> bool {
    is_commissioning(section) && section.number("LSS_SerialNumber") != Some(0)
}

fn is_writable_number(section: &Section) -> bool {
    section.is_variable() && section.value("AccessType") == "rw" && section.is_type(6)
}

fn is_configured_number(section: &Section) -> bool {
    is_writable_number(section) && section.entry("ParameterValue").is_some()
}

fn has_download(section: &Section) -> bool {
    section.entry("DownloadFile").is_some()
}

fn is_own_pdo(section: &Section) -> bool {
    section.name == "1400sub1"
}

fn is_own_tpdo(section: &Section) -> bool {
    section.name == "1800sub1"
}
