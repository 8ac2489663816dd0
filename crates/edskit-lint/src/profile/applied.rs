//! Which profiles a device follows, and what they prescribe for its objects.

use super::{Attributes, BUILT_IN, Profile, ProfileObject};
use crate::Variable;
use crate::evaluate::{Effective, device_type};
use edskit_model::Datasheet;
use edskit_types::{AccessType, Index, NodeId, ObjectCode, SubIndex};
use std::sync::LazyLock;

/// The lower half of 1000h that stands for several logical devices, each with a profile of its own.
const SEVERAL: u16 = 0xFFFF;
/// The objects of logical devices lie this far apart.
const STEP: u16 = 0x800;
/// The device type of the first logical device; those of the others follow in steps.
const FIRST_LOGICAL_DEVICE: Index = Index(0x67FF);

/// The profiles that a device follows.
pub(crate) struct Applied<'a> {
    pub(crate) applications: Vec<Application<'a>>,
}

/// One profile that a device follows.
#[derive(Clone, Copy)]
pub(crate) struct Application<'a> {
    pub(crate) profile: &'a Profile,
    /// What the objects of the profile area are shifted by: a multiple of 800h for a further logical device.
    shift: u16,
    /// The device type that names the profile; `None` for a profile that every device follows.
    pub(crate) device_type: Option<Effective<'a>>,
}

impl<'a> Applied<'a> {
    /// The profiles of CiA that the device follows.
    pub(crate) fn new(sheet: &'a Datasheet) -> Self {
        let mut applied = Self { applications: Vec::new() };
        applied.add(sheet, &BUILT_IN);
        applied
    }

    /// Adds those of `profiles` that the device follows.
    pub(crate) fn add(&mut self, sheet: &'a Datasheet, profiles: &'a [Profile]) {
        if profiles.is_empty() {
            return;
        }
        let device_types = device_types(sheet);
        for profile in profiles {
            let Some(number) = profile.device_profile else {
                self.applications.push(Application { profile, shift: 0, device_type: None });
                continue;
            };
            for &(shift, device_type) in &device_types {
                if profile_number(device_type) == Some(number) {
                    self.applications.push(Application { profile, shift, device_type: Some(device_type) });
                }
            }
        }
    }

    /// Puts into `found` what is prescribed for the object at `index`, and nothing else.
    #[inline]
    pub(crate) fn find(&self, index: Index, found: &mut Vec<Prescription<'a>>) {
        found.clear();
        let prescriptions = self.applications.iter().filter_map(|application| application.find(index));
        found.extend(prescriptions);
    }
}

impl<'a> Application<'a> {
    fn find(&self, index: Index) -> Option<Prescription<'a>> {
        let own = index.0.checked_sub(self.shift)?;
        if self.shift > 0 && !(0x6000..0x6800).contains(&own) {
            return None;
        }
        let object = self.profile.object(Index(own))?;
        Some(Prescription { profile: self.profile, object })
    }

    /// Where an object of the profile lies on this device.
    pub(crate) fn place(&self, index: Index) -> Index {
        if index.0 < 0x6000 { index } else { Index(index.0.wrapping_add(self.shift)) }
    }
}

/// The device types of the logical devices with the shift of their objects. A device without logical devices is the
/// first one.
fn device_types(sheet: &Datasheet) -> Vec<(u16, Effective<'_>)> {
    let mut found = Vec::new();
    let Some(whole) = device_type(sheet, Index::DEVICE_TYPE) else { return found };
    let first = match profile_number(whole) {
        Some(SEVERAL) => device_type(sheet, FIRST_LOGICAL_DEVICE),
        _ => Some(whole),
    };
    found.extend(first.map(|first| (0, first)));
    for number in 1..8 {
        let shift = number * STEP;
        let further = device_type(sheet, Index(FIRST_LOGICAL_DEVICE.0 + shift));
        found.extend(further.map(|further| (shift, further)));
    }
    found
}

/// The number of the device profile: the lower half of a device type.
pub(crate) fn profile_number(device_type: Effective<'_>) -> Option<u16> {
    device_type.unsigned_at::<u32>(NodeId::MIN).map(|device_type| device_type as u16)
}

/// What one profile prescribes for an object.
#[derive(Clone, Copy)]
pub(crate) struct Prescription<'a> {
    pub(crate) profile: &'a Profile,
    pub(crate) object: &'a ProfileObject,
}

/// What one profile prescribes for a variable.
#[derive(Clone, Copy)]
pub(crate) struct Prescribed<'a> {
    pub(crate) profile: &'a Profile,
    /// What it prescribes for the whole object.
    pub(crate) object: &'a ProfileObject,
    /// What the profile calls the variable.
    pub(crate) name: &'a str,
    pub(crate) attributes: &'a Attributes,
}

/// Sub-index 00h of an ARRAY or RECORD where a profile says nothing of its own about it.
static HIGHEST_SUB_INDEX: LazyLock<Attributes> =
    LazyLock::new(|| Attributes { access: vec![AccessType::Ro], ..Attributes::default() });

impl<'a> Prescription<'a> {
    /// What is prescribed for a variable of the object. What has a wrong object code, VAR instead of ARRAY or
    /// DOMAIN, say, is not looked at any closer.
    pub(crate) fn of(self, variable: &Variable<'_>) -> Option<Prescribed<'a>> {
        let codes = &self.object.codes;
        let may_be =
            |wanted: fn(ObjectCode) -> bool| codes.is_empty() || codes.iter().any(|&code| wanted(code));
        match variable.sub_index {
            Some(sub_index) if may_be(ObjectCode::has_sub_objects) => self.sub(sub_index),
            // What CompactSubObj describes at once has no names of its own.
            None if variable.is_compact() && may_be(|code| code == ObjectCode::Array) => {
                Some(self.prescribed(&self.object.name, &self.object.attributes))
            }
            None if variable.is_compact() && may_be(ObjectCode::has_sub_objects) => self.sub(SubIndex(1)),
            None if variable.holds_value() && (codes.is_empty() || codes.contains(&variable.code?)) => {
                Some(self.prescribed(&self.object.name, &self.object.attributes))
            }
            _ => None,
        }
    }

    fn sub(self, sub_index: SubIndex) -> Option<Prescribed<'a>> {
        let object = self.object;
        if let Some(sub) = object.subs.iter().find(|sub| sub.sub_indices.contains(&sub_index.0)) {
            return Some(self.prescribed(sub.name.as_deref().unwrap_or(&object.name), &sub.attributes));
        }
        match sub_index.0 {
            0 => Some(self.prescribed("highest sub-index", &HIGHEST_SUB_INDEX)),
            0xFF => None,
            _ if object.codes.is_empty() || object.codes.contains(&ObjectCode::Array) => {
                Some(self.prescribed(&object.name, &object.attributes))
            }
            _ => None,
        }
    }

    fn prescribed(self, name: &'a str, attributes: &'a Attributes) -> Prescribed<'a> {
        Prescribed { profile: self.profile, object: self.object, name, attributes }
    }
}

impl<'a> Prescribed<'a> {
    /// What the profile prescribes for another sub-index of the same object.
    pub(crate) fn sibling(self, sub_index: SubIndex) -> Option<Prescribed<'a>> {
        Prescription { profile: self.profile, object: self.object }.sub(sub_index)
    }
}

/// `a`, `a or b`, `a, b or c`.
pub(crate) fn alternatives<T: ToString>(words: impl IntoIterator<Item = T>) -> String {
    let words: Vec<String> = words.into_iter().map(|word| word.to_string()).collect();
    match &words[..] {
        [] => String::new(),
        [word] => word.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}
