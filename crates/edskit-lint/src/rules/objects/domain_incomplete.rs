use crate::edits::add_lines;
use crate::rule::rule;
use crate::wording::series;
use crate::{Context, Report, Variable};
use edskit_model::KeyName;
use edskit_types::ObjectCode;

rule! {
    /// A DOMAIN is described without its data type or access
    ///
    /// ## What it does
    /// Reports an object or sub-object with the object code of a DOMAIN that has no `DataType` or no `AccessType`.
    ///
    /// ## Why is this bad
    /// By the standard both may be missing: the type is DOMAIN, the access rw. But python-canopen refuses the whole file.
    ///
    /// ## Example
    /// ```eds
    /// [1F50]
    /// ParameterName=Program
    /// ObjectType=0x2
    /// AccessType=wo
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1F50]
    /// ParameterName=Program
    /// ObjectType=0x2
    /// DataType=0x000F
    /// AccessType=wo
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2; engineering judgement: the readers in use.
    pub(crate) static DOMAIN_INCOMPLETE = {
        code: "OBJ029",
        name: "domain-incomplete",
        group: Objects,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.code != Some(ObjectCode::Domain)
        || (variable.data_type.is_some() && variable.access_type.is_some())
    {
        return;
    }
    let section = variable.description.section();
    let lacks = [
        (variable.data_type.is_none(), KeyName::DataType, "DataType=0x000F"),
        (variable.access_type.is_none(), KeyName::AccessType, "AccessType=rw"),
    ];
    let missing: Vec<_> = lacks.into_iter().filter(|(is_missing, ..)| *is_missing).collect();
    let names: Vec<String> = missing.iter().map(|(_, key, _)| format!("`{}`", key.spelling())).collect();
    let lines: Vec<&str> = missing.iter().map(|(.., line)| *line).collect();
    let message = format!(
        "the DOMAIN {} has no {}; python-canopen refuses the whole file",
        variable.place(),
        series(&names, "and no")
    );
    let finding = report.add(section.span(), message);
    finding.help(format!("write {}, which is what the absence means", series(&quoted(&lines), "and")));
    // One that stands there without a value would stand twice.
    if missing.iter().all(|(_, key, _)| section.entry(*key).is_none()) {
        finding.safe_fix("Write what the absence means", vec![add_lines(section, &lines)]);
    }
}

fn quoted(lines: &[&str]) -> Vec<String> {
    lines.iter().map(|line| format!("`{line}`")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn what_is_missing_is_added() {
        let text = "[1F50]\nObjectType=2\n[2000]\nObjectType=8\n[2000sub1]\nObjectType=0x02\nAccessType=wo\n[2001]\nObjectType=2\nDataType=15\nAccessType=rw\n[2002]\nObjectType=7\n";
        assert_eq!(
            findings(&DOMAIN_INCOMPLETE, text),
            [
                "1:1 info: the DOMAIN 1F50h has no `DataType` and no `AccessType`; python-canopen refuses the whole file",
                "5:1 info: the DOMAIN 2000h sub-index 01h has no `DataType`; python-canopen refuses the whole file",
            ]
        );
        let mended = text
            .replace("ObjectType=2\n[2000]", "ObjectType=2\nDataType=0x000F\nAccessType=rw\n[2000]")
            .replace("AccessType=wo\n", "AccessType=wo\nDataType=0x000F\n");
        assert_eq!(fixed(&DOMAIN_INCOMPLETE, text), mended);
    }
}
