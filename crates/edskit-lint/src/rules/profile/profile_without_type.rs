use crate::evaluate;
use crate::profile::{BUILT_IN, profile_number};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::Index;

rule! {
    /// Objects of a device profile without its number
    ///
    /// ## What it does
    /// Reports a 1000h whose lower half is 0, so that it names no device profile, in a file that describes objects at 6000h to
    /// 9FFFh.
    ///
    /// ## Why is this bad
    /// The area belongs to the profile that 1000h names. Without its number a master cannot know what the objects mean.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    /// AccessType=ro
    /// DefaultValue=0
    ///
    /// [6000]
    /// ParameterName=Read input 8-bit
    /// ObjectType=0x8
    /// SubNumber=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    /// AccessType=ro
    /// DefaultValue=0x00010191
    ///
    /// [6000]
    /// ParameterName=Read input 8-bit
    /// ObjectType=0x8
    /// SubNumber=1
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.1.
    pub(crate) static PROFILE_WITHOUT_TYPE = {
        code: "PRF001",
        name: "profile-without-type",
        group: Profile,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(device_type) = evaluate::device_type(context.sheet, Index::DEVICE_TYPE) else { return };
    if profile_number(device_type) != Some(0) {
        return;
    }
    let mut objects = context.sheet.objects().filter(|object| (0x6000..0xA000).contains(&object.index().0));
    let Some(first) = objects.next() else { return };
    let count = 1 + objects.count();
    let (noun, verb) = if count == 1 { ("object", "lies") } else { ("objects", "lie") };
    let message = format!("1000h names no device profile, but {count} {noun} {verb} at 6000h to 9FFFh");
    let finding = report.add(device_type.span(), message);
    finding.label(first.span(), format!("{} belongs to a device profile", first.index()));
    // The profile is known where everything is there that its devices must have.
    let mut known = BUILT_IN.iter().filter(|profile| {
        let mut mandatory = profile.mandatory().peekable();
        profile.device_profile.is_some()
            && mandatory.peek().is_some()
            && mandatory.all(|(index, object)| object.is_like(context.sheet, index))
    });
    match (known.next(), known.next()) {
        (Some(profile), None) => finding.help(format!(
            "the objects are those of {}: write {:04X}h into the lower half",
            profile.name,
            profile.device_profile.unwrap_or_default()
        )),
        _ => finding.help("write the number of the profile into the lower half, or use 2000h to 5FFFh"),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, lint};
    use edskit_model::Datasheet;

    #[test]
    fn only_the_lower_half_names_a_profile() {
        let text = |value: &str| {
            format!("[1000]\nDataType=7\nDefaultValue={value}\n[5FFF]\n[6000]\n[9FFF]\n[A000]\n")
        };
        assert_eq!(
            findings(&PROFILE_WITHOUT_TYPE, &text("0x00020000")),
            ["3:14 info: 1000h names no device profile, but 2 objects lie at 6000h to 9FFFh"]
        );
        assert!(findings(&PROFILE_WITHOUT_TYPE, &text("0x191")).is_empty());
        assert!(findings(&PROFILE_WITHOUT_TYPE, &text("")).is_empty());
        assert!(findings(&PROFILE_WITHOUT_TYPE, "[1000]\nDataType=7\nDefaultValue=0\n[2000]\n").is_empty());
    }

    #[test]
    fn a_known_profile_is_named() {
        let help = |text: &str| {
            let sheet = Datasheet::parse(text.as_bytes());
            lint(&PROFILE_WITHOUT_TYPE, "a.eds", &sheet)[0].help.clone().unwrap()
        };
        let drive = "[1000]\nDataType=7\nDefaultValue=0\n[6040]\nDataType=6\n[6041]\nDataType=6\n[6060]\nDataType=2\n[6061]\nDataType=2\n";
        assert_eq!(help(drive), "the objects are those of CiA 402: write 0192h into the lower half");
        assert_eq!(
            help("[1000]\nDataType=7\nDefaultValue=0\n[6040]\nDataType=6\n"),
            "write the number of the profile into the lower half, or use 2000h to 5FFFh"
        );
    }
}
