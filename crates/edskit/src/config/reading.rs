//! A parameter file, read: which parameters it sets to what, and where.

use super::decimal::Decimal;
use super::key::Place;
use super::other_file;
use super::problem::{self, Problem};
use super::signals::{Declared, KnownSignals, TYPES};
use super::typed::amend;
use super::{key, syntax, value};
use crate::printable;
use edskit_devices::gateway::{
    Configuration, NamedSignals, Owner, Parameter, SignalType, Signals as _, signal_name,
};
use edskit_lint::{Label, MOST_FINDINGS, Severity, nearest};
use edskit_model::Span;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// The only device whose parameters are known.
pub(super) const DEVICE: &str = "heinzmann-canopen-gateway";

/// What a file says.
#[derive(Debug)]
pub(super) struct Reading {
    pub(super) configuration: Configuration,
    pub(super) signals: KnownSignals,
    settings: Vec<Setting>,
    /// The keys of `[gateway]` and `[governor]`, where they are there.
    tables: [Option<Span>; 2],
    /// Where something stands that the file says nothing of.
    start: Span,
    pub(super) problems: Vec<Problem>,
}

/// One parameter that the file sets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting {
    pub(crate) parameter: Parameter,
    /// The value in the file.
    pub(super) span: Span,
    /// How a whole number is written.
    pub(super) radix: u32,
    /// As the device holds it.
    pub(super) value: i32,
}

/// Entries of a table in the order of the file.
pub(crate) type Entries<'t, 'i> = Vec<(&'t str, Span, &'t Spanned<DeValue<'i>>)>;

impl Setting {
    /// What there is to say of an identifier that is not written in hexadecimal digits.
    pub(crate) fn decimal(&self) -> Option<Problem> {
        Decimal::of_setting(self)
            .map(|decimal| decimal.problem(Label { span: self.span, text: String::new() }))
    }
}

impl Reading {
    pub(super) fn of(bytes: &[u8]) -> Self {
        let mut reading = Self {
            configuration: Configuration::new(),
            signals: KnownSignals::default(),
            settings: Vec::new(),
            tables: [None; 2],
            start: Span::at(0),
            problems: Vec::new(),
        };
        match syntax::text_of(bytes) {
            Ok(text) => reading.read(text),
            Err(problem) => reading.problems.push(problem),
        }
        reading.problems = key::unknown_in_one(std::mem::take(&mut reading.problems));
        reading
    }

    /// Whether every entry was understood, so that what follows from the file can be judged.
    pub(super) fn is_complete(&self) -> bool {
        self.problems.iter().all(|problem| problem.severity < Severity::Error)
    }

    /// Where a parameter is set, under whichever of its numbers.
    pub(super) fn setting(&self, parameter: Parameter) -> Option<&Setting> {
        self.settings.iter().find(|setting| setting.parameter.main() == parameter.main())
    }

    /// A parameter under the number that the file gives it.
    pub(super) fn as_set(&self, parameter: Parameter) -> Parameter {
        self.setting(parameter).map_or(parameter, |setting| setting.parameter)
    }

    /// What the file sets, in its order.
    pub(super) fn settings(&self) -> &[Setting] {
        &self.settings
    }

    /// A remark where a parameter is set or, if it is not, where it would be.
    pub(super) fn label(&self, parameter: Parameter, text: impl Into<String>) -> Label {
        let text = text.into();
        if let Some(setting) = self.setting(parameter) {
            return Label { span: setting.span, text };
        }
        let value = parameter.amount(self.configuration.get(parameter));
        let unset = format!("{parameter} is not set and counts as {value}");
        let text = if text.is_empty() { unset } else { format!("{unset}: {text}") };
        Label { span: self.table(parameter.owner()), text }
    }

    /// Where the parameters of a unit stand.
    fn table(&self, owner: Owner) -> Span {
        self.tables[owner as usize].unwrap_or(self.start)
    }

    fn read(&mut self, text: &str) {
        if let Some(problem) = other_file::instead_of_parameters(text) {
            return self.problems.push(problem);
        }
        let amended = amend(text, Place::File, &mut self.problems);
        let text = amended.text.as_ref();
        let Some(root) = syntax::table_of(text, &mut self.problems) else { return };
        let Some(device) = root.get_ref().get("device") else {
            if amended.names_device {
                return self.read_tables(root.get_ref(), text);
            }
            let problem = Problem::at(problem::UNKNOWN_DEVICE, first_line(text), "the file names no device");
            self.problems.push(problem.help(format!("write `device = \"{DEVICE}\"` in the first line")));
            return self.read_tables(root.get_ref(), text);
        };
        self.start = span(device.span());
        match device.get_ref() {
            DeValue::String(name) if name == DEVICE => self.read_tables(root.get_ref(), text),
            other => {
                let message = match other {
                    DeValue::String(name) => format!("the parameters of a device `{name}` are not known"),
                    _ => "`device` must be a text".to_owned(),
                };
                let problem = Problem::at(problem::UNKNOWN_DEVICE, self.start, message);
                self.problems.push(problem.help(format!("the only device known is `\"{DEVICE}\"`")));
            }
        }
    }

    fn read_tables(&mut self, root: &DeTable<'_>, text: &str) {
        for (name, key_span, value) in entries(root) {
            let owner = match name {
                "device" => continue,
                "gateway" => Owner::Gateway,
                "governor" => Owner::Governor,
                _ => {
                    self.problems.push(unknown_key(name, key_span));
                    continue;
                }
            };
            self.tables[owner as usize] = Some(key_span);
            match value.get_ref() {
                DeValue::Table(table) => self.read_parameters(owner, table, text),
                _ => {
                    let message = format!("`{name}` must be a table of parameters");
                    let problem = Problem::at(problem::WRONG_TYPE, span(value.span()), message);
                    self.problems
                        .push(problem.help(format!("write `[{name}]`, and the parameters below it")));
                }
            }
        }
    }

    fn read_parameters(&mut self, owner: Owner, table: &DeTable<'_>, text: &str) {
        let (signals, parameters): (Entries<'_, '_>, Entries<'_, '_>) =
            entries(table).into_iter().partition(|(name, ..)| owner == Owner::Governor && *name == "signals");
        for (_, _, value) in signals {
            self.read_signals(value);
        }
        for (setting, value) in parameters_of(owner, parameters, text, Place::File, &mut self.problems) {
            // It has been looked at whether the parameter can have the value.
            if self.configuration.set(setting.parameter, value).is_ok() {
                self.settings.push(setting);
            }
        }
    }

    fn read_signals(&mut self, value: &Spanned<DeValue<'_>>) {
        let DeValue::Table(table) = value.get_ref() else {
            let message = "`signals` must be a table of parameters of the governor";
            let problem = Problem::at(problem::INVALID_SIGNAL, span(value.span()), message);
            self.problems.push(problem.help("write `[governor.signals]`, and below it `2000 = \"u16\"`"));
            return;
        };
        for (name, key_span, value) in entries(table) {
            match self.read_signal(name, key_span, value) {
                Ok((number, declared)) => {
                    self.problems.extend(bit_of_the_manual(number, &declared));
                    self.signals.declared.insert(number, declared);
                }
                Err(problem) => self.problems.push(problem),
            }
        }
    }

    fn read_signal(
        &self,
        name: &str,
        key_span: Span,
        value: &Spanned<DeValue<'_>>,
    ) -> Result<(u16, Declared), Problem> {
        let invalid = |span, message: String| Problem::at(problem::INVALID_SIGNAL, span, message);
        let Some(number) = key::signal(name) else {
            let problem = invalid(key_span, format!("`{name}` is no number of a parameter of the governor"));
            return Err(problem.help("write a number from 1 to 65535"));
        };
        if let Some(first) = self.signals.declared.get(&number) {
            let problem = invalid(key_span, format!("parameter {number} is described twice"));
            return Err(problem.label(first.span, "the first time").help("keep one of the two"));
        }
        let value_span = span(value.span());
        let examples = "write `\"u16\"`, or `{ name = \"Speed\", type = \"u16\" }`";
        let (name, type_word) = match value.get_ref() {
            DeValue::String(word) => {
                (key::name_of_signal(name).map(printable::line), Some((word.as_ref(), value_span)))
            }
            DeValue::Table(table) => signal_of_table(number, table)?,
            _ => {
                let problem = invalid(value_span, format!("this says nothing of parameter {number}"));
                return Err(problem.help(examples));
            }
        };
        let Some((word, word_span)) = type_word else {
            return Err(invalid(value_span, format!("parameter {number} has no `type`")).help(examples));
        };
        let known = TYPES.iter().find(|(known, _)| known.eq_ignore_ascii_case(word));
        let Some((_, signal_type)) = known else {
            let problem = invalid(word_span, format!("`{word}` is no type of a parameter"));
            return Err(problem.help("write `u8`, `i8`, `u16`, `i16` or `bit`"));
        };
        Ok((number, Declared { name, signal_type: *signal_type, span: key_span, type_span: word_span }))
    }
}

/// A description that makes more of a single bit than the manual does; the bit stays one (GW-PDO-19).
fn bit_of_the_manual(number: u16, declared: &Declared) -> Option<Problem> {
    let is_bit = NamedSignals.signal_type(number) == Some(SignalType::Bit);
    let name = signal_name(number).filter(|_| is_bit && declared.signal_type != SignalType::Bit)?;
    let message =
        format!("{number} {name} is a single bit, as the manual of the gateway says, whatever stands here");
    let problem = Problem::at(problem::INVALID_SIGNAL, declared.type_span, message);
    let help = "a TPDO cannot carry it (4.1.2); leave the description out";
    Some(problem.severity(Severity::Warning).help(help))
}

/// The parameters that a table of `text` sets, and their values, in its order; what is wrong with the others goes to
/// `problems`.
pub(crate) fn parameters_of(
    owner: Owner,
    entries: Entries<'_, '_>,
    text: &str,
    place: Place,
    problems: &mut Vec<Problem>,
) -> Vec<(Setting, i32)> {
    let mut keys: Vec<(Parameter, Span)> = Vec::new();
    let mut settings: Vec<(Setting, i32)> = Vec::new();
    for (name, key_span, value) in entries {
        if problems.len() >= MOST_FINDINGS {
            break;
        }
        let value_span = span(value.span());
        let parameter = match key::parameter(owner, name, key_span, place) {
            Ok(parameter) => parameter,
            Err(problem) => {
                problems.push(problem);
                continue;
            }
        };
        if let Some((_, first)) = keys.iter().find(|(known, _)| *known == parameter) {
            let message = format!("{parameter} is set twice");
            let problem = Problem::at(problem::DUPLICATE_KEY, key_span, message);
            problems.push(problem.label(*first, "the first time").help("keep one of the two"));
            continue;
        }
        keys.push((parameter, key_span));
        if let Some(problem) = dotted_key(parameter, value.get_ref(), key_span, text) {
            problems.push(problem);
            continue;
        }
        let written = text.get(value_span.range()).unwrap_or_default();
        match value::read(parameter, value.get_ref(), value_span, written) {
            Ok(number) => {
                let radix = match value.get_ref() {
                    DeValue::Integer(integer) => integer.radix(),
                    _ => 10,
                };
                let setting = Setting { parameter, span: value_span, radix, value: number };
                match settings.iter().find(|(other, _)| other.parameter.main() == parameter.main()) {
                    None => settings.push((setting, number)),
                    Some((first, _)) if first.value == number => {}
                    Some((first, _)) => problems.push(two_values(first, &setting)),
                }
            }
            Err(problem) => problems.push(problem),
        }
    }
    settings
}

/// One parameter under two of its numbers, with two values (GW-NOTE-37).
fn two_values(first: &Setting, second: &Setting) -> Problem {
    let of =
        |setting: &Setting| format!("{} is {}", setting.parameter, setting.parameter.amount(setting.value));
    let message = format!("{}, and {}: the two are one parameter of the governor", of(first), of(second));
    let problem = Problem::at(problem::DUPLICATE_KEY, second.span, message);
    problem.label(first.span, "the first number").help("keep the one that your governor has")
}

/// A key in which a point stands between number and name: to TOML that is a table.
fn dotted_key(parameter: Parameter, value: &DeValue<'_>, key_span: Span, text: &str) -> Option<Problem> {
    let DeValue::Table(table) = value else { return None };
    let [(name, _, value)] = entries(table)[..] else { return None };
    let has_point = text.get(key_span.end as usize..).is_some_and(|rest| rest.trim_start().starts_with('.'));
    let written = text.get(value.span()).filter(|_| has_point)?;
    let number = parameter.number();
    let message = format!("`{number}.{name}` is two keys to TOML, and no parameter");
    let problem = Problem::at(problem::MANUAL_NOTATION, key_span, message);
    let name = parameter.name().map(|own| format!(" {own}")).unwrap_or_default();
    Some(problem.help(format!("write `\"{number}{name}\" = {written}`")))
}

/// Name and type of `{ name = .., type = .. }`, with the place of the type.
type NameAndType<'t> = (Option<String>, Option<(&'t str, Span)>);

fn signal_of_table<'t>(number: u16, table: &'t DeTable<'_>) -> Result<NameAndType<'t>, Problem> {
    let (mut name, mut type_word) = (None, None);
    for (key, key_span, value) in entries(table) {
        let invalid = |span, message| Problem::at(problem::INVALID_SIGNAL, span, message);
        let text = value.get_ref().as_str();
        let place = span(value.span());
        match (key, text) {
            ("name", Some(text)) => name = Some(printable::line(text)),
            ("type", Some(text)) => type_word = Some((text, place)),
            ("name" | "type", None) => return Err(invalid(place, format!("`{key}` must be a text"))),
            _ => {
                let message = format!("`{key}` says nothing of parameter {number}");
                return Err(invalid(key_span, message).help("there are `name` and `type`"));
            }
        }
    }
    Ok((name, type_word))
}

fn unknown_key(name: &str, span: Span) -> Problem {
    let message = format!("a parameter file has no `{name}`");
    let problem = Problem::at(problem::UNKNOWN_KEY, span, message);
    match nearest(name, ["device", "gateway", "governor"]) {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None => problem.help("there are `device`, `[gateway]` and `[governor]`; write remarks behind `#`"),
    }
}

/// The entries in the order in which they stand in the file.
pub(crate) fn entries<'t, 'i>(table: &'t DeTable<'i>) -> Entries<'t, 'i> {
    let entry = |(key, value): (&'t Spanned<DeString<'i>>, &'t Spanned<DeValue<'i>>)| {
        (key.get_ref().as_ref(), span(key.span()), value)
    };
    let mut entries: Entries<'t, 'i> = table.iter().map(entry).collect();
    entries.sort_by_key(|(_, span, _)| span.start);
    entries
}

fn first_line(text: &str) -> Span {
    span(0..text.find(['\r', '\n']).unwrap_or(text.len()))
}

pub(crate) fn span(range: Range<usize>) -> Span {
    // Spans are 32 bits wide; what lies beyond is shown at the end of what does not.
    let offset = |offset: usize| u32::try_from(offset).unwrap_or(u32::MAX - 1);
    Span::new(offset(range.start), offset(range.end))
}
