use super::timestamp::{Date, Time};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Entry, KeyName, Section};

rule! {
    /// A date does not exist, or the file was modified before it was created
    ///
    /// ## What it does
    /// Reports a `CreationDate` or `ModificationDate` that is on no calendar, and a modification that lies before the
    /// creation; the times count where both can be read.
    ///
    /// ## Why is this bad
    /// The dates tell which of two files is newer. If they cannot be true, they were not kept up to date, or day and
    /// month are in the wrong order.
    ///
    /// ## Example
    /// ```eds
    /// [FileInfo]
    /// CreationDate=02-30-2020
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// CreationDate=02-28-2020
    /// ```
    ///
    /// ## References
    /// Engineering judgement: a device cannot be described on a day that never was.
    pub(crate) static DATE_IMPOSSIBLE = {
        code: "FIL007",
        name: "date-impossible",
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
    let created = date(*info, KeyName::CreationDate, report);
    let modified = date(*info, KeyName::ModificationDate, report);
    let (Some((created, first)), Some((modified, second))) = (created, modified) else { return };
    let time = |name| info.filled(name).and_then(|entry| Some((Time::parse(entry.raw())?, entry)));
    let times = (time(KeyName::CreationTime), time(KeyName::ModificationTime));
    let (earlier, later) = match times {
        _ if modified < created => (second, first),
        (Some((first, created_at)), Some((second, modified_at))) if modified == created && second < first => {
            (modified_at, created_at)
        }
        _ => return,
    };
    report
        .add(
            earlier.value_span(),
            format!("the file was modified ({}) before it was created ({})", earlier.text(), later.text()),
        )
        .here("modified")
        .label(later.value_span(), "created")
        .help("set the modification to when the file was last changed");
}

/// The date of an entry; one that does not exist is reported.
fn date<'a>(info: Section<'a>, name: KeyName, report: &mut Report) -> Option<(Date, Entry<'a>)> {
    let entry = info.filled(name)?;
    let date = Date::parse(entry.raw())?;
    if date.is_possible() {
        return Some((date, entry));
    }
    // The other order is the matter of FIL006.
    if date.swapped().is_none() {
        let why = match date.days_in_month() {
            0 => format!("there is no month {:02}", date.month),
            days => format!("month {:02} of that year has days 01 to {days}", date.month),
        };
        report
            .add(
                entry.value_span(),
                format!("{} is `{}`, a day that does not exist", name.spelling(), entry.text()),
            )
            .here(why)
            .help("write a date as month, day and year: `mm-dd-yyyy`");
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn stamps(created: &str, modified: &str) -> Vec<String> {
        let (created_date, created_time) = created.split_once(' ').unwrap();
        let (modified_date, modified_time) = modified.split_once(' ').unwrap();
        let text = format!(
            "[FileInfo]\nCreationDate={created_date}\nCreationTime={created_time}\nModificationDate={modified_date}\nModificationTime={modified_time}\n"
        );
        findings(&DATE_IMPOSSIBLE, &text)
    }

    #[test]
    fn days_that_never_were() {
        assert_eq!(
            stamps("02-29-2023 01:00AM", "31-31-2020 x"),
            [
                "2:14 warning: CreationDate is `02-29-2023`, a day that does not exist",
                "4:18 warning: ModificationDate is `31-31-2020`, a day that does not exist"
            ]
        );
        assert!(stamps("02-29-2024 01:00AM", "14-04-2008 01:00AM").is_empty());
        assert!(stamps("2016-03-25 01:00AM", "01-01-2008 01:00AM").is_empty());
    }

    #[test]
    fn the_modification_comes_after_the_creation() {
        assert_eq!(
            stamps("03-25-2016 09:45AM", "12-31-2015 x"),
            ["4:18 warning: the file was modified (12-31-2015) before it was created (03-25-2016)"]
        );
        assert_eq!(
            stamps("03-25-2016 12:45PM", "03-25-2016 11:59AM"),
            ["5:18 warning: the file was modified (11:59AM) before it was created (12:45PM)"]
        );
        assert!(stamps("03-25-2016 11:45PM", "03-26-2016 01:00AM").is_empty());
        assert!(stamps("03-25-2016 09:45AM", "03-25-2016 09:45AM").is_empty());
        assert!(stamps("03-25-2016 9:45AM", "03-25-2016 01:00AM").is_empty());
    }
}
