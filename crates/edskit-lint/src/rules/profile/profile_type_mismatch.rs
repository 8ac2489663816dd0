use crate::profile::{BUILT_IN, Profile};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::Index;

rule! {
    /// Objects of another device profile than the device names
    ///
    /// ## What it does
    /// Reports a 1000h that names one of the profiles CiA 401, 402, 404, 406 and 410, in a file with objects which are mandatory
    /// in another one of them, have its object code and data type, and are not defined by the named profile.
    ///
    /// ## Why is this bad
    /// A master chooses its driver by 1000h. Either it drives the device by the wrong profile, or the objects lie where the
    /// named profile may define others.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    /// AccessType=ro
    /// DefaultValue=0x00000191
    ///
    /// [6040]
    /// ParameterName=Controlword
    /// ObjectType=0x7
    /// DataType=0x0006
    /// AccessType=rww
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    /// AccessType=ro
    /// DefaultValue=0x00020192
    ///
    /// [6040]
    /// ParameterName=Controlword
    /// ObjectType=0x7
    /// DataType=0x0006
    /// AccessType=rww
    /// ```
    ///
    /// ## References
    /// Engineering judgement. CiA 301 v4.2, 7.5.2.1 says that 1000h names the profile that the device follows.
    pub(crate) static PROFILE_TYPE_MISMATCH = {
        code: "PRF005",
        name: "profile-type-mismatch",
        group: Profile,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    // A further logical device can follow any profile, but not with the objects of the first one.
    let named = context.profiles.applications.iter().find(|application| {
        application.device_type.is_some() && application.place(Index(0x6000)) == Index(0x6000)
    });
    let Some((named, device_type)) = named.and_then(|named| Some((named.profile, named.device_type?))) else {
        return;
    };
    for other in BUILT_IN.iter().filter(|other| other.device_profile != named.device_profile) {
        let foreign = foreign(context, named, other);
        let Some(&first) = foreign.first() else { continue };
        let indices: Vec<String> = foreign.iter().map(Index::to_string).collect();
        let number = other.device_profile.unwrap_or_default();
        let finding = report.add(
            device_type.span(),
            format!("1000h names {}, but {} {}", named.name, belong(&indices), other.name),
        );
        finding.here(format!("names {}", named.name));
        if let Some(object) = context.sheet.object(first) {
            finding.label(object.span(), format!("mandatory in {}", other.name));
        }
        finding.help(format!(
            "write {number:04X}h into the lower half of 1000h if the device follows {}",
            other.name
        ));
    }
}

/// The objects that `other` makes mandatory and `named` does not know.
fn foreign(context: &Context<'_>, named: &Profile, other: &Profile) -> Vec<Index> {
    if other.device_profile.is_none() {
        return Vec::new();
    }
    let foreign = other
        .mandatory()
        .filter(|(index, object)| named.object(*index).is_none() && object.is_like(context.sheet, *index));
    foreign.map(|(index, _)| index).collect()
}

/// `6040h belongs to`, `6040h and 6041h belong to`.
fn belong(indices: &[String]) -> String {
    match indices {
        [first @ .., last] if !first.is_empty() => format!("{} and {last} belong to", first.join(", ")),
        _ => format!("{} belongs to", indices.concat()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn only_what_looks_like_the_other_profile_counts() {
        let found = |number: &str, more: &str| {
            findings(&PROFILE_TYPE_MISMATCH, &format!("[1000]\nDataType=7\nDefaultValue={number}\n{more}"))
        };
        let drive = "[6040]\nDataType=6\n[6041]\nDataType=6\n[6060]\nDataType=5\n";
        assert_eq!(
            found("0x191", drive),
            ["3:14 info: 1000h names CiA 401, but 6040h and 6041h belong to CiA 402"]
        );
        assert!(found("0x192", drive).is_empty());
        assert!(found("0x198", drive).is_empty(), "CiA 408 has such objects too");
        assert!(found("0", drive).is_empty());
        assert!(found("0x196", "[6000]\nDataType=6\n").is_empty(), "CiA 406 has an object there too");
        assert_eq!(found("0x194", "[6000]\nDataType=6\n").len(), 1);
    }
}
