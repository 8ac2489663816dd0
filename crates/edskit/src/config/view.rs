//! The PDOs of a configuration as they are printed.

use super::reading::Reading;
use super::words;
use edskit_devices::gateway::{Pdo, PdoTable, Period, Word};
use serde::Serialize;

/// What follows from a configuration.
#[derive(Serialize)]
pub(super) struct View {
    pub(super) node_id: u8,
    /// In kbit/s; `None` with manual bit timing.
    pub(super) bit_rate: Option<u16>,
    pub(super) pdos: Vec<PdoView>,
    pub(super) heartbeat: HeartbeatView,
    /// The partner's; `None` where there is no partner.
    pub(super) partner_heartbeat: Option<HeartbeatView>,
}

#[derive(Serialize)]
pub(super) struct PdoView {
    pub(super) name: String,
    pub(super) active: bool,
    /// Why it is active or not.
    pub(super) why: String,
    pub(super) can_id: u16,
    /// 0 if it is inactive.
    pub(super) bytes: u8,
    pub(super) time: Option<TimeView>,
    pub(super) content: Vec<ContentView>,
}

/// One word.
#[derive(Serialize)]
pub(super) struct ContentView {
    pub(super) text: String,
    /// Where it is in the object dictionary.
    pub(super) index: u16,
    pub(super) sub_index: u8,
}

#[derive(Serialize)]
pub(super) struct HeartbeatView {
    pub(super) node_id: u8,
    pub(super) can_id: u16,
    /// `None` if it is not sent, or not monitored.
    pub(super) time: Option<TimeView>,
}

/// A time as it is set and as it takes effect.
#[derive(Serialize, Clone, Copy)]
pub(super) struct TimeView {
    pub(super) set_ms: u16,
    pub(super) effective_ms: f64,
    pub(super) main_cycles: u16,
}

impl From<Period> for TimeView {
    fn from(period: Period) -> Self {
        Self {
            set_ms: period.setting_ms,
            effective_ms: f64::from(period.micros()) / 1000.0,
            main_cycles: period.cycles,
        }
    }
}

impl View {
    pub(super) fn new(reading: &Reading, table: &PdoTable) -> Self {
        let configuration = &reading.configuration;
        let heartbeat = |node_id: u8, period: Option<Period>| HeartbeatView {
            node_id,
            can_id: 0x700 + u16::from(node_id),
            time: period.map(TimeView::from),
        };
        let partner = table.partner_node_id;
        Self {
            node_id: table.node_id.get(),
            bit_rate: configuration.bit_rate().map(|rate| rate.kbit_per_s()),
            pdos: table.iter().map(|pdo| pdo_view(reading, pdo)).collect(),
            heartbeat: heartbeat(table.node_id.get(), configuration.heartbeat()),
            partner_heartbeat: (partner != 0)
                .then(|| heartbeat(partner, configuration.heartbeat_monitoring())),
        }
    }
}

fn pdo_view(reading: &Reading, pdo: &Pdo) -> PdoView {
    let content = |word: &Word| ContentView {
        text: words::content(&reading.configuration, &reading.signals, word.source),
        index: word.object.index().0,
        sub_index: word.object.sub_index().0,
    };
    PdoView {
        name: pdo.party().to_string(),
        active: pdo.activity.is_active(),
        why: words::why(&reading.configuration, pdo),
        can_id: pdo.can_id.raw() as u16,
        bytes: pdo.bytes(),
        time: pdo.period.map(TimeView::from),
        content: pdo.words().iter().map(content).collect(),
    }
}
