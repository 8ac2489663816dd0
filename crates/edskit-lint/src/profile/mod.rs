//! Profiles: what CiA 301, the device profiles and a company's own rules prescribe for each object, as data.
//!
//! A profile is a TOML file (`docs/profiles.md` describes it). Those of CiA are part of the crate, in `profiles/`; a
//! caller hands further ones to [`Linter::with_profiles`](crate::Linter::with_profiles).

mod applied;
mod defaults;
mod notation;
mod read;

pub(crate) use applied::{Application, Applied, Prescribed, Prescription, alternatives, profile_number};
pub use defaults::{StandardDefault, standard_default};
pub use read::ProfileError;

use core::fmt;
use core::ops::RangeInclusive;
use edskit_model::{Datasheet, Formula};
use edskit_types::{AccessType, DataType, Index, NodeId, ObjectCode};
use std::sync::LazyLock;

/// The profiles that every linter knows.
pub(crate) static BUILT_IN: LazyLock<Vec<Profile>> = LazyLock::new(|| {
    let sources = [
        include_str!("../../profiles/cia301.toml"),
        include_str!("../../profiles/cia302.toml"),
        include_str!("../../profiles/cia401.toml"),
        include_str!("../../profiles/cia402.toml"),
        include_str!("../../profiles/cia404.toml"),
        include_str!("../../profiles/cia406.toml"),
        include_str!("../../profiles/cia410.toml"),
    ];
    sources.map(|text| Profile::parse(text).expect("the profiles of the crate are tested")).into()
});

/// What a profile prescribes for the objects of a device.
#[derive(Clone, Debug)]
pub struct Profile {
    /// How messages call it: `CiA 402`.
    pub(crate) name: String,
    /// The device profile number in 1000h; `None` where the profile applies to every device.
    pub(crate) device_profile: Option<u16>,
    /// In ascending order, without overlap.
    objects: Vec<ProfileObject>,
    /// What a device must have besides its mandatory objects.
    pub(crate) requirements: Vec<Requirement>,
}

impl Profile {
    /// The prescription for the object at `index`.
    pub(crate) fn object(&self, index: Index) -> Option<&ProfileObject> {
        let position = self.objects.partition_point(|object| *object.indices.end() < index.0);
        self.objects.get(position).filter(|object| *object.indices.start() <= index.0)
    }

    /// The objects that every device of the profile has.
    pub(crate) fn mandatory(&self) -> impl Iterator<Item = (Index, &ProfileObject)> {
        let mandatory = self.objects.iter().filter(|object| object.mandatory);
        mandatory.map(|object| (Index(*object.indices.start()), object))
    }
}

/// What a profile prescribes for an object, or for each object of a range of indices.
#[derive(Clone, Debug)]
pub(crate) struct ProfileObject {
    indices: RangeInclusive<u16>,
    pub(crate) name: String,
    /// The object codes that it may have; empty where nothing is said.
    pub(crate) codes: Vec<ObjectCode>,
    pub(crate) mandatory: bool,
    /// The highest sub-index that it may have.
    pub(crate) highest: Option<u8>,
    /// Those of a VAR or DOMAIN itself, and of each element of an ARRAY that `subs` does not name.
    attributes: Attributes,
    /// In ascending order, without overlap.
    pub(crate) subs: Vec<ProfileSub>,
}

impl ProfileObject {
    /// Whether the object at `index` is described, with a right object code and a right data type.
    pub(crate) fn is_like(&self, sheet: &Datasheet, index: Index) -> bool {
        sheet.object(index).is_some_and(|object| {
            let data_type = object.data_type().and_then(|field| field.known()).map(Index);
            let types = &self.attributes.types;
            object.object_code().is_some_and(|code| self.codes.is_empty() || self.codes.contains(&code))
                && data_type.is_none_or(|data_type| types.is_empty() || types.contains(&data_type))
        })
    }
}

/// What a profile prescribes for a sub-index, or for each of a range.
#[derive(Clone, Debug)]
pub(crate) struct ProfileSub {
    pub(crate) sub_indices: RangeInclusive<u8>,
    pub(crate) name: Option<String>,
    pub(crate) mandatory: bool,
    attributes: Attributes,
}

/// What a profile prescribes for a value and the rights on it.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Attributes {
    /// The data types that it may have; empty where nothing is said.
    pub(crate) types: Vec<Index>,
    /// The rights that it may have; empty where nothing is said.
    pub(crate) access: Vec<AccessType>,
    pub(crate) mappable: Option<bool>,
    pub(crate) default: Option<Expected>,
    /// The values that it may have; empty where nothing is said.
    pub(crate) values: Vec<RangeInclusive<Expected>>,
}

impl Attributes {
    /// Whether a right is one of those prescribed, or the same over SDO: `const` and `ro`; `rw`, `rwr` and `rww`.
    pub(crate) fn allows(&self, access: AccessType) -> bool {
        let rights = |access: AccessType| (access.is_readable(), access.is_writable());
        self.access.is_empty() || self.access.iter().any(|allowed| rights(*allowed) == rights(access))
    }

    /// Whether a number is one of the values at a node-ID.
    pub(crate) fn allows_value(&self, number: i128, node_id: NodeId) -> bool {
        let holds = |range: &RangeInclusive<Expected>| {
            (range.start().at(node_id)..=range.end().at(node_id)).contains(&number)
        };
        self.values.is_empty() || self.values.iter().any(holds)
    }
}

/// A number that may depend on the node-ID.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Expected {
    Number(i64),
    Formula(Formula),
}

impl Expected {
    /// The number at a node-ID.
    pub(crate) fn at(self, node_id: NodeId) -> i128 {
        match self {
            Self::Number(number) => number.into(),
            Self::Formula(formula) => i128::from(formula.offset()) + i128::from(node_id.get()),
        }
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::Formula(formula) => formula.fmt(f),
        }
    }
}

/// One of several objects that a device must have.
#[derive(Clone, Debug)]
pub(crate) struct Requirement {
    /// What the objects are for: `digital inputs`.
    pub(crate) name: String,
    /// The bit of the device type that must be 1 for it; `None` where it always holds.
    pub(crate) device_type_bit: Option<u8>,
    pub(crate) any_of: Vec<Index>,
}

/// The name of a data type, or its index where CiA 301 defines none there.
pub(crate) fn type_name(index: Index) -> String {
    DataType::from_index(index).map_or_else(|| index.to_string(), |known| known.name().to_owned())
}

#[cfg(test)]
mod tests;
