//! Times and dates of `[FileInfo]`: as CiA 306 writes them, and as files have them.

use core::fmt;

/// A time of day. `Display` writes `hh:mmAM` or `hh:mmPM`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Time {
    hour: u8,
    minute: u8,
}

/// What a text that is no time by CiA 306 stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct TimeGuess {
    pub(super) time: Time,
    /// No other reading makes sense.
    pub(super) is_certain: bool,
}

impl Time {
    /// Reads `hh:mmAM` or `hh:mmPM` with an hour from 01 to 12.
    pub(super) fn parse(text: &[u8]) -> Option<Self> {
        let [h1, h0, b':', m1, m0, half @ (b'A' | b'P'), b'M'] = *text else { return None };
        let (hour, minute) = (number(&[h1, h0])? as u8, number(&[m1, m0])? as u8);
        ((1..=12).contains(&hour) && minute < 60).then(|| Self::of_half(hour, minute, half == b'P'))
    }

    /// Reads other notations: one-digit hours, blanks, seconds, small letters, the 24-hour clock.
    pub(super) fn guess(text: &[u8]) -> Option<TimeGuess> {
        let lower = text.to_ascii_lowercase();
        let half = lower.strip_suffix(b"pm").map(|clock| (clock, true));
        let half = half.or_else(|| lower.strip_suffix(b"am").map(|clock| (clock, false)));
        let clock = half.map_or(&lower[..], |(clock, _)| clock).trim_ascii();
        let mut groups = clock.split(|&byte| byte == b':');
        let mut group = |limit| {
            let group = groups.next().filter(|group| group.len() <= 2)?;
            number(group).filter(|&number| number < limit).map(|number| number as u8)
        };
        let (hour, minute) = (group(24)?, group(60)?);
        if clock.iter().filter(|&&byte| byte == b':').count() == 2 {
            group(60)?;
        }
        if groups.next().is_some() {
            return None;
        }
        let (time, is_certain) = match half {
            Some((_, is_pm)) if (1..=12).contains(&hour) => (Self::of_half(hour, minute, is_pm), true),
            // The hour of the 24-hour clock; AM and PM may contradict it.
            Some((_, is_pm)) if hour > 12 => (Self { hour, minute }, is_pm),
            Some((_, is_pm)) => (Self { hour: if is_pm { 12 } else { 0 }, minute }, !is_pm),
            None => (Self { hour, minute }, !(1..=12).contains(&hour)),
        };
        Some(TimeGuess { time, is_certain })
    }

    fn of_half(hour: u8, minute: u8, is_pm: bool) -> Self {
        Self { hour: hour % 12 + if is_pm { 12 } else { 0 }, minute }
    }
}

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hour = (self.hour + 11) % 12 + 1;
        let half = if self.hour < 12 { "AM" } else { "PM" };
        write!(f, "{hour:02}:{:02}{half}", self.minute)
    }
}

/// A date, possible or not. `Display` writes `mm-dd-yyyy`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Date {
    year: u16,
    pub(super) month: u8,
    pub(super) day: u8,
}

impl Date {
    /// Reads `mm-dd-yyyy`, whatever the numbers are.
    pub(super) fn parse(text: &[u8]) -> Option<Self> {
        let [m1, m0, b'-', d1, d0, b'-', y3, y2, y1, y0] = *text else { return None };
        Some(Self {
            year: number(&[y3, y2, y1, y0])?,
            month: number(&[m1, m0])? as u8,
            day: number(&[d1, d0])? as u8,
        })
    }

    /// Reads other notations where only one reading makes sense. `-` and `:` give the order of CiA 306 the benefit of the doubt.
    pub(super) fn guess(text: &[u8]) -> Option<Self> {
        let separator = *text.iter().find(|byte| !byte.is_ascii_digit())?;
        let mut groups = text.split(|&byte| byte == separator);
        let (first, second, third) = (groups.next()?, groups.next()?, groups.next()?);
        if groups.next().is_some() {
            return None;
        }
        let (a, b) = (number(first)?, number(second)?);
        let date = if first.len() == 4 {
            Self::new(a, b, number(third)?)
        } else {
            let year = number(third).filter(|_| third.len() == 4)?;
            match separator {
                b'.' => Self::new(year, b, a),
                _ if a > 12 => Self::new(year, b, a),
                b'-' | b':' => Self::new(year, a, b),
                _ if b > 12 => Self::new(year, a, b),
                _ => None,
            }
        };
        date.filter(|date| date.is_possible())
    }

    fn new(year: u16, month: u16, day: u16) -> Option<Self> {
        Some(Self { year, month: month.try_into().ok()?, day: day.try_into().ok()? })
    }

    /// The date with month and day swapped, if only that makes it possible.
    pub(super) fn swapped(self) -> Option<Self> {
        let swapped = Self { year: self.year, month: self.day, day: self.month };
        (self.month > 12 && swapped.is_possible()).then_some(swapped)
    }

    /// How many days the month has; 0 for a month that does not exist.
    pub(super) fn days_in_month(self) -> u8 {
        let is_leap =
            self.year.is_multiple_of(4) && !self.year.is_multiple_of(100) || self.year.is_multiple_of(400);
        match self.month {
            2 if is_leap => 29,
            2 => 28,
            4 | 6 | 9 | 11 => 30,
            1..=12 => 31,
            _ => 0,
        }
    }

    /// Whether there is such a day.
    pub(super) fn is_possible(self) -> bool {
        (1..=self.days_in_month()).contains(&self.day)
    }
}

impl fmt::Display for Date {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:02}-{:02}-{:04}", self.month, self.day, self.year)
    }
}

/// A decimal number of one to four digits.
fn number(digits: &[u8]) -> Option<u16> {
    let is_number = (1..=4).contains(&digits.len()) && digits.iter().all(u8::is_ascii_digit);
    is_number.then(|| digits.iter().fold(0, |value, digit| value * 10 + u16::from(digit - b'0')))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn time(text: &str) -> Option<(String, bool)> {
        Time::guess(text.as_bytes()).map(|guess| (guess.time.to_string(), guess.is_certain))
    }

    fn date(text: &str) -> Option<String> {
        Date::guess(text.as_bytes()).map(|date| date.to_string())
    }

    #[test]
    fn times_of_cia_306_read_back() {
        for text in ["12:00AM", "01:30AM", "11:59AM", "12:00PM", "12:59PM", "01:00PM", "11:59PM"] {
            assert_eq!(Time::parse(text.as_bytes()).unwrap().to_string(), text);
        }
        for text in ["00:00AM", "13:00PM", "7:37AM", "10:60AM", "10:10am", "10:10 AM", "1a:00AM", ""] {
            assert_eq!(Time::parse(text.as_bytes()), None, "{text}");
        }
        assert!(Time::parse(b"12:30AM") < Time::parse(b"01:00AM"));
        assert!(Time::parse(b"11:59AM") < Time::parse(b"12:00PM"));
    }

    #[test]
    fn other_times_are_guessed() {
        let certain = |text: &str| Some((text.to_owned(), true));
        let uncertain = |text: &str| Some((text.to_owned(), false));
        assert_eq!(time("7:37AM"), certain("07:37AM"));
        assert_eq!(time("17:24:43"), certain("05:24PM"));
        assert_eq!(time("00:00AM"), certain("12:00AM"));
        assert_eq!(time("13:45PM"), certain("01:45PM"));
        assert_eq!(time("03:46 pm"), certain("03:46PM"));
        assert_eq!(time("0:05"), certain("12:05AM"));
        assert_eq!(time("09:30"), uncertain("09:30AM"));
        assert_eq!(time("12:30"), uncertain("12:30PM"));
        assert_eq!(time("13:45AM"), uncertain("01:45PM"));
        assert_eq!(time("00:15PM"), uncertain("12:15PM"));
        for text in
            ["24:00", "10:60", "1:2:3:4", "10", "2016-03-25", "<!time>", "100:00AM", ":", "am", "1:2:99"]
        {
            assert_eq!(time(text), None, "{text}");
        }
    }

    #[test]
    fn dates_of_cia_306_read_back() {
        let possible = |text: &str| Date::parse(text.as_bytes()).unwrap().is_possible();
        assert!(possible("02-29-2024") && possible("02-29-2000") && possible("12-31-2020"));
        for text in ["02-29-2023", "02-29-1900", "04-31-2020", "13-01-2020", "00-01-2020", "01-00-2020"] {
            assert!(!possible(text), "{text}");
        }
        assert_eq!(Date::parse(b"14-04-2008").unwrap().swapped().unwrap().to_string(), "04-14-2008");
        assert_eq!(Date::parse(b"02-30-2020").unwrap().swapped(), None);
        assert_eq!(Date::parse(b"1-01-2020"), None);
    }

    #[test]
    fn other_dates_are_guessed_where_they_are_clear() {
        for text in
            ["2016-03-25", "2016/3/25", "25.3.2016", "25/03/2016", "03/25/2016", "3-25-2016", "03:25:2016"]
        {
            assert_eq!(date(text).as_deref(), Some("03-25-2016"), "{text}");
        }
        for text in [
            "03/04/2016",
            "30-30-2016",
            "2016-25-03",
            "20160325",
            "<!date>",
            "1-2-3-4",
            "3-25-",
            "a.b.c",
            "01-08-26",
        ] {
            assert_eq!(date(text), None, "{text}");
        }
    }
}
