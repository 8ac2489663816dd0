use super::timestamp::{Date, Time};
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::meant::value_length;
use edskit_model::{Entry, KeyName};

rule! {
    /// A time is not of the form `hh:mmAM` or `hh:mmPM`
    ///
    /// ## What it does
    /// Reports a `CreationTime` or `ModificationTime` that is not two digits from 01 to 12, a colon, two digits and
    /// `AM` or `PM` directly behind them. Where only the 0 before the hour is missing, it is an info.
    ///
    /// ## Why is this bad
    /// Readers look at fixed columns. The 24-hour clock is what people write instead, and there the same digits mean
    /// two times a day.
    ///
    /// ## Example
    /// ```eds
    /// [FileInfo]
    /// CreationTime=17:24:43
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// CreationTime=05:24PM
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.4.
    pub(crate) static TIME_FORMAT = {
        code: "FIL005",
        name: "time-format",
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
    for name in [KeyName::CreationTime, KeyName::ModificationTime] {
        if let Some(entry) = info.filled(name)
            && Time::parse(entry.raw()).is_none()
            && value_length(entry.raw()).is_none()
        {
            report_time(entry, report);
        }
    }
}

fn report_time(entry: Entry<'_>, report: &mut Report) {
    let raw = entry.raw();
    let name = entry.key().name.spelling();
    let span = entry.value_span();
    let finding = report
        .add(span, format!("{name} is `{}`, which is not of the form `hh:mmAM` or `hh:mmPM`", entry.text()));
    match Time::guess(raw) {
        Some(guess) => {
            let time = guess.time.to_string();
            if time.strip_prefix('0').is_some_and(|short| short.as_bytes() == raw) {
                finding.severity(Severity::Info);
            }
            let edits = vec![Edit::replace(span, &time)];
            finding.help(format!("write `{name}={time}`"));
            if guess.is_certain {
                finding.safe_fix(format!("Write {time}"), edits);
            } else {
                finding.unsafe_fix(format!("Write {time}"), edits);
            }
        }
        None if Date::guess(raw).is_some() => {
            finding.here("this is a date").help(format!("write a time here, such as `{name}=09:45AM`"));
        }
        None => {
            finding.help(format!("write a time from `12:00AM` to `11:59PM`, such as `{name}=09:45AM`"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn what_can_be_computed_is_mended() {
        let text = "[FileInfo]\nCreationTime=7:37AM\nModificationTime=00:00AM\n";
        assert_eq!(
            findings(&TIME_FORMAT, text),
            [
                "2:14 info: CreationTime is `7:37AM`, which is not of the form `hh:mmAM` or `hh:mmPM`",
                "3:18 warning: ModificationTime is `00:00AM`, which is not of the form `hh:mmAM` or `hh:mmPM`"
            ]
        );
        assert_eq!(fixed(&TIME_FORMAT, text), "[FileInfo]\nCreationTime=07:37AM\nModificationTime=12:00AM\n");
    }

    #[test]
    fn nonsense_is_only_reported() {
        for value in ["2016-03-25", "<!time>", "25:00"] {
            let text = format!("[FileInfo]\nCreationTime={value}\n");
            assert_eq!(findings(&TIME_FORMAT, &text).len(), 1, "{value}");
            assert_eq!(fixed(&TIME_FORMAT, &text), text);
        }
        assert!(findings(&TIME_FORMAT, "[FileInfo]\nCreationTime=\nModificationTime=12:00PM\n").is_empty());
    }
}
