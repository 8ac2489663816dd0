//! What the table of real files says.
//!
//! ```toml
//! [causes.1001-missing]
//! fault = "file"
//! why = "no object 1001h, which CiA 301 demands"
//!
//! [files."Vendor.eds"]
//! 1001-missing = ["SDO-01", "EMC-02"]
//!
//! [files."Other.eds"]
//! not-judged = "python-canopen reads no file without [DummyUsage]"
//! ```

use serde::Deserialize;
use std::collections::BTreeMap;

/// Whose fault it is that a check does not pass.
#[derive(Deserialize, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[serde(rename_all = "kebab-case")]
enum Fault {
    /// The file contradicts itself or CiA 301.
    File,
    /// The device is allowed to be otherwise than the check demands it.
    Check,
    /// The library that the check reads the file with takes it for something else.
    Reader,
    /// edskit.
    Edskit,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cause {
    fault: Fault,
    why: String,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Value {
    Checks(Vec<String>),
    Reason(String),
}

/// What is in brackets where a file is not judged.
const NOT_JUDGED: &str = "not-judged";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Contents {
    #[serde(default)]
    causes: BTreeMap<String, Cause>,
    #[serde(default)]
    files: BTreeMap<String, BTreeMap<String, Value>>,
}

/// The table.
pub(super) struct Table {
    causes: BTreeMap<String, Cause>,
    files: BTreeMap<String, Expected>,
}

/// What is expected of a file that does not simply pass.
pub(super) enum Expected {
    /// There is no node, or the check cannot read the file, and why.
    NotJudged(String),
    /// Checks that do not pass, by cause.
    Checks(BTreeMap<String, Vec<String>>),
}

impl Table {
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let Contents { causes, files } = toml::from_str(text).map_err(|error| error.to_string())?;
        if let Some((name, _)) = causes.iter().find(|(_, cause)| cause.why.trim().is_empty()) {
            return Err(format!("the cause {name} says nothing"));
        }
        let files: BTreeMap<String, Expected> = files
            .into_iter()
            .map(|(file, said)| Ok((file.clone(), expected(&file, said, &causes)?)))
            .collect::<Result<_, String>>()?;
        let is_used = |name: &&String| {
            files.values().any(|file| matches!(file, Expected::Checks(checks) if checks.contains_key(*name)))
        };
        match causes.keys().find(|name| !is_used(name)) {
            Some(name) => Err(format!("no file has the cause {name}")),
            None => Ok(Self { causes, files }),
        }
    }

    pub(super) fn of(&self, file: &str) -> Option<&Expected> {
        self.files.get(file)
    }

    pub(super) fn files(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// How many causes there are, by whose fault it is, with the number of files.
    pub(super) fn summary(&self) -> String {
        let mut faults: BTreeMap<Fault, (u32, u32)> = BTreeMap::new();
        for (name, cause) in &self.causes {
            let has =
                |file: &&Expected| matches!(file, Expected::Checks(checks) if checks.contains_key(name));
            let (causes, cases) = faults.entry(cause.fault).or_default();
            *causes += 1;
            *cases += self.files.values().filter(has).count() as u32;
        }
        let shown = faults.iter().map(|(fault, (causes, cases))| {
            let whose = match fault {
                Fault::File => "of the files",
                Fault::Check => "of the check",
                Fault::Reader => "of its reader",
                Fault::Edskit => "of edskit",
            };
            format!("{causes} causes {whose} in {cases} cases")
        });
        shown.collect::<Vec<_>>().join(", ")
    }
}

fn expected(
    file: &str,
    said: BTreeMap<String, Value>,
    causes: &BTreeMap<String, Cause>,
) -> Result<Expected, String> {
    let mut checks = BTreeMap::new();
    let count = said.len();
    for (cause, value) in said {
        match value {
            Value::Reason(reason) if cause == NOT_JUDGED && count == 1 && !reason.trim().is_empty() => {
                return Ok(Expected::NotJudged(reason));
            }
            Value::Checks(ids) if causes.contains_key(&cause) => drop(checks.insert(cause, ids)),
            _ => return Err(format!("{file}: {cause} is no cause of [causes] with a list of checks")),
        }
    }
    Ok(Expected::Checks(checks))
}

impl Expected {
    /// Whether it says why a check does not pass.
    pub(super) fn explains(&self, id: &str) -> bool {
        match self {
            Self::NotJudged(_) => false,
            Self::Checks(checks) => checks.values().flatten().any(|check| check == id),
        }
    }

    /// What it explains although it is not so.
    pub(super) fn mended(&self, bad: &[&str]) -> Vec<&str> {
        match self {
            Self::NotJudged(_) => vec![NOT_JUDGED],
            Self::Checks(checks) => {
                checks.values().flatten().map(String::as_str).filter(|id| !bad.contains(id)).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[causes.no-1001]\nfault = \"file\"\nwhy = \"no 1001h\"\n\
                        [files.\"a.eds\"]\nno-1001 = [\"SDO-01\", \"EMC-02\"]\n\
                        [files.\"b.eds\"]\nnot-judged = \"no reader takes it\"\n";

    #[test]
    fn a_check_is_explained_by_its_cause_only() {
        let table = Table::read(TEXT).unwrap();
        let file = table.of("a.eds").unwrap();
        assert!(file.explains("EMC-02") && !file.explains("EMC-03"));
        assert_eq!(file.mended(&["SDO-01"]), ["EMC-02"]);
        assert_eq!(table.of("b.eds").unwrap().mended(&[]), ["not-judged"]);
        assert!(table.of("c.eds").is_none());
        assert_eq!(table.summary(), "1 causes of the files in 1 cases");
    }

    #[test]
    fn a_table_explains_everything_that_it_names() {
        let without = |line| Table::read(&TEXT.replace(line, "")).map(|_| ()).unwrap_err();
        assert!(without("why = \"no 1001h\"\n").contains("missing field `why`"));
        assert_eq!(without("no-1001 = [\"SDO-01\", \"EMC-02\"]\n"), "no file has the cause no-1001");
        let unknown = TEXT.replace("no-1001 =", "no-1002 =");
        assert!(Table::read(&unknown).err().unwrap().starts_with("a.eds: no-1002 is no cause"));
    }
}
