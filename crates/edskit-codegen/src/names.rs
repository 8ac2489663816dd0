//! What the entries of a dictionary and their handles are called in Rust.

use crate::identifier::{loses, words};
use core::fmt::Write;
use edskit_types::{Index, SubIndex};
use std::collections::{HashMap, HashSet};

/// The most characters of a name, without the place that stands behind a shared one.
pub(crate) const MOST_CHARACTERS: usize = 60;

/// What is to be called something: an entry, or an array of entries.
#[derive(Clone, Copy)]
pub(crate) struct Named<'a> {
    pub(crate) index: Index,
    /// That of the entry, or of the first one of an array; `None` for an array that is a whole object.
    pub(crate) sub_index: Option<SubIndex>,
    /// The name of the object, where it is a part of one.
    pub(crate) object: Option<&'a str>,
    pub(crate) name: &'a str,
    /// What the side-file calls the object.
    pub(crate) given_object: Option<&'a str>,
    /// What the side-file calls it.
    pub(crate) given: Option<&'a str>,
    /// An element of an array, whose handle has the name of that.
    pub(crate) is_element: bool,
}

/// Why a name is not the one of the EDS.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Reason {
    /// It has letters that no ASCII stands for.
    Lost,
    /// It is longer than a name can be.
    Cut,
    /// The one at this place has it already.
    Shared(usize),
    /// The object of the one at this place has the name of its object already.
    SharedObject(usize),
}

/// A name, and why it is another one than people would expect.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Name {
    pub(crate) name: String,
    pub(crate) reason: Option<Reason>,
}

/// The names, in capitals: those of the side-file, then in the order given here. Who comes first keeps a name, whatever comes
/// later; the others have their place behind it, and where even that is taken, or a name holds nothing usable, they are
/// called `OBJECT_2001_01`.
pub(crate) fn names(all: &[Named<'_>]) -> Vec<Name> {
    let mut taken: HashMap<String, usize> = HashMap::with_capacity(all.len());
    for (place, named) in all.iter().enumerate() {
        if let Some(given) = named.given {
            taken.entry(given.to_owned()).or_insert(place);
        }
    }
    let mut objects: HashMap<String, usize> = HashMap::new();
    let mut told: HashSet<Index> = HashSet::new();
    let mut names = Vec::with_capacity(all.len());
    for (place, named) in all.iter().enumerate() {
        if let Some(given) = named.given {
            names.push(Name { name: given.to_owned(), reason: None });
            continue;
        }
        let (base, mut reason) = base_name(named);
        let mut candidate = base.clone();
        if let Some(first) = named.object.and_then(|object| first_of(&mut objects, object, named, place, all))
        {
            if told.insert(named.index) {
                reason = Some(Reason::SharedObject(first));
            }
            candidate = with_place(&base, named);
        } else if let Some(first) = taken.get(&candidate) {
            // An element that is called like its array is nothing that anybody would miss.
            if !named.is_element || all[*first].index != named.index {
                reason = Some(Reason::Shared(*first));
            }
            candidate = with_place(&base, named);
        }
        if taken.contains_key(&candidate) {
            candidate = place_name(named);
        }
        while taken.contains_key(&candidate) {
            candidate = with_place(&candidate, named);
        }
        taken.insert(candidate.clone(), place);
        names.push(Name { name: candidate, reason });
    }
    names
}

/// The first one whose object has the same name, where that is another object.
fn first_of(
    objects: &mut HashMap<String, usize>,
    object: &str,
    named: &Named<'_>,
    place: usize,
    all: &[Named<'_>],
) -> Option<usize> {
    if named.given_object.is_some() || is_place_name(&base_name(named).0) {
        return None;
    }
    let name = words(object).to_ascii_uppercase();
    if name.is_empty() {
        return None;
    }
    let first = *objects.entry(name).or_insert(place);
    (all[first].index != named.index).then_some(first)
}

/// A name without a look at the others, and what has become of that in the EDS.
fn base_name(named: &Named<'_>) -> (String, Option<Reason>) {
    let object = match named.given_object {
        Some(given) => given.to_owned(),
        None => named.object.map_or_else(String::new, words),
    };
    let own = words(named.name);
    let mut is_cut = false;
    // Names of compact sub-objects begin with that of the object.
    let repeats = named.object.is_some_and(|object| !object.is_empty() && named.name.starts_with(object));
    let mut name = match (repeats, named.given_object, named.object) {
        (true, Some(given), Some(object)) => [given, &words(&named.name[object.len()..])].join("_"),
        (true, ..) => own,
        (false, ..) if object.is_empty() || own.is_empty() => object + &own,
        (false, ..) => {
            is_cut = object.len() + 1 + own.len() > MOST_CHARACTERS;
            // What an entry is called tells it from the others of its object, but not sub-index 00h from that of others.
            let is_count = named.sub_index == Some(SubIndex(0));
            let room = if is_count { object.len() } else { MOST_CHARACTERS.saturating_sub(own.len() + 1) };
            [whole_words(&object, room), &own].join("_")
        }
    };
    let loses_object = named.given_object.is_none() && named.object.is_some_and(loses);
    let mut reason = (loses(named.name) || loses_object).then_some(Reason::Lost);
    name = name.trim_matches('_').to_ascii_uppercase();
    is_cut |= name.len() > MOST_CHARACTERS;
    name.truncate(whole_words(&name, MOST_CHARACTERS).len());
    reason = reason.or(is_cut.then_some(Reason::Cut));
    name.truncate(name.trim_end_matches('_').len());
    if name.starts_with(|first: char| first.is_ascii_digit()) {
        name.insert_str(0, "OBJECT_");
    }
    if name.is_empty() || is_place_name(&name) { (place_name(named), reason) } else { (name, reason) }
}

/// As many whole words as have room; of a first word that has none as much as fits, if it is the only one.
fn whole_words(name: &str, room: usize) -> &str {
    if name.len() <= room {
        return name;
    }
    let end = name[..=room].rfind('_').unwrap_or(if name.contains('_') { 0 } else { room });
    &name[..end]
}

/// `SPEED_2001_01`
fn with_place(name: &str, named: &Named<'_>) -> String {
    format!("{name}_{}", suffix(named))
}

/// `2001`, `2001_01`.
fn suffix(named: &Named<'_>) -> String {
    let mut suffix = format!("{:04X}", named.index.0);
    if let Some(SubIndex(sub_index)) = named.sub_index
        && (named.object.is_some() || sub_index > 0)
    {
        // Writing to a string does not fail.
        let _ = write!(suffix, "_{sub_index:02X}");
    }
    suffix
}

/// `OBJECT_2001`, `OBJECT_2001_01`.
fn place_name(named: &Named<'_>) -> String {
    format!("OBJECT_{}", suffix(named))
}

/// Whether a name looks like one that is made from a place.
pub(crate) fn is_place_name(name: &str) -> bool {
    let is_hex =
        |text: &str, digits| text.len() == digits && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    name.strip_prefix("OBJECT_").is_some_and(|place| match place.split_once('_') {
        Some((index, sub_index)) => is_hex(index, 4) && is_hex(sub_index, 2),
        None => is_hex(place, 4),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named<'a>(index: u16, sub_index: u8, object: Option<&'a str>, name: &'a str) -> Named<'a> {
        let (index, sub_index) = (Index(index), Some(SubIndex(sub_index)));
        Named { index, sub_index, object, name, given_object: None, given: None, is_element: false }
    }

    fn called(all: &[Named<'_>]) -> Vec<String> {
        names(all).into_iter().map(|name| name.name).collect()
    }

    fn reasons(all: &[Named<'_>]) -> Vec<Option<Reason>> {
        names(all).into_iter().map(|name| name.reason).collect()
    }

    fn name(text: &str) -> String {
        called(&[named(0x2001, 0, None, text)]).remove(0)
    }

    #[test]
    fn names_become_capitals() {
        assert_eq!(name("Producer Heartbeat Time"), "PRODUCER_HEARTBEAT_TIME");
        assert_eq!(name("COB-ID SYNC"), "COB_ID_SYNC");
        assert_eq!(name("Gr\u{f6}\u{df}e"), "GROESSE");
        assert_eq!(name("2nd value"), "OBJECT_2ND_VALUE");
        assert_eq!(name("self"), "SELF");
        for nothing in ["", "\u{1F600}", "*/ //", "___", "\u{901F}"] {
            assert_eq!(name(nothing), "OBJECT_2001", "{nothing}");
        }
        assert_eq!(name(&"ab ".repeat(100)).len(), 59);
    }

    #[test]
    fn sub_objects_begin_with_their_object() {
        let object = Some("Identity Object");
        let all = called(&[
            named(0x1018, 0, object, "NrOfObjects"),
            named(0x1018, 1, object, "Vendor ID"),
            named(0x1018, 2, object, ""),
            named(0x2100, 1, Some("Ramp"), "Ramp1"),
            named(0x2200, 1, Some(""), "Level"),
        ]);
        let wanted = [
            "IDENTITY_OBJECT_NR_OF_OBJECTS",
            "IDENTITY_OBJECT_VENDOR_ID",
            "IDENTITY_OBJECT",
            "RAMP1",
            "LEVEL",
        ];
        assert_eq!(all, wanted);
    }

    #[test]
    fn the_first_keeps_a_name_that_others_share() {
        let first = named(0x2001, 0, None, "Speed");
        assert_eq!(called(&[first]), ["SPEED"]);
        let all = [
            first,
            named(0x2002, 0, None, "speed"),
            named(0x2003, 1, Some("x"), "Y"),
            named(0x2003, 2, Some("x"), "y"),
            named(0x2004, 0, None, "Speed 2002"),
            named(0x2005, 0, None, "Object 2001"),
        ];
        let wanted = ["SPEED", "SPEED_2002", "X_Y", "X_Y_2003_02", "SPEED_2002_2004", "OBJECT_2005"];
        assert_eq!(called(&all), wanted);
        let shared = |place| Some(Reason::Shared(place));
        assert_eq!(reasons(&all), [None, shared(0), None, shared(2), shared(1), None]);
    }

    #[test]
    fn an_object_that_shares_its_name_says_so_with_every_entry() {
        let pdo = Some("TPDO parameter");
        let all = [
            named(0x1800, 1, pdo, "COB-ID"),
            named(0x1801, 1, pdo, "COB-ID"),
            named(0x1801, 3, pdo, "Inhibit time"),
        ];
        let wanted =
            ["TPDO_PARAMETER_COB_ID", "TPDO_PARAMETER_COB_ID_1801_01", "TPDO_PARAMETER_INHIBIT_TIME_1801_03"];
        assert_eq!(called(&all), wanted);
        assert_eq!(reasons(&all), [None, Some(Reason::SharedObject(0)), None]);
    }

    #[test]
    fn what_the_side_file_says_comes_first() {
        let (object, given) = (Some("Pressure"), Some("SPEED"));
        let all = [
            named(0x2001, 0, None, "Speed"),
            Named { given, ..named(0x2002, 0, None, "x") },
            Named { given_object: Some("P"), ..named(0x2003, 1, object, "Inlet") },
            Named { given_object: Some("P"), ..named(0x2003, 2, object, "Pressure 2") },
        ];
        assert_eq!(called(&all), ["SPEED_2001", "SPEED", "P_INLET", "P_2"]);
        assert_eq!(reasons(&all)[0], Some(Reason::Shared(1)));
    }

    #[test]
    fn what_is_cut_and_lost_is_known() {
        let long = "ab".repeat(40);
        let all = [
            named(0x2001, 0, None, &long),
            named(0x2002, 0, None, "\u{901F}\u{5EA6} A"),
            named(0x2003, 1, Some("\u{416}"), "Level"),
        ];
        assert_eq!(reasons(&all), [Some(Reason::Cut), Some(Reason::Lost), Some(Reason::Lost)]);
        let all = called(&all);
        assert_eq!((all[0].len(), &*all[1], &*all[2]), (60, "A", "LEVEL"));
        let object = Some("Dual loop position control parameter set of the main axis");
        let all = [
            named(0x2001, 1, object, "Main loop filter coefficient a"),
            named(0x2001, 2, object, "Main loop filter coefficient b"),
            named(0x2001, 3, object, "Gain"),
            named(0x2001, 0, object, "Highest sub-index supported"),
            named(0x2002, 0, None, "Number of mapped application objects in the process data object"),
        ];
        let wanted = [
            "DUAL_LOOP_POSITION_CONTROL_MAIN_LOOP_FILTER_COEFFICIENT_A",
            "DUAL_LOOP_POSITION_CONTROL_MAIN_LOOP_FILTER_COEFFICIENT_B",
            "DUAL_LOOP_POSITION_CONTROL_PARAMETER_SET_OF_THE_MAIN_GAIN",
            "DUAL_LOOP_POSITION_CONTROL_PARAMETER_SET_OF_THE_MAIN_AXIS",
            "NUMBER_OF_MAPPED_APPLICATION_OBJECTS_IN_THE_PROCESS_DATA",
        ];
        assert_eq!(called(&all), wanted);
        assert_eq!(reasons(&all), [Some(Reason::Cut); 5]);
    }

    #[test]
    fn no_name_is_there_twice() {
        let texts = ["", "Speed", "speed", "Speed 2002", "Object 2001", "Object 2001 01 2001 01", "\u{901F}"];
        let objects = [None, Some(""), Some("Speed"), Some("\u{5EA6}")];
        let array = |object, name| Named { sub_index: None, ..named(0x2001, 1, object, name) };
        for (first, second) in texts.into_iter().flat_map(|first| texts.map(|second| (first, second))) {
            for object in objects {
                let all = [
                    array(object, ""),
                    named(0x2001, 1, object, first),
                    named(0x2001, 1, object, second),
                    named(0x2002, 0, None, first),
                    named(0x2003, 1, object, second),
                    Named { given: Some("SPEED"), ..named(0x2004, 0, None, second) },
                ];
                let called = called(&all);
                let is_name = |name: &String| {
                    name.starts_with(|first: char| first.is_ascii_uppercase())
                        && name
                            .bytes()
                            .all(|byte| byte == b'_' || byte.is_ascii_uppercase() || byte.is_ascii_digit())
                };
                assert!(called.iter().all(is_name), "{called:?}");
                assert_eq!(called.iter().collect::<HashSet<_>>().len(), all.len(), "{called:?}");
            }
        }
    }

    #[test]
    fn an_array_is_called_before_its_elements() {
        let element = |name| Named { is_element: true, ..named(0x1016, 1, Some("Consumer Time"), name) };
        let array = Named { sub_index: None, ..named(0x1016, 1, Some("Consumer Time"), "") };
        let all = [array, element("Consumer Time"), element("Time 2")];
        assert_eq!(called(&all)[..2], ["CONSUMER_TIME", "CONSUMER_TIME_1016_01"]);
        assert_eq!(reasons(&all), [None; 3]);
    }
}
