use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Description, Entry, KeyName, SectionKind};
use edskit_types::{DataType, ObjectCode};

rule! {
    /// An UploadFile or DownloadFile stands where it cannot work
    ///
    /// ## What it does
    /// Reports `UploadFile` at an object that cannot be read, `DownloadFile` at one that cannot be written, either of
    /// them at an object that is no DOMAIN, and a `DownloadFile` that does not exist beside the DCF.
    ///
    /// ## Why is this bad
    /// `UploadFile` takes what is read from a DOMAIN, `DownloadFile` is written to it. A tool that downloads the DCF
    /// stops there, or passes over it, and the device lacks its data.
    ///
    /// ## Example
    /// ```dcf
    /// [1F50sub1]
    /// ParameterName=Program 1
    /// ObjectType=0x2
    /// AccessType=ro
    /// DownloadFile=program.bin
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [1F50sub1]
    /// ParameterName=Program 1
    /// ObjectType=0x2
    /// AccessType=wo
    /// DownloadFile=program.bin
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 5.3.1.
    pub(crate) static DOWNLOAD_UPLOAD_ACCESS = {
        code: "DCF007",
        name: "download-upload-access",
        group: Configuration,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Entry(check),
    }
}

fn check(context: &Context<'_>, entry: Entry<'_>, report: &mut Report) {
    let is_upload = match entry.key().name {
        KeyName::UploadFile => true,
        KeyName::DownloadFile => false,
        _ => return,
    };
    let Some((place, description)) = owner(context, entry).filter(|_| !entry.is_empty()) else { return };
    let key = entry.key().name.spelling();
    let data_type = description.data_type();
    let is_domain = description.standard_type() == Some(DataType::Domain)
        || description.object_code() == Some(ObjectCode::Domain);
    let lacks_access = description
        .access()
        .is_some_and(|access| if is_upload { !access.is_readable() } else { !access.is_writable() });
    // Of a type that CiA 301 does not define, nobody knows whether it is a DOMAIN.
    if !is_domain && (description.standard_type().is_some() || data_type.is_none()) {
        let finding = report.add(entry.span(), format!("{place} has a {key}, but is no DOMAIN"));
        if let Some(field) = data_type {
            finding.label(field.span(), "the data type");
        }
        finding.help("write `ParameterValue` instead, or `ObjectType=0x2` and `DataType=0x000F`");
    } else if lacks_access {
        let what = if is_upload { "read" } else { "written" };
        let finding = report.add(entry.span(), format!("{place} has a {key}, but cannot be {what}"));
        if let Some(field) = description.access_type() {
            finding.label(field.span(), "the access");
        }
        finding.help(format!("take it out, or write an access that lets the object be {what}"));
    } else if !is_upload
        && context.neighbours.and_then(|neighbours| neighbours.exists(&entry.text())) == Some(false)
    {
        report
            .add(entry.value_span(), format!("there is no file `{}` beside the DCF", entry.text()))
            .help("put the file there, or write its name as it is");
    }
}

/// The object or sub-object that an entry describes, and what messages call it.
fn owner<'a>(context: &Context<'_>, entry: Entry<'a>) -> Option<(String, Description<'a>)> {
    let section = entry.section()?;
    let place = match section.kind() {
        SectionKind::Object(index) => index.to_string(),
        SectionKind::SubObject(index, sub_index) => format!("{index} sub-index {sub_index}"),
        _ => return None,
    };
    // Of doubled sections the first one counts.
    let first = context.sheet.section(section.kind())?;
    Some((place, section.description()?)).filter(|_| first.id() == section.id())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Folder, findings, findings_among};

    fn found(entries: &str) -> String {
        findings(&DOWNLOAD_UPLOAD_ACCESS, &format!("[1F22sub2]\n{entries}\n")).join("|")
    }

    #[test]
    fn each_key_needs_its_access_and_a_domain() {
        assert_eq!(found("DataType=0xF\nAccessType=ro\nUploadFile=a.bin"), "");
        assert_eq!(found("DataType=0xF\nAccessType=rw\nUploadFile=a.bin\nDownloadFile=a.bin"), "");
        assert_eq!(found("ObjectType=2\nUploadFile=a.bin"), "");
        assert_eq!(found("DataType=0x40\nUploadFile=a.bin"), "");
        assert_eq!(
            found("DataType=0xF\nAccessType=wo\nUploadFile=a.bin"),
            "4:1 warning: 1F22h sub-index 02h has a UploadFile, but cannot be read"
        );
        assert_eq!(
            found("DataType=0xF\nAccessType=ro\nDownloadFile=a.bin"),
            "4:1 warning: 1F22h sub-index 02h has a DownloadFile, but cannot be written"
        );
        assert_eq!(
            found("DataType=7\nAccessType=ro\nDownloadFile=a.bin"),
            "4:1 warning: 1F22h sub-index 02h has a DownloadFile, but is no DOMAIN"
        );
    }

    #[test]
    fn a_file_to_download_must_be_there() {
        let text = "[1F50sub1]\nObjectType=2\nDownloadFile=a.bin\nUploadFile=b.bin\n";
        let among = |folder: &Folder| findings_among(&DOWNLOAD_UPLOAD_ACCESS, "a.dcf", text, folder);
        assert_eq!(among(&Folder::default()), ["3:14 warning: there is no file `a.bin` beside the DCF"]);
        assert!(among(&Folder::default().with("a.bin", "")).is_empty());
    }
}
