use super::structure::elements;
use crate::edits::add_lines;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Description, Object};
use edskit_types::Index;

rule! {
    /// Store and restore are not kept out of a download
    ///
    /// ## What it does
    /// Reports writable elements of 1010h (store parameters) and 1011h (restore default parameters) without
    /// `ObjFlags`. Most files have none, so the rule is off by default.
    ///
    /// ## Why is this bad
    /// `ObjFlags` bit 0 tells a tool that downloads a whole configuration not to write the object. Without it the tool
    /// may write the value that it once read to 1010h or 1011h, which the device refuses, or which makes it store or
    /// restore.
    ///
    /// ## Example
    /// ```eds
    /// [1010]
    /// ParameterName=Store parameters
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [1010sub1]
    /// ParameterName=Store all parameters
    /// DataType=0x0007
    /// AccessType=rw
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1010]
    /// ParameterName=Store parameters
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [1010sub1]
    /// ParameterName=Store all parameters
    /// DataType=0x0007
    /// AccessType=rw
    /// ObjFlags=0x1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.3; CiA 301 v4.2, 7.5.2.13 and 7.5.2.14.
    pub(crate) static SAVE_OBJECTS_FLAGS = {
        code: "OBJ020",
        name: "save-objects-flags",
        group: Objects,
        severity: Info,
        enabled: false,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Object(check),
    }
}

fn check(_: &Context<'_>, object: Object<'_>, report: &mut Report) {
    if !matches!(object.index(), Index::STORE_PARAMETERS | Index::RESTORE_PARAMETERS) {
        return;
    }
    let mut open: Vec<Description<'_>> = if object.compact_count() > 0 {
        vec![object.description()]
    } else {
        elements(object).map(|sub| sub.description()).collect()
    };
    open.retain(|description| {
        description.access().is_some_and(|access| access.is_writable())
            && description.obj_flags().is_none_or(|field| field.known() == Some(0))
    });
    open.sort_by_key(|description| description.section().id());
    let Some(first) = open.first() else { return };
    let finding = report.add(
        first.section().span(),
        format!("nothing keeps a download of the whole file from writing to {}", object.index()),
    );
    for other in &open[1..] {
        finding.label(other.section().span(), "nor here");
    }
    let edits = open.iter().map(|description| match description.obj_flags() {
        Some(field) => Edit::replace(field.span(), "0x1"),
        None => add_lines(description.section(), &["ObjFlags=0x1"]),
    });
    finding.help("write `ObjFlags=0x1`").unsafe_fix("Keep it out of downloads", edits.collect());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn writable_elements_without_flags() {
        let text = "[1010]\nObjectType=8\n[1010sub0]\nAccessType=ro\n[1010sub1]\nAccessType=rw\n[1010sub2]\nAccessType=rw\nObjFlags=2\n[1010sub3]\nAccessType=rw\nObjFlags=0\n\
                    [1011]\nObjectType=8\nCompactSubObj=4\nAccessType=rw\n";
        assert_eq!(
            findings(&SAVE_OBJECTS_FLAGS, text),
            [
                "5:1 info: nothing keeps a download of the whole file from writing to 1010h",
                "13:1 info: nothing keeps a download of the whole file from writing to 1011h"
            ]
        );
        assert_eq!(
            fixed(&SAVE_OBJECTS_FLAGS, text),
            "[1010]\nObjectType=8\n[1010sub0]\nAccessType=ro\n[1010sub1]\nAccessType=rw\nObjFlags=0x1\n[1010sub2]\nAccessType=rw\nObjFlags=2\n[1010sub3]\nAccessType=rw\nObjFlags=0x1\n\
             [1011]\nObjectType=8\nCompactSubObj=4\nAccessType=rw\nObjFlags=0x1\n"
        );
    }
}
