use super::words::is_are;
use crate::edits::number_like;
use crate::numbering::one_wrong;
use crate::rule::rule;
use crate::wording::count;
use crate::{Context, Edit, Report};
use edskit_model::{Entry, KeyName, Section, SectionKind};
use edskit_types::Index;

rule! {
    /// An object link leads nowhere
    ///
    /// ## What it does
    /// Looks at `[xxxxObjectLinks]`. It reports a link to an object that is not described, links of an object that is
    /// not described, an `ObjectLinks` that is missing or is not the number of links, and a link whose key is not the
    /// number of its place. In the file of a modular device the modules may bring the objects, so there only the numbers
    /// are checked.
    ///
    /// ## Why is this bad
    /// The links group objects that belong together. A link that leads nowhere is left over from an earlier edition or
    /// names the wrong object.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rw
    ///
    /// [2010ObjectLinks]
    /// ObjectLinks=2
    /// 1=0x2010
    /// 2=0x2011
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rw
    ///
    /// [2011]
    /// ParameterName=Ramp shape
    /// DataType=0x0005
    /// AccessType=rw
    ///
    /// [2010ObjectLinks]
    /// ObjectLinks=2
    /// 1=0x2010
    /// 2=0x2011
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.4.
    pub(crate) static OBJECT_LINKS_DANGLING = {
        code: "OBJ021",
        name: "objectlinks-dangling",
        group: Objects,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("7"), CanChkEds("13")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for section in context.sheet.other_sections() {
        let SectionKind::ObjectLinks(index) = section.kind() else { continue };
        check_count(section, report);
        check_numbers(section, report);
        if context.is_modular() {
            continue;
        }
        if context.sheet.object(index).is_none() {
            report
                .add(
                    section.span(),
                    format!("`[{}]` belongs to {index}, which is not described", section.name()),
                )
                .help(format!("describe {index}, or leave its links out"));
        }
        for item in section.items() {
            let Some(target) = item.index.known().map(Index) else { continue };
            if context.sheet.object(target).is_none() {
                report
                    .add(item.index.span(), format!("{index} links to {target}, which is not described"))
                    .help(format!("describe {target}, or leave the link out"));
            }
        }
    }
}

/// Either way of counting is right: with or without links that have no value.
fn check_count(section: Section<'_>, report: &mut Report) {
    let listed = section.all_numbered(KeyName::Item).count();
    let filled = section.all_numbered(KeyName::Item).filter(|entry| !entry.is_empty()).count();
    let Some(entry) = section.filled(KeyName::ObjectLinks) else {
        report
            .add(section.span(), format!("`[{}]` has no ObjectLinks", section.name()))
            .help(format!("write `ObjectLinks={filled}`"));
        return;
    };
    let field = entry.unsigned::<u16>();
    let Some(claimed) = field.known().map(usize::from) else { return };
    if claimed == listed || claimed == filled {
        return;
    }
    let number = number_like(filled as u64, entry.raw());
    let links = count(filled, "link");
    report
        .add(field.span(), format!("ObjectLinks is {}, but {links} {} listed", field.text(), is_are(filled)))
        .help(format!("write `ObjectLinks={number}`"))
        .unsafe_fix("Write the number of links", vec![Edit::replace(field.span(), number)]);
}

/// The one key that breaks the numbering; one that stands twice is the matter of SYN014.
fn check_numbers(section: Section<'_>, report: &mut Report) {
    let links: Vec<Entry<'_>> = section.all_numbered(KeyName::Item).collect();
    let Some((place, due)) = one_wrong(links.iter().map(|link| link.key().number)) else { return };
    let Some(link) = links.get(place) else { return };
    if links.iter().filter(|other| other.key().number == link.key().number).count() > 1 {
        return;
    }
    let key = link.key_text();
    report
        .add(
            link.key_span(),
            format!("link {key} of `[{}]` stands in the place of link {due}", section.name()),
        )
        .help(format!("write `{due}` for the key"))
        .unsafe_fix("Write the number that is due", vec![Edit::replace(link.key_span(), due.to_string())]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn targets_owner_and_count() {
        let text = "[2000]\nDataType=5\n[2000ObjectLinks]\nObjectLinks=0x3\n1=0x2000\n2=0x2001\n3=x\n4=\n[2001ObjectLinks]\n1=0x2000\n";
        assert_eq!(
            findings(&OBJECT_LINKS_DANGLING, text),
            [
                "6:3 warning: 2000h links to 2001h, which is not described",
                "9:1 warning: `[2001ObjectLinks]` has no ObjectLinks",
                "9:1 warning: `[2001ObjectLinks]` belongs to 2001h, which is not described"
            ]
        );
        let wrong = "[2000]\nDataType=5\n[2000ObjectLinks]\nObjectLinks=5\n1=0x2000\n";
        assert_eq!(
            findings(&OBJECT_LINKS_DANGLING, wrong),
            ["4:13 warning: ObjectLinks is 5, but 1 link is listed"]
        );
        assert_eq!(fixed(&OBJECT_LINKS_DANGLING, wrong), wrong.replace("=5\n1", "=1\n1"));
    }

    #[test]
    fn links_are_numbered() {
        let text = "[2000]\nDataType=5\n[2000ObjectLinks]\nObjectLinks=3\n1=0x2000\n9=0x2000\n3=0x2000\n";
        assert_eq!(
            findings(&OBJECT_LINKS_DANGLING, text),
            ["6:1 warning: link 9 of `[2000ObjectLinks]` stands in the place of link 2"]
        );
        assert_eq!(fixed(&OBJECT_LINKS_DANGLING, text), text.replace("9=", "2="));
    }

    #[test]
    fn modules_may_bring_the_objects() {
        let text = "[SupportedModules]\nNrOfEntries=1\n[2000ObjectLinks]\nObjectLinks=1\n1=0x2001\n";
        assert_eq!(findings(&OBJECT_LINKS_DANGLING, text), [""; 0]);
    }
}
