use super::parts::{self, Role};
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// An object belongs to the device and to a module
    ///
    /// ## What it does
    /// Reports an object of `[MxFixedObjects]`, which exists only with the module, that the file also describes as an
    /// object of the device itself.
    ///
    /// ## Why is this bad
    /// The device cannot both have the object always and have it only with the module. Readers take one of the two
    /// descriptions.
    ///
    /// ## Example
    /// ```eds
    /// [M1FixedObjects]
    /// NrOfEntries=1
    /// 1=0x2100
    ///
    /// [M1Fixed2100]
    /// ParameterName=Filter time of the inputs
    /// DataType=0x0006
    ///
    /// [2100]
    /// ParameterName=Filter time
    /// DataType=0x0006
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [M1FixedObjects]
    /// NrOfEntries=1
    /// 1=0x2100
    ///
    /// [M1Fixed2100]
    /// ParameterName=Filter time of the inputs
    /// DataType=0x0006
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 6.3.
    pub(crate) static FIXED_AND_DESCRIBED = {
        code: "MOD003",
        name: "fixed-and-described",
        group: Modules,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("10")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for part in parts::of(context).iter().filter(|part| part.role == Role::Fixed) {
        for (index, span) in part.objects() {
            let Some(object) = context.sheet.object(index) else { continue };
            report
                .add(span, format!("module {} brings {index}, which the device has already", part.module))
                .label(object.span(), "the object of the device")
                .help("take it out of the module, or out of the device");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn listed_or_described() {
        let text = "[M1FixedObjects]\n1=0x2000\n2=0x2001\n3=x\n[M1Fixed2002]\n[M1SubExtends]\n1=0x6000\n[2000]\n[2002]\n[6000]\n";
        assert_eq!(
            findings(&FIXED_AND_DESCRIBED, text),
            [
                "2:1 error: module 1 brings 2000h, which the device has already",
                "5:1 error: module 1 brings 2002h, which the device has already"
            ]
        );
    }
}
