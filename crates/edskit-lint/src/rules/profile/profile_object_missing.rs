use crate::described::is_known;
use crate::profile::{Application, alternatives};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::SectionKind;
use edskit_types::{Index, NodeId};

rule! {
    /// A device lacks objects that its profile prescribes
    ///
    /// ## What it does
    /// Reports mandatory objects of the device profile named by 1000h, or of a profile given with `--profile`, that are not
    /// described. For CiA 401 these depend on the bits 16 to 19 of 1000h, which say what inputs and outputs there are, and any
    /// width of their data will do. 1000h, 1001h and 1018h are left to LST007. In a modular device objects can come from the
    /// modules, so nothing is reported.
    ///
    /// ## Why is this bad
    /// A master that knows the profile uses these objects without looking for them.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    /// AccessType=ro
    /// DefaultValue=0x00010191
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
    /// CiA 301 v4.2, 7.5.2.1; the device profiles.
    pub(crate) static PROFILE_OBJECT_MISSING = {
        code: "PRF002",
        name: "profile-object-missing",
        group: Profile,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("9")],
        check: File(check),
    }
}

/// What LST007 reports.
const OWNED_BY_LST007: [Index; 3] = [Index::DEVICE_TYPE, Index::ERROR_REGISTER, Index::IDENTITY];

fn check(context: &Context<'_>, report: &mut Report) {
    if context.is_modular() {
        return;
    }
    for application in &context.profiles.applications {
        let missing = missing(context, application);
        if !missing.is_empty() {
            complain(context, application, &missing, report);
        }
    }
}

/// What a device lacks, as messages call it.
fn missing(context: &Context<'_>, application: &Application<'_>) -> Vec<String> {
    let has = |index: &Index| is_known(context.sheet, application.place(*index));
    let mandatory = application.profile.mandatory();
    let mandatory = mandatory.filter(|(index, _)| !has(index) && !OWNED_BY_LST007.contains(index));
    let mandatory =
        mandatory.map(|(index, object)| format!("{} ({})", application.place(index), object.name));
    let device_type: Option<u32> =
        application.device_type.and_then(|device_type| device_type.unsigned_at(NodeId::MIN));
    let requirements = application.profile.requirements.iter().filter(|requirement| {
        let holds = match requirement.device_type_bit {
            Some(bit) => device_type.is_some_and(|device_type| device_type >> bit & 1 == 1),
            None => true,
        };
        holds && !requirement.any_of.iter().any(has)
    });
    let requirements = requirements.map(|requirement| {
        let places = requirement.any_of.iter().map(|index| application.place(*index));
        format!("{} ({})", alternatives(places), requirement.name)
    });
    mandatory.chain(requirements).collect()
}

fn complain(context: &Context<'_>, application: &Application<'_>, missing: &[String], report: &mut Report) {
    let list = context.sheet.section(SectionKind::OptionalObjects).map(|list| list.span());
    let place = application.device_type.map(|device_type| device_type.span()).or(list);
    let name = &application.profile.name;
    let message = format!("{name} prescribes {}, which the file does not describe", missing.join(", "));
    let finding = report.add(place.unwrap_or(context.start()), message);
    if application.device_type.is_some() {
        finding.here(format!("the device type names {name}"));
    }
    finding
        .help("describe what is missing, or correct the device type if the device follows another profile");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;
    use crate::{FileKind, Linter, Profile, RuleSet};
    use edskit_model::Datasheet;

    fn text(device_type: &str, more: &str) -> String {
        format!("[1000]\nDataType=7\nDefaultValue={device_type}\n{more}")
    }

    #[test]
    fn a_drive_has_its_state_machine() {
        assert_eq!(
            findings(&PROFILE_OBJECT_MISSING, &text("0x20192", "[6040]\n[6041]\n[6060]\n")),
            [
                "3:14 warning: CiA 402 prescribes 6061h (modes of operation display), which the file does not describe"
            ]
        );
        assert!(findings(&PROFILE_OBJECT_MISSING, &text("0", "")).is_empty());
    }

    #[test]
    fn the_bits_of_the_device_type_say_what_a_module_has() {
        assert_eq!(
            findings(&PROFILE_OBJECT_MISSING, &text("0x000B0191", "[6100]\n[OptionalObjects]\n1=0x6411\n")),
            [
                "3:14 warning: CiA 401 prescribes 6200h, 6220h, 6300h or 6320h (digital outputs), which the file does not describe"
            ]
        );
        assert!(findings(&PROFILE_OBJECT_MISSING, &text("0x191", "")).is_empty());
        assert!(
            findings(&PROFILE_OBJECT_MISSING, &text("0xF0191", "[SupportedModules]\nNrOfEntries=1\n"))
                .is_empty()
        );
    }

    #[test]
    fn further_axes_have_their_own_objects() {
        let more = "[6040]\n[6041]\n[6060]\n[6061]\n[6FFF]\nDataType=7\nDefaultValue=0x20192\n[6840]\n[6841]\n[6860]\n";
        assert_eq!(
            findings(&PROFILE_OBJECT_MISSING, &text("0x20192", more)),
            [
                "10:14 warning: CiA 402 prescribes 6861h (modes of operation display), which the file does not describe"
            ]
        );
    }

    #[test]
    fn a_profile_of_ones_own_applies_to_every_device() {
        let profile = Profile::parse(
            "name = 'Ours'\n[[object]]\nindex = 0x2100\nname = 'serial text'\nmandatory = true\n",
        );
        let linter = Linter::new(RuleSet::only(&[&PROFILE_OBJECT_MISSING])).with_profiles([profile.unwrap()]);
        let messages = |text: &str| {
            let findings = linter.lint(&Datasheet::parse(text.as_bytes()), FileKind::Eds, None);
            findings.into_iter().map(|finding| finding.message).collect::<Vec<_>>()
        };
        assert_eq!(
            messages("[1000]\n"),
            ["Ours prescribes 2100h (serial text), which the file does not describe"]
        );
        assert!(messages("[2100]\n").is_empty());
    }
}
