//! PRF: device profiles.

use super::base::Section;
use super::defect::{Defect, once, value};
use super::dictionary::{with_sub_object, without_last_sub_object, without_object};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    vec![
        once("PRF001", "objects of a drive without the number of its profile", |base| {
            base.object(0x6040)?;
            Some(Mutant::of(base).set(base.entry("1000", "DefaultValue")?, "0x00000000"))
        })
        .by_label(),
        object_gone("a drive without a statusword", 0x6041)
            .with_consequence("PDO004", "the PDOs of the drive map it"),
        object_gone("a drive without modes of operation", 0x6060)
            .with_consequence("PDO004", "the PDOs of the drive map it"),
        once("PRF002", "another profile, whose objects are missing", |base| {
            let modular = base.section("SupportedModules").is_some();
            let is_encoder = base.section("1000")?.value("DefaultValue").ends_with("019A");
            let kind = base.entry("1000", "DefaultValue").filter(|_| !modular && !is_encoder)?;
            Some(Mutant::of(base).set(kind, "0x0008019A"))
        }),
        sub_object_gone("no sub-index 01h of the parameters to store", 0x1010),
        sub_object_gone("no sub-index 01h of the error behaviour", 0x1029),
        sub_object_gone("no sub-index 01h of the error history", 0x1003),
        once("PRF003", "an SDO without one of its COB-IDs", |base| {
            Some(without_last_sub_object(base, 0x1200)?.expect(base.object(0x1200)?.header))
        }),
        sub_object_more("a third entry of the default SDO", 0x1200, 3),
        sub_object_more("a seventh communication parameter of a TPDO", 0x1801, 7),
        sub_object_more("a fourth entry of an SDO client", 0x1280, 4),
        once("PRF005", "a drive that calls itself an I/O device", |base| {
            base.object(0x6040)?;
            Some(Mutant::of(base).set(base.entry("1000", "DefaultValue")?, "0x00000191"))
        })
        .by_label(),
        value("PRF005", "a drive that calls itself an encoder", "DefaultValue", is_drive_type, "0x00020196")
            .by_label(),
    ]
}

fn object_gone(kind: &'static str, index: u16) -> Defect {
    once("PRF002", kind, move |base| {
        Some(without_object(base, index)?.expect(base.entry("1000", "DefaultValue")?.line))
    })
}

fn sub_object_gone(kind: &'static str, index: u16) -> Defect {
    once("PRF003", kind, move |base| {
        let object = base.object(index)?;
        let subs = base.sub_objects(index).len();
        let mutant = Mutant::of(base).delete_section(base.sub_object(index, 1)?).expect(object.header);
        Some(mutant.set_too(object.entry("SubNumber")?, &(subs - 1).to_string()))
    })
}

fn sub_object_more(kind: &'static str, index: u16, sub_index: u8) -> Defect {
    once("PRF004", kind, move |base| {
        let entries = [
            "ParameterName=One more",
            "ObjectType=0x7",
            "DataType=0x0005",
            "AccessType=ro",
            "DefaultValue=0",
        ];
        with_sub_object(base, index, sub_index, &entries)
    })
}

fn is_drive_type(section: &Section) -> bool {
    section.name == "1000" && section.value("DefaultValue").ends_with("0192")
}
