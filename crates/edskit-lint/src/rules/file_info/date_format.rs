use super::timestamp::Date;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::meant::value_length;
use edskit_model::{Entry, KeyName};

rule! {
    /// A date is not of the form `mm-dd-yyyy`
    ///
    /// ## What it does
    /// Reports a `CreationDate` or `ModificationDate` that is not two digits, two digits and four digits with `-`
    /// between them, or that has the day where the month belongs.
    ///
    /// ## Why is this bad
    /// Readers look at fixed columns, month first. Another order gives another day without anybody noticing.
    ///
    /// ## Example
    /// ```eds
    /// [FileInfo]
    /// CreationDate=2016-03-25
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// CreationDate=03-25-2016
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.4.
    pub(crate) static DATE_FORMAT = {
        code: "FIL006",
        name: "date-format",
        group: FileInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("MND003")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.file_info() else { return };
    for name in [KeyName::CreationDate, KeyName::ModificationDate] {
        if let Some(entry) = info.filled(name) {
            check_date(entry, report);
        }
    }
}

fn check_date(entry: Entry<'_>, report: &mut Report) {
    let raw = entry.raw();
    let (problem, meant) = match Date::parse(raw) {
        // A day that does not exist in either order is the matter of FIL007.
        Some(date) => match date.swapped() {
            Some(swapped) => ("has the day before the month", Some(swapped)),
            None => return,
        },
        None if value_length(raw).is_some() => return,
        None => ("is not of the form `mm-dd-yyyy`", Date::guess(raw)),
    };
    let name = entry.key().name.spelling();
    let span = entry.value_span();
    let finding = report.add(span, format!("{name} is `{}`, which {problem}", entry.text()));
    match meant {
        Some(date) => finding
            .help(format!("write `{name}={date}`"))
            .unsafe_fix(format!("Write {date}"), vec![Edit::replace(span, date.to_string())]),
        None => finding.help(format!("write month, day and year, such as `{name}=03-25-2016`")),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_order_is_set_right() {
        let text = "[FileInfo]\nCreationDate=14-04-2008\nModificationDate=25.03.2016\n";
        assert_eq!(
            findings(&DATE_FORMAT, text),
            [
                "2:14 warning: CreationDate is `14-04-2008`, which has the day before the month",
                "3:18 warning: ModificationDate is `25.03.2016`, which is not of the form `mm-dd-yyyy`"
            ]
        );
        assert_eq!(
            fixed(&DATE_FORMAT, text),
            "[FileInfo]\nCreationDate=04-14-2008\nModificationDate=03-25-2016\n"
        );
    }

    #[test]
    fn what_is_not_clear_stays() {
        for value in ["03/04/2016", "<!date>", "09:45AM"] {
            let text = format!("[FileInfo]\nCreationDate={value}\n");
            assert_eq!(findings(&DATE_FORMAT, &text).len(), 1, "{value}");
            assert_eq!(fixed(&DATE_FORMAT, &text), text);
        }
        let text = "[FileInfo]\nCreationDate=02-30-2020\nModificationDate=\n";
        assert!(findings(&DATE_FORMAT, text).is_empty());
    }
}
