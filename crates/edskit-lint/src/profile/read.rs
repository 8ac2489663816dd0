//! Profiles as TOML.

use super::notation::{Access, Code, Constant, OneOrMany, OneOrRange, Type};
use super::{Attributes, Profile, ProfileObject, ProfileSub, Requirement};
use crate::settings::line_and_column;
use core::fmt;
use core::ops::{Range, RangeInclusive};
use edskit_types::{AccessType, Index};
use toml::Spanned;

/// Why a text is not a profile, and where.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ProfileError {
    /// The line, from 1.
    pub line: usize,
    /// The column, in characters from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
}

impl ProfileError {
    fn new(text: &str, offset: usize, message: &str) -> Self {
        let (line, column) = line_and_column(text, offset);
        Self { line, column, message: message.trim().replace('\n', ", ") }
    }
}

/// `12:7: what is wrong`.
impl fmt::Display for ProfileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

impl core::error::Error for ProfileError {}

impl Profile {
    /// Reads a profile.
    ///
    /// ```
    /// use edskit_lint::Profile;
    /// let text = "name = 'Pumps'\n[[object]]\nindex = 0x2100\nname = 'Speed'\ntype = 'UNSIGNED61'\n";
    /// let error = Profile::parse(text).unwrap_err();
    /// assert_eq!(error.to_string(), "5:8: `UNSIGNED61` is no data type; did you mean `UNSIGNED16`?");
    /// ```
    ///
    /// # Errors
    /// What is wrong, and where.
    pub fn parse(text: &str) -> Result<Self, ProfileError> {
        let raw: RawProfile = toml::from_str(text).map_err(|error| {
            let offset = error.span().map_or(0, |span| span.start);
            ProfileError::new(text, offset, error.message())
        })?;
        raw.check().map_err(|(span, message)| ProfileError::new(text, span.start, &message))
    }
}

/// What is wrong, and at which bytes.
type Complaint = (Range<usize>, String);

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct RawProfile {
    name: String,
    device_profile: Option<u16>,
    #[serde(default)]
    object: Vec<RawObject>,
    #[serde(default)]
    require: Vec<RawRequirement>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct RawObject {
    index: Spanned<OneOrRange<u16>>,
    name: String,
    #[serde(default)]
    code: OneOrMany<Code>,
    mandatory: Option<Spanned<bool>>,
    highest: Option<u8>,
    #[serde(default, rename = "type")]
    types: OneOrMany<Type>,
    #[serde(default)]
    access: OneOrMany<Access>,
    mappable: Option<bool>,
    default: Option<Constant>,
    #[serde(default)]
    values: Vec<OneOrRange<Constant>>,
    #[serde(default)]
    sub: Vec<RawSub>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct RawSub {
    index: Spanned<OneOrRange<u8>>,
    name: Option<String>,
    mandatory: Option<Spanned<bool>>,
    #[serde(default, rename = "type")]
    types: OneOrMany<Type>,
    #[serde(default)]
    access: OneOrMany<Access>,
    mappable: Option<bool>,
    default: Option<Constant>,
    #[serde(default)]
    values: Vec<OneOrRange<Constant>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct RawRequirement {
    name: String,
    device_type_bit: Option<Spanned<u8>>,
    any_of: Spanned<Vec<u16>>,
}

impl RawProfile {
    fn check(self) -> Result<Profile, Complaint> {
        let mut objects = Vec::new();
        for raw in self.object {
            objects.push((raw.index.span(), raw.check()?));
        }
        let objects = sorted(objects, |object| &object.indices, |index| Index(index).to_string())?;
        let requirements = self.require.into_iter().map(RawRequirement::check).collect::<Result<_, _>>()?;
        Ok(Profile { name: self.name, device_profile: self.device_profile, objects, requirements })
    }
}

impl RawObject {
    fn check(self) -> Result<ProfileObject, Complaint> {
        let indices = self.index.into_inner().0;
        let mandatory = is_mandatory(self.mandatory, indices.start() == indices.end())?;
        let attributes = attributes(self.types, self.access, self.mappable, self.default, self.values);
        let mut subs = Vec::new();
        for raw in self.sub {
            subs.push((raw.index.span(), raw.check(&attributes)?));
        }
        let name = |sub_index| format!("sub-index {sub_index:02X}h");
        Ok(ProfileObject {
            indices,
            name: self.name,
            codes: self.code.0.into_iter().map(|code| code.0).collect(),
            mandatory,
            highest: self.highest,
            attributes,
            subs: sorted(subs, |sub| &sub.sub_indices, name)?,
        })
    }
}

impl RawSub {
    /// A sub-index has what the object says, where it says nothing itself; 00h only shares whether it can be mapped.
    fn check(self, object: &Attributes) -> Result<ProfileSub, Complaint> {
        let sub_indices = self.index.into_inner().0;
        let mandatory = is_mandatory(self.mandatory, sub_indices.start() == sub_indices.end())?;
        let mut own = attributes(self.types, self.access, self.mappable, self.default, self.values);
        own.mappable = own.mappable.or(object.mappable);
        if sub_indices.contains(&0) {
            if own.access.is_empty() {
                own.access = vec![AccessType::Ro];
            }
        } else {
            inherit(&mut own.types, &object.types);
            inherit(&mut own.access, &object.access);
            own.default = own.default.or(object.default);
            inherit(&mut own.values, &object.values);
        }
        Ok(ProfileSub { sub_indices, name: self.name, mandatory, attributes: own })
    }
}

impl RawRequirement {
    fn check(self) -> Result<Requirement, Complaint> {
        if let Some(bit) = self.device_type_bit.as_ref().filter(|bit| *bit.get_ref() > 31) {
            return Err((bit.span(), "1000h has the bits 0 to 31".to_owned()));
        }
        if self.any_of.get_ref().is_empty() {
            return Err((self.any_of.span(), "at least one index is needed".to_owned()));
        }
        Ok(Requirement {
            name: self.name,
            device_type_bit: self.device_type_bit.map(Spanned::into_inner),
            any_of: self.any_of.into_inner().into_iter().map(Index).collect(),
        })
    }
}

fn attributes(
    types: OneOrMany<Type>,
    access: OneOrMany<Access>,
    mappable: Option<bool>,
    default: Option<Constant>,
    values: Vec<OneOrRange<Constant>>,
) -> Attributes {
    let bounds = |range: RangeInclusive<Constant>| {
        let (first, last) = range.into_inner();
        first.0..=last.0
    };
    Attributes {
        types: types.0.into_iter().map(|data_type| data_type.0).collect(),
        access: access.0.into_iter().map(|access| access.0).collect(),
        mappable,
        default: default.map(|constant| constant.0),
        values: values.into_iter().map(|range| bounds(range.0)).collect(),
    }
}

fn inherit<T: Clone>(own: &mut Vec<T>, from: &[T]) {
    if own.is_empty() {
        own.extend_from_slice(from);
    }
}

fn is_mandatory(mandatory: Option<Spanned<bool>>, is_single: bool) -> Result<bool, Complaint> {
    match mandatory {
        Some(mandatory) if *mandatory.get_ref() && !is_single => Err((
            mandatory.span(),
            "a range cannot be mandatory; describe what is mandatory alone".to_owned(),
        )),
        Some(mandatory) => Ok(mandatory.into_inner()),
        None => Ok(false),
    }
}

/// The items in ascending order; none may overlap another one.
fn sorted<T, N: Copy + Ord>(
    mut items: Vec<(Range<usize>, T)>,
    range: impl Fn(&T) -> &RangeInclusive<N>,
    name: impl Fn(N) -> String,
) -> Result<Vec<T>, Complaint> {
    items.sort_by_key(|(_, item)| *range(item).start());
    for pair in items.windows(2) {
        let [(first_span, first), (second_span, second)] = pair else { continue };
        if range(second).start() <= range(first).end() {
            let later = if second_span.start > first_span.start { second_span } else { first_span };
            return Err((later.clone(), format!("{} is described twice", name(*range(second).start()))));
        }
    }
    Ok(items.into_iter().map(|(_, item)| item).collect())
}
