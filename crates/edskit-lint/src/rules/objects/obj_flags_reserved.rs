use crate::rule::rule;
use crate::{Context, Report, Variable};

rule! {
    /// ObjFlags sets reserved bits
    ///
    /// ## What it does
    /// Reports an `ObjFlags` in which one of the bits 2 to 31 is set.
    ///
    /// ## Why is this bad
    /// Only bit 0 (refuse write on download) and bit 1 (refuse read on scan) have a meaning; all others are reserved and
    /// must be 0. A later edition may give them one that was not meant here.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rw
    /// ObjFlags=0x11
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rw
    /// ObjFlags=0x1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.3.
    pub(crate) static OBJ_FLAGS_RESERVED = {
        code: "OBJ018",
        name: "objflags-reserved",
        group: Objects,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("LIB001")],
        check: Variable(check),
    }
}

const DEFINED: u32 = 0b11;

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(field) = variable.obj_flags else { return };
    let Some(flags) = field.known().filter(|flags| flags & !DEFINED != 0) else { return };
    let help = match flags & DEFINED {
        0 => "leave ObjFlags out".to_owned(),
        rest => format!("write `ObjFlags=0x{rest:X}`"),
    };
    report
        .add(field.span(), format!("ObjFlags is {}, but only bits 0 and 1 have a meaning", field.text()))
        .help(help);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn two_bits_are_defined() {
        let text =
            "[2000]\nObjFlags=3\n[2001]\nObjFlags=4\n[2001sub1]\nObjFlags=0x80000000\n[2002]\nObjFlags=x\n";
        assert_eq!(
            findings(&OBJ_FLAGS_RESERVED, text),
            [
                "4:10 warning: ObjFlags is 4, but only bits 0 and 1 have a meaning",
                "6:10 warning: ObjFlags is 0x80000000, but only bits 0 and 1 have a meaning"
            ]
        );
    }
}
