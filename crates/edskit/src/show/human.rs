//! The device as text.

use super::layout;
use super::view::{DeviceView, EntryView, Further, ObjectView, PdoView, titled};
use std::io::{self, Write};

/// Columns of a name before it is cut; longer ones are rare and would push everything aside.
const NAME_WIDTH: usize = 40;

pub(super) fn device(view: &DeviceView<'_>, out: &mut dyn Write) -> io::Result<()> {
    let known = |text: &Option<String>| text.clone().unwrap_or_else(|| "?".to_owned());
    writeln!(out, "{} - {}", known(&view.product_name), known(&view.vendor_name))?;
    writeln!(
        out,
        "  identity     vendor {}, product {}, revision {}",
        known(&view.vendor_number),
        known(&view.product_number),
        known(&view.revision_number)
    )?;
    if let Some(order_code) = &view.order_code {
        writeln!(out, "  order code   {order_code}")?;
    }
    writeln!(out, "  file         {}, CiA 306 edition {}", known(&view.file_name), known(&view.eds_version))?;
    if let Some(description) = &view.file_description {
        writeln!(out, "  description  {description}")?;
    }
    let rates: Vec<String> = view.bit_rates.iter().map(u16::to_string).collect();
    let rates =
        if rates.is_empty() { "none stated".to_owned() } else { format!("{} kbit/s", rates.join(", ")) };
    writeln!(out, "  bit rates    {rates}")?;
    match view.granularity {
        Some(0) => writeln!(out, "  mapping      fixed")?,
        Some(bits) => writeln!(out, "  mapping      in units of {bits} bits")?,
        None => {}
    }
    if let Some(supported) = view.lss_supported {
        writeln!(out, "  LSS          {}", if supported { "supported" } else { "not supported" })?;
    }
    if let Some(node_id) = view.node_id {
        let name = view.node_name.as_deref().map(|name| format!(" `{name}`")).unwrap_or_default();
        let rate = view.bit_rate.map(|rate| format!(" at {rate} kbit/s")).unwrap_or_default();
        writeln!(out, "  node         {node_id}{name}{rate}")?;
    }
    if !view.modules.is_empty() {
        writeln!(out, "  modules      {}", view.modules.join(", "))?;
    }
    writeln!(out, "\nObjects ({})\n", view.objects.len())?;
    table_header(out)?;
    for object in view.objects.differing() {
        object_rows(&object, out)?;
    }
    if !view.pdos.is_empty() {
        writeln!(out, "\nPDOs ({})", view.pdos.len())?;
    }
    for view in &view.pdos {
        pdo(view, out)?;
    }
    let (received, transmitted) = view.implicit_pdos;
    if received + transmitted > 0 {
        writeln!(out, "\n{received} RPDOs and {transmitted} TPDOs more exist through CompactPDO")?;
    }
    Ok(())
}

pub(super) fn object(view: &ObjectView, pdo_view: Option<&PdoView>, out: &mut dyn Write) -> io::Result<()> {
    let code = view.object_code.unwrap_or("object of an unknown kind");
    let list = view.list.map(|list| format!(", {list}")).unwrap_or_default();
    writeln!(out, "{:04X}h {} ({code}{list})\n", view.index, view.name)?;
    table_header(out)?;
    for entry in &view.entries {
        entry_row(entry, &format!("{:04X}:{:02X}", entry.index, entry.sub_index), out)?;
    }
    // A variable is its only entry.
    if view.entries.iter().all(|entry| entry.further.lines().next().is_none()) {
        further(&view.further, out)?;
    }
    match pdo_view {
        Some(view) => pdo(view, out),
        None => Ok(()),
    }
}

fn table_header(out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{:<9}{:<NAME_WIDTH$} {:<16}{:<7}{:<5}value", "entry", "name", "type", "access", "PDO")
}

fn object_rows(object: &ObjectView, out: &mut dyn Write) -> io::Result<()> {
    let place = format!("{:04X}", object.index);
    if let [entry] = &object.entries[..]
        && entry.sub_index == 0
        && entry.name == object.name
    {
        return entry_row(entry, &place, out);
    }
    let code = object.object_code.unwrap_or("?");
    let compact = match object.compact {
        0 => String::new(),
        count => format!(" of {count} equal entries"),
    };
    writeln!(out, "{place:<9}{:<NAME_WIDTH$} {code}{compact}", shortened(&object.name))?;
    for entry in &object.entries {
        entry_row(entry, &format!("    :{:02X}", entry.sub_index), out)?;
    }
    further(&object.further, out)
}

/// What few sections say: one line each.
fn further(further: &Further, out: &mut dyn Write) -> io::Result<()> {
    further.lines().try_for_each(|(key, value)| writeln!(out, "{:<9}{key}: {value}", ""))
}

fn entry_row(entry: &EntryView, place: &str, out: &mut dyn Write) -> io::Result<()> {
    let mut value = match (&entry.value, &entry.default) {
        (Some(value), Some(default)) => format!("{value} (default {default})"),
        (Some(text), None) | (None, Some(text)) => text.clone(),
        (None, None) => String::new(),
    };
    if let Some(evaluated) = entry.evaluated {
        value = format!("{value} = {evaluated:X}h");
    }
    if entry.low_limit.is_some() || entry.high_limit.is_some() {
        let limit = |text: &Option<String>| text.clone().unwrap_or_default();
        value = format!("{value}  [{}..{}]", limit(&entry.low_limit), limit(&entry.high_limit));
    }
    let name = titled(&entry.name, entry.denotation.as_deref());
    let row = format!(
        "{place:<9}{:<NAME_WIDTH$} {:<16}{:<7}{:<5}{value}",
        shortened(&name),
        entry.data_type.as_deref().unwrap_or("?"),
        entry.access.as_deref().unwrap_or("?"),
        if entry.mappable { "yes" } else { "-" },
    );
    writeln!(out, "{}", row.trim_end())?;
    further(&entry.further, out)
}

fn pdo(view: &PdoView, out: &mut dyn Write) -> io::Result<()> {
    let cob_id = view.cob_id.as_deref().unwrap_or("unknown");
    let mut line =
        format!("{} ({:04X}h/{:04X}h), COB-ID {cob_id}", view.name, view.communication, view.mapping);
    if view.valid == Some(false) {
        line.push_str(" (not valid)");
    }
    if let (Some(kind), Some(words)) = (view.transmission_type, &view.transmission) {
        line.push_str(&format!(", type {kind} ({words})"));
    }
    if let Some(time) = view.inhibit_time.filter(|time| *time > 0) {
        line.push_str(&format!(", inhibit time {}.{} ms", time / 10, time % 10));
    }
    if let Some(time) = view.event_timer.filter(|time| *time > 0) {
        line.push_str(&format!(", event timer {time} ms"));
    }
    writeln!(out, "\n  {line}")?;
    if view.mapped.is_empty() {
        writeln!(out, "    nothing mapped")
    } else {
        layout::write(&view.mapped, view.bits, out)
    }
}

/// A text of at most [`NAME_WIDTH`] characters.
fn shortened(text: &str) -> String {
    if text.chars().count() <= NAME_WIDTH {
        return text.to_owned();
    }
    text.chars().take(NAME_WIDTH - 1).chain(['…']).collect()
}
