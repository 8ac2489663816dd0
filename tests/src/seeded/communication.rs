//! COM: the communication profile of CiA 301.

use super::base::{Base, Section};
use super::defect::{Defect, once, value};
use super::dictionary::{also_listed, with_sub_object, without_object};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [attributes(), error_history(), sync(), emcy(), error_control(), identity(), sdo(), values()]
        .into_iter()
        .flatten()
        .collect()
}

fn attributes() -> Vec<Defect> {
    vec![
        value(
            "COM001",
            "a heartbeat time that is a DOMAIN",
            "ObjectType",
            |section| section.name == "1017",
            "0x2",
        ),
        value(
            "COM001",
            "an error register that is a DOMAIN",
            "ObjectType",
            |section| section.name == "1001",
            "0x2",
        ),
        value("COM002", "a device type with a sign", "DataType", |section| section.name == "1000", "0x0004"),
        value(
            "COM002",
            "an error register with a sign",
            "DataType",
            |section| section.name == "1001",
            "0x0002",
        ),
        value(
            "COM002",
            "a heartbeat time of 32 bits",
            "DataType",
            |section| section.name == "1017",
            "0x0007",
        ),
        value(
            "COM002",
            "a vendor-ID with a sign",
            "DataType",
            |section| section.name == "1018sub1",
            "0x0004",
        ),
        value(
            "COM002",
            "a monitored heartbeat with a sign",
            "DataType",
            |section| section.name == "1016sub1",
            "0x0004",
        ),
        value("COM002", "a COB-ID of a PDO with a sign", "DataType", is_pdo_cob_id, "0x0004"),
        value("COM002", "an inhibit time of 8 bits", "DataType", is_inhibit_time, "0x0005"),
        value("COM002", "a mapped object with a sign", "DataType", is_mapping_entry, "0x0004"),
        value(
            "COM002",
            "a device name that is a number",
            "DataType",
            |section| section.name == "1008",
            "0x0007",
        )
        .with_consequence("SYN017", "the text is no number of the new type"),
        value(
            "COM003",
            "a device type that can be written",
            "AccessType",
            |section| section.name == "1000",
            "rw",
        ),
        value(
            "COM003",
            "an error register that can be written",
            "AccessType",
            |section| section.name == "1001",
            "rw",
        ),
        value(
            "COM003",
            "a vendor-ID that can be written",
            "AccessType",
            |section| section.name == "1018sub1",
            "rw",
        ),
        value(
            "COM003",
            "a heartbeat time that cannot be read",
            "AccessType",
            |section| section.name == "1017",
            "wo",
        ),
        value(
            "COM003",
            "a cycle period that cannot be written",
            "AccessType",
            |section| section.name == "1006",
            "ro",
        ),
    ]
}

fn error_history() -> Vec<Defect> {
    vec![
        value(
            "COM004",
            "an error history that cannot be cleared",
            "AccessType",
            |section| section.name == "1003sub0",
            "ro",
        ),
        value("COM004", "errors that can be written", "AccessType", is_past_error, "rw"),
        value(
            "COM021",
            "a number of errors before any has happened",
            "DefaultValue",
            |section| section.name == "1003sub0",
            "8",
        ),
        value("COM021", "an error before any has happened", "DefaultValue", is_past_error, "0x00008130"),
    ]
}

fn sync() -> Vec<Defect> {
    vec![
        sync_id("COM005", "bits of an extended frame in the COB-ID of SYNC", "0x00008080"),
        sync_id("COM005", "a restricted CAN-ID for SYNC", "0x00000000"),
        sync_id("COM005", "the CAN-ID of an SDO for SYNC", "0x00000605"),
        once("COM006", "a SYNC producer without a period", |base| {
            let sync = base.entry("1005", "DefaultValue")?;
            let mutant = without_object(base, 0x1006)?.set(sync, "0x40000080");
            Some(match base.entry("1005", "ParameterValue") {
                Some(configured) => {
                    mutant.delete(sync.line).rewrite(configured.line, "ParameterValue=0x40000080")
                }
                None => mutant,
            })
        }),
        once("COM006", "a SYNC producer with a period of 0", |base| {
            let period = base.section("1006")?;
            let of = |name: &str| {
                let section = base.section(name)?;
                section.entry("ParameterValue").or(section.entry("DefaultValue"))
            };
            Some(Mutant::of(base).set(of("1005")?, "0x40000080").set_too(of(&period.name)?, "0"))
        }),
        once("COM007", "a synchronous window longer than the period", |base| {
            let of = |name: &str| {
                let section = base.section(name)?;
                section.entry("ParameterValue").or(section.entry("DefaultValue"))
            };
            Some(Mutant::of(base).set(of("1007")?, "5000").set_too(of("1006")?, "1000"))
        }),
        once("COM017", "a synchronous PDO without SYNC", |base| {
            let types = base.sections_where(|section| {
                section.sub_index() == Some(2)
                    && (section.is_within(0x1400, 0x15FF) || section.is_within(0x1800, 0x19FF))
                    && section.number("DefaultValue") == Some(1)
            });
            let value = types.first()?.entry("DefaultValue")?;
            Some(without_object(base, 0x1005)?.expect(value.line))
        }),
        once("COM017", "a PDO that becomes synchronous where there is no SYNC", |base| {
            let value = base.entry("1800sub2", "DefaultValue")?;
            let is_used = !base.sub_object(0x1800, 1)?.value("DefaultValue").contains("0x8");
            (base.object(0x1005).is_none() && is_used).then(|| Mutant::of(base).set(value, "1"))
        }),
    ]
}

fn sync_id(rule: &'static str, kind: &'static str, id: &'static str) -> Defect {
    once(rule, kind, move |base| {
        let section = base.section("1005")?;
        let entry = section.entry("ParameterValue").or(section.entry("DefaultValue"))?;
        Some(Mutant::of(base).set(entry, id))
    })
}

fn emcy() -> Vec<Defect> {
    vec![
        value(
            "COM009",
            "EMCY at another CAN-ID",
            "DefaultValue",
            |section| section.name == "1014",
            "$NODEID+0x680",
        ),
        value(
            "COM009",
            "EMCY at a constant CAN-ID",
            "DefaultValue",
            |section| section.name == "1014",
            "0x6A0",
        ),
    ]
}

fn error_control() -> Vec<Defect> {
    vec![
        once("COM010", "neither heartbeat nor node guarding", |base| {
            base.object(0x100C).is_none().then(|| without_object(base, 0x1017))?.map(|mutant| {
                let list = base.section("OptionalObjects");
                list.into_iter().fold(mutant, |mutant, list| mutant.expect(list.header))
            })
        }),
        once("COM011", "a guard time without a life time factor", |base| {
            Some(expect_object(without_object(base, 0x100D)?, base, 0x100C))
        }),
        once("COM011", "a life time factor without a guard time", |base| {
            Some(expect_object(without_object(base, 0x100C)?, base, 0x100D))
        }),
        heartbeat("bits 24 to 31 of a monitored heartbeat", "0x010503E8"),
        heartbeat("a monitored heartbeat of node 0", "0x000003E8"),
        heartbeat("a monitored heartbeat of node 200", "0x00C803E8"),
        once("COM012", "two heartbeats of one node", |base| {
            let first = base.sub_object(0x1016, 1)?;
            let first = first.entry("ParameterValue").or(first.entry("DefaultValue"))?;
            let second = base.sub_object(0x1016, 2)?.entry("DefaultValue")?;
            Some(Mutant::of(base).set_too(first, "0x001003E8").set(second, "0x001007D0"))
        }),
    ]
}

fn heartbeat(kind: &'static str, new: &'static str) -> Defect {
    Defect::new("COM012", kind, move |base| {
        let subs = base.sub_objects(0x1016).into_iter().skip(1);
        let values =
            subs.filter_map(|section| section.entry("ParameterValue").or(section.entry("DefaultValue")));
        values.map(|value| Mutant::of(base).set(value, new)).collect()
    })
}

fn expect_object(mutant: Mutant, base: &Base, index: u16) -> Mutant {
    base.object(index).into_iter().fold(mutant, |mutant, section| mutant.expect(section.header))
}

fn identity() -> Vec<Defect> {
    vec![
        once("COM013", "an identity without a vendor-ID", |base| {
            let identity = base.object(0x1018)?;
            let subs = base.sub_objects(0x1018).len();
            let mutant = Mutant::of(base).delete_section(base.sub_object(0x1018, 1)?).expect(identity.header);
            Some(mutant.set_too(identity.entry("SubNumber")?, &(subs - 1).to_string()))
        }),
        once("COM013", "an identity of five entries", |base| {
            base.sub_object(0x1018, 4)?;
            with_sub_object(
                base,
                0x1018,
                5,
                &["ParameterName=Colour", "ObjectType=0x7", "DataType=0x0007", "AccessType=ro"],
            )
        }),
    ]
}

fn sdo() -> Vec<Defect> {
    vec![
        value(
            "COM015",
            "another CAN-ID of the default SDO",
            "DefaultValue",
            |section| section.name == "1200sub1",
            "$NODEID+0x640",
        ),
        value(
            "COM015",
            "a default SDO without its node-ID",
            "DefaultValue",
            |section| section.name == "1200sub2",
            "0x580",
        ),
        once("COM016", "an SDO client without its node-ID", |base| {
            let set = |mutant: Mutant, sub_index, value: &str| {
                let section = base.sub_object(0x1280, sub_index)?;
                let entry = section.entry("ParameterValue").or(section.entry("DefaultValue"))?;
                Some(mutant.set_too(entry, value))
            };
            let mutant = set(set(Mutant::of(base), 1, "0x620")?, 2, "0x5A0")?;
            let node = base.sub_object(0x1280, 3)?;
            let node = node.entry("ParameterValue").or(node.entry("DefaultValue"))?;
            Some(mutant.set(node, "0"))
        }),
        once("COM016", "an SDO client with one of its COB-IDs", |base| {
            let section = base.sub_object(0x1280, 1)?;
            match section.entry("ParameterValue") {
                Some(value) => Some(Mutant::of(base).set(value, "0x80000000")),
                None => Some(Mutant::of(base).set(section.entry("DefaultValue")?, "0x620")),
            }
        })
        .by_label(),
    ]
}

fn values() -> Vec<Defect> {
    vec![
        value("COM008", "a counter overflow of 1", "DefaultValue", |section| section.name == "1019", "1"),
        value("COM008", "a counter overflow of 241", "DefaultValue", |section| section.name == "1019", "241"),
        value("COM008", "an error behaviour of 3", "DefaultValue", is_error_behaviour, "3"),
        value(
            "COM018",
            "a cycle period with a default",
            "DefaultValue",
            |section| section.name == "1006",
            "1000",
        ),
        value(
            "COM018",
            "an inhibit time of EMCY with a default",
            "DefaultValue",
            |section| section.name == "1015",
            "100",
        ),
        once("COM019", "the old count of PDOs", |base| {
            let line = base.section("1005").or(base.section("1008")).or(base.section("1016"))?.header;
            let number = |key| base.section("DeviceInfo")?.number(key);
            let counted = (number("NrOfRXPDO")? << 16) + number("NrOfTXPDO")? + 1;
            let list = base.section("OptionalObjects")?;
            let mutant = also_listed(Mutant::of(base), list, 0x1004)?;
            let mutant = mutant.insert_section(
                line,
                "1004",
                &["ParameterName=Number of PDOs", "ObjectType=0x8", "SubNumber=1"],
            );
            let default = format!("DefaultValue=0x{counted:08X}");
            let entries = ["ParameterName=PDOs", "ObjectType=0x7", "DataType=0x0007", "AccessType=ro"];
            let mutant = mutant.insert_too(line, "[1004sub0]");
            let mutant = entries.iter().fold(mutant, |mutant, entry| mutant.insert_too(line, *entry));
            Some(mutant.insert(line, default))
        }),
        value(
            "COM020",
            "a heartbeat time that can be mapped",
            "PDOMapping",
            |section| section.name == "1017",
            "1",
        ),
        value("COM020", "a COB-ID that can be mapped", "PDOMapping", is_pdo_cob_id, "1"),
    ]
}

fn is_pdo_cob_id(section: &Section) -> bool {
    section.sub_index() == Some(1) && (section.is_within(0x1400, 0x15FF) || section.is_within(0x1800, 0x19FF))
}

fn is_inhibit_time(section: &Section) -> bool {
    section.sub_index() == Some(3) && (section.is_within(0x1400, 0x15FF) || section.is_within(0x1800, 0x19FF))
}

fn is_mapping_entry(section: &Section) -> bool {
    section.sub_index() > Some(0) && (section.is_within(0x1600, 0x17FF) || section.is_within(0x1A00, 0x1BFF))
}

fn is_past_error(section: &Section) -> bool {
    section.sub_index() > Some(0) && section.is_within(0x1003, 0x1003)
}

fn is_error_behaviour(section: &Section) -> bool {
    section.sub_index() > Some(0) && section.is_within(0x1029, 0x1029)
}
