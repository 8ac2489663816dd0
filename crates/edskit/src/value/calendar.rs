//! Dates and times in UTC.

/// Milliseconds of a day.
const DAY: u64 = 86_400_000;
/// Days from 0000-03-01 to 1984-01-01, where CANopen begins to count; for tests to 1970-01-01.
const TO_1984: u64 = 724_581;
#[cfg(test)]
const TO_1970: u64 = 719_468;

/// `2026-11-22 07:30:00.000`: days since 1984-01-01 and milliseconds after midnight (CiA 301 v4.2, 7.1.6.5). 28 bits of
/// milliseconds are more than a day has, so a device can say a time that does not exist; it is shown as it is.
pub(crate) fn time_of_day(days: u16, milliseconds: u32) -> String {
    let (year, month, day) = date(TO_1984 + u64::from(days));
    let note = if u64::from(milliseconds) < DAY { "" } else { " (more than a day)" };
    format!("{year:04}-{month:02}-{day:02} {}{note}", time(milliseconds.into()))
}

/// `07:30:00.123456` of microseconds since 1970.
pub(crate) fn clock(microseconds: u64) -> String {
    let milliseconds = microseconds / 1_000 % DAY;
    format!("{}{:03}", time(milliseconds), microseconds % 1_000)
}

/// Days since 1984-01-01 and milliseconds after midnight of `2026-11-22 07:30:00.000`; the time may be missing or shorter.
pub(crate) fn parse_time_of_day(text: &str) -> Option<(u16, u32)> {
    let (day, time) = text.trim().split_once([' ', 'T']).unwrap_or((text.trim(), "00:00:00"));
    let mut parts = day.splitn(3, '-');
    let mut number = || parts.next()?.parse::<u64>().ok();
    let (year, month, day) = (number()?, number()?, number()?);
    let days = days_of(year, month, day)?.checked_sub(TO_1984)?;
    Some((u16::try_from(days).ok()?, parse_time(time)?))
}

fn parse_time(text: &str) -> Option<u32> {
    let mut parts = text.splitn(3, ':');
    let (hours, minutes) = (parts.next()?.parse::<u32>().ok()?, parts.next()?.parse::<u32>().ok()?);
    let (seconds, fraction) = match parts.next() {
        None => (0, 0),
        Some(seconds) => {
            let (seconds, fraction) = seconds.split_once('.').unwrap_or((seconds, ""));
            let is_fraction = fraction.len() <= 3 && fraction.bytes().all(|byte| byte.is_ascii_digit());
            let fraction = is_fraction.then(|| format!("{fraction:0<3}"))?;
            (seconds.parse::<u32>().ok()?, fraction.parse::<u32>().ok()?)
        }
    };
    let is_time = hours < 24 && minutes < 60 && seconds < 60;
    is_time.then_some(((hours * 60 + minutes) * 60 + seconds) * 1_000 + fraction)
}

fn time(milliseconds: u64) -> String {
    let seconds = milliseconds / 1_000;
    let (hours, minutes) = (seconds / 3_600, seconds / 60 % 60);
    format!("{hours:02}:{minutes:02}:{:02}.{:03}", seconds % 60, milliseconds % 1_000)
}

/// Year, month and day of days since 0000-03-01. Years begin with March here, so that the leap day is their last.
fn date(days: u64) -> (u64, u64, u64) {
    let (era, of_era) = (days / 146_097, days % 146_097);
    // Leap days are taken out, so that every year has 365 days.
    let year = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
    let start = |year: u64| year * 365 + year / 4 - year / 100;
    let of_year = of_era - start(year);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    (era * 400 + year + next, month, day)
}

/// Days since 0000-03-01 of a date; `None` for one that does not exist.
fn days_of(year: u64, month: u64, day: u64) -> Option<u64> {
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) || !(1..=9_999).contains(&year) {
        return None;
    }
    let (march_year, from_march) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
    let (era, of_era) = (march_year / 400, march_year % 400);
    let of_year = (153 * from_march + 2) / 5 + day - 1;
    let days = era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year;
    (date(days) == (year, month, day)).then_some(days)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_day_goes_there_and_back() {
        let mut last = (0, 0, 0);
        for days in TO_1970..TO_1970 + 100_000 {
            let (year, month, day) = date(days);
            assert!((year, month, day) > last);
            assert_eq!(days_of(year, month, day), Some(days), "{year}-{month}-{day}");
            last = (year, month, day);
        }
    }

    #[test]
    fn known_days() {
        assert_eq!(date(TO_1970), (1970, 1, 1));
        assert_eq!(date(TO_1984), (1984, 1, 1));
        assert_eq!(date(TO_1970 + 11_016), (2000, 2, 29));
        assert_eq!(time_of_day(59, 3_723_004), "1984-02-29 01:02:03.004");
        assert_eq!(time_of_day(u16::MAX, 0), "2163-06-06 00:00:00.000");
        assert_eq!(time_of_day(0, 86_400_000), "1984-01-01 24:00:00.000 (more than a day)");
        assert_eq!(clock(1_700_000_000_123_456), "22:13:20.123456");
    }

    #[test]
    fn what_people_write() {
        assert_eq!(parse_time_of_day("1984-02-29 01:02:03.004"), Some((59, 3_723_004)));
        assert_eq!(parse_time_of_day("1984-01-02T00:01"), Some((1, 60_000)));
        assert_eq!(parse_time_of_day("1984-01-01"), Some((0, 0)));
        for wrong in
            ["1983-12-31", "1985-02-29", "1984-13-01", "1984-01-01 24:00", "today", "1984-01-01 1:2:3.x"]
        {
            assert_eq!(parse_time_of_day(wrong), None, "{wrong}");
        }
    }
}
