//! Values that depend on the node-ID, or are meant to: `$NODEID+0x180`.

use super::typed;
use crate::Context;
use edskit_model::meant::{formula, is_hexadecimal, value_length};
use edskit_model::{Entry, Formula, Shape};

/// Where something that is meant as a formula stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Place {
    /// In a value or limit of an integer type, or of a type that is not known.
    Value,
    /// In a key that is always a number.
    Number,
}

/// The entries whose value is meant as a formula: it holds `$`, or it is a sum with the node-ID. Where a comment stands
/// behind the value, SYN012 comes first.
pub(super) fn entries<'a>(context: &Context<'a>) -> impl Iterator<Item = (Entry<'a>, Place)> {
    context.odd_entries().filter_map(|entry| place(entry).map(|place| (entry, place)))
}

/// The formulas that can be understood, however they are written.
pub(super) fn understood<'a>(context: &Context<'a>) -> impl Iterator<Item = (Entry<'a>, Formula)> {
    context.odd_entries().filter(|entry| entry.raw().contains(&b'$')).filter_map(|entry| {
        (place(entry) == Some(Place::Value)).then_some(())?;
        Some((entry, Formula::parse(entry.raw()).ok()?))
    })
}

fn place(entry: Entry<'_>) -> Option<Place> {
    let raw = entry.raw();
    let dollar = raw.contains(&b'$');
    let is_sum = raw.contains(&b'+');
    let is_text = matches!(entry.key().name.shape(), Shape::Text(_));
    if is_text || !(dollar || is_sum) || value_length(raw).is_some() || is_hexadecimal(raw) {
        return None;
    }
    match typed::shape(entry) {
        Shape::Unsigned(_) if dollar => Some(Place::Number),
        Shape::Value => {
            let is_integer = entry.section().and_then(typed::data_type).map(|known| known.is_integer());
            let is_meant = match is_integer {
                Some(is_integer) => is_integer && (dollar || formula(raw).is_some()),
                None => formula(raw).is_some(),
            };
            is_meant.then_some(Place::Value)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FileKind;
    use edskit_model::Datasheet;

    #[test]
    fn places_depend_on_key_and_type() {
        let text = "[1400sub1]\nDataType=0x7\nDefaultValue=$NODEID+0x200\nHighLimit=node\n\
                    [1008]\nParameterName=Node $NODEID\nDataType=0x9\nDefaultValue=$NODEID\n\
                    [2000]\nDefaultValue=$5\nLowLimit=$NodeID ; x\nHighLimit=NODEID+1\nSubNumber=$NODEID\n\
                    [x]\na=$NODEID\n[DeviceComissioning]\nNodeID=5\nNodeName=$NODEID";
        let sheet = Datasheet::parse(text.as_bytes());
        let context = Context::new(&sheet, FileKind::Eds, None);
        let found: Vec<_> = entries(&context).map(|(entry, place)| (entry.line_number(), place)).collect();
        assert_eq!(found, [(2, Place::Value), (11, Place::Value), (12, Place::Number)]);
    }
}
