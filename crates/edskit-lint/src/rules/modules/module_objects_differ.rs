use super::parts::{self, Role};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Description, KeyName, Section};
use edskit_types::Index;
use std::collections::HashMap;

rule! {
    /// Two modules describe the same object differently
    ///
    /// ## What it does
    /// Compares the object code, the data type, the access and `PDOMapping` of objects that several modules bring, and
    /// of objects that several modules extend.
    ///
    /// ## Why is this bad
    /// The object exists once in the device, and it must not depend on the order of the modules what it looks like.
    ///
    /// ## Example
    /// ```eds
    /// [M1SubExt6000]
    /// ParameterName=Inputs
    /// DataType=0x0005
    /// AccessType=ro
    /// Count=1
    ///
    /// [M2SubExt6000]
    /// ParameterName=Inputs
    /// DataType=0x0006
    /// AccessType=ro
    /// Count=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [M1SubExt6000]
    /// ParameterName=Inputs
    /// DataType=0x0005
    /// AccessType=ro
    /// Count=1
    ///
    /// [M2SubExt6000]
    /// ParameterName=Inputs
    /// DataType=0x0005
    /// AccessType=ro
    /// Count=2
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 6.3.
    pub(crate) static MODULE_OBJECTS_DIFFER = {
        code: "MOD008",
        name: "module-objects-differ",
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
    for role in Role::ALL {
        let mut first: HashMap<Index, (Section<'_>, Description<'_>)> = HashMap::new();
        for part in parts.iter().filter(|part| part.role == role) {
            for (index, section) in &part.described {
                let Some(description) = section.description() else { continue };
                let (other, earlier) = *first.entry(*index).or_insert((*section, description));
                if other.id() != section.id()
                    && let Some((what, key)) = difference(earlier, description)
                {
                    let place = |section: &Section<'_>| {
                        section.filled(key).map_or(section.span(), |entry| entry.value_span())
                    };
                    report
                        .add(
                            place(section),
                            format!("`[{}]` and `[{}]` differ in {what}", section.name(), other.name()),
                        )
                        .label(place(&other), "the first one")
                        .help("describe the object alike in all modules");
                }
            }
        }
    }
}

/// The first attribute in which two descriptions differ; what cannot be read may be anything.
fn difference(a: Description<'_>, b: Description<'_>) -> Option<(&'static str, KeyName)> {
    fn differ<T: PartialEq>(a: Option<T>, b: Option<T>) -> bool {
        matches!((a, b), (Some(a), Some(b)) if a != b)
    }
    let data_type = |description: Description<'_>| description.data_type().and_then(|field| field.known());
    if differ(a.object_code(), b.object_code()) {
        Some(("the object code", KeyName::ObjectType))
    } else if differ(data_type(a), data_type(b)) {
        Some(("the data type", KeyName::DataType))
    } else if differ(a.access(), b.access()) {
        Some(("the access", KeyName::AccessType))
    } else if a.is_mappable() != b.is_mappable() {
        Some(("`PDOMapping`", KeyName::PdoMapping))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(first: &str, second: &str) -> String {
        let text = format!("[M1Fixed2000]\n{first}\n[M2Fixed2000]\n{second}\n[M1SubExt2000]\nDataType=9\n");
        findings(&MODULE_OBJECTS_DIFFER, &text).join("|")
    }

    #[test]
    fn attributes_are_compared_by_meaning() {
        assert_eq!(found("DataType=5", "DataType=0x0005"), "");
        assert_eq!(found("DataType=5", "AccessType=ro"), "");
        assert_eq!(found("ObjectType=7", "ObjectType="), "");
        assert_eq!(
            found("AccessType=ro", "AccessType=rw"),
            "4:12 error: `[M2Fixed2000]` and `[M1Fixed2000]` differ in the access"
        );
        assert!(found("ObjectType=8", "ObjectType=9").ends_with("the object code"));
        assert!(found("PDOMapping=1", "PDOMapping=0").ends_with("`PDOMapping`"));
        assert!(found("DataType=1", "DataType=2").ends_with("the data type"));
    }
}
