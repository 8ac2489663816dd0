//! Which entry is meant.

use crate::cli::parse_place;
use crate::live::{KnownDevice, full_name, object_name};
use crate::printable;
use edskit_types::{Index, SubIndex};

/// How many other names a message lists.
const MOST_NAMES: usize = 8;

type Place = (Index, SubIndex);

/// The entry that a text names: index and sub-index in hexadecimal, or with an EDS a name. A text that is both means the
/// index, unless the file has only the name.
pub(super) fn find(text: &str, device: Option<&KnownDevice>) -> Result<Place, String> {
    let place = parse_place(text).map(|place| (Index(place.index), SubIndex(place.sub_index.unwrap_or(0))));
    let Some(device) = device else {
        return place.map_err(|reason| format!("{reason}; names of entries need --eds"));
    };
    match place {
        Ok(place) if device.sheet.object(place.0).is_some() => Ok(place),
        Ok(place) => by_name(text, device).or(Ok(place)),
        Err(_) => by_name(text, device),
    }
}

fn by_name(text: &str, device: &KnownDevice) -> Result<Place, String> {
    let names = names(device);
    // The whole name counts first, then that of the entry, then that of the object.
    let ways: [fn(&Named) -> &str; 3] = [|named| &named.full, |named| &named.own, |named| &named.object];
    for way in ways {
        let found: Vec<&Named> = names.iter().filter(|named| way(named) == text).collect();
        match found[..] {
            [] => {}
            [one] => return Ok(one.place),
            _ => {
                return Err(format!(
                    "{}: {} entries are called `{text}`:{}",
                    device.file,
                    found.len(),
                    list(&found)
                ));
            }
        }
    }
    let wanted = text.to_lowercase();
    let similar: Vec<&Named> =
        names.iter().filter(|named| named.full.to_lowercase().contains(&wanted)).collect();
    let rest = match similar[..] {
        [] => "; `edskit show` lists all of them".to_owned(),
        _ => format!("; similar are:{}", list(&similar)),
    };
    Err(format!("{}: no entry is called `{text}`{rest}", device.file))
}

/// An entry with the names that people may give it.
struct Named {
    place: Place,
    full: String,
    own: String,
    object: String,
}

fn names(device: &KnownDevice) -> Vec<Named> {
    let objects = device.sheet.objects();
    let entries = objects.flat_map(|object| object.dictionary_entries().map(move |entry| (object, entry)));
    let named = entries.map(|(object, entry)| Named {
        place: (entry.index, entry.sub_index),
        full: full_name(object, entry),
        own: printable::line(&entry.name()),
        object: object_name(object),
    });
    named.collect()
}

fn list(found: &[&Named]) -> String {
    let mut text = String::new();
    for Named { place: (index, sub_index), full, .. } in found.iter().take(MOST_NAMES) {
        text += &format!("\n  {index}:{sub_index} {full}");
    }
    if found.len() > MOST_NAMES {
        text += &format!("\n  and {} more", found.len() - MOST_NAMES);
    }
    text
}
