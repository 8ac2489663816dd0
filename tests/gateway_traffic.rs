//! Hours of the gateway on a bus in virtual time: nothing is lost, nothing drifts, no error comes.

use edskit_devices::gateway::{Configuration, Engine, Gateway, Owner, Parameter, State};
use edskit_host::{Bus, MemoryStorage, Station, VirtualBus, simulate};
use edskit_runtime::types::CanId;
use edskit_runtime::{Frame, Instant, Microseconds};
use std::collections::BTreeMap;

/// How long the traffic goes on: an hour here, where a program without optimisation has to keep up.
const SECONDS: u64 = 3600;
/// When the master starts the gateway: the time of a main cycle of the governor, 200 ms and 51 cycles behind the start.
const START: Instant = Instant(200_000 + 51 * 15_625);
/// How often the master sends its RPDOs and its heartbeat.
const PERIOD: Microseconds = Microseconds(80_000);

/// TPDO 1 to 4 and 16, a sensor and a switch function with monitored RPDOs, heartbeats in both directions.
fn configuration() -> Configuration {
    let mut configuration = Configuration::new();
    let of_gateway = [(428, 9), (429, 1000), (430, 100), (16415, 0x57F), (426, 250)];
    let of_governor = [
        (14401, 1),
        (14402, 1),
        (16400, 2000),
        (16401, 2031),
        (16448, 2905),
        (16460, 16),
        (16472, 100),
        (900, 1),
        (4900, 3),
        (827, 1),
        (4827, 3),
        (16480, 100),
        (16481, 100),
    ];
    let of = |owner, values: &[(u16, i32)]| {
        values.iter().map(|&(number, value)| (owner, number, value)).collect::<Vec<_>>()
    };
    for (owner, number, value) in
        [of(Owner::Gateway, &of_gateway), of(Owner::Governor, &of_governor)].concat()
    {
        let parameter = Parameter::find(owner, number).expect("the parameter is known");
        configuration.set(parameter, value).expect("the value is in range");
    }
    configuration
}

fn frame(can_id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(can_id).expect("11 bits"), data)
}

// GW-TIMING-02, GW-TIMING-08, GW-TIMING-12
#[test]
fn an_hour_of_traffic() {
    let gateway = Gateway::new(configuration(), Engine::new(), MemoryStorage::default());
    let bus = VirtualBus::new(gateway.bit_rate().expect("a bit rate is set"));
    let mut station = Station::new(gateway, bus.attach());
    let mut master = bus.attach();
    let mut counts: BTreeMap<u32, u64> = BTreeMap::new();
    let mut next = START;
    let mut device = |_| station.round().expect("a virtual bus stays");
    let mut tool = |now: Instant| {
        while let Some(received) = master.receive().expect("a virtual bus stays") {
            *counts.entry(received.frame.can_id().raw()).or_default() += 1;
        }
        if now >= next {
            let start = frame(0, &[1, 0]);
            let [low, high] = 1200_u16.to_le_bytes();
            let others = [frame(0x201, &[0; 6]), frame(0x301, &[low, high]), frame(0x709, &[5])];
            for frame in [start].iter().filter(|_| next == START).chain(&others) {
                master.send(frame).expect("the bus has room");
            }
            next = next + PERIOD;
        }
        next
    };
    simulate(&bus, &mut [&mut device, &mut tool], Instant(START.0 + SECONDS * 1_000_000));
    assert_eq!(station.device.state(), State::Operational);
    assert!(station.device.errors().next().is_none());
    let expected = [(0x481, 15_625), (0x57F, 93_750), (0x701, 992_000)];
    for (can_id, cycle) in expected {
        let expected = SECONDS * 1_000_000 / cycle;
        let count = counts.remove(&can_id).unwrap_or_default();
        // The boot-up message and the first heartbeat come before the start.
        assert!(count.abs_diff(expected) <= 2, "{can_id:03X}h: {count} instead of {expected}");
    }
    let speed = station.device.traffic(&station.device.pdos().expect("it is initialised").tpdos[3]);
    let [low, high, ..] = *speed.data() else { panic!("TPDO 4 has words") };
    assert!(
        u16::from_le_bytes([low, high]).abs_diff(1200) <= 2,
        "the engine follows the setpoint of CANopen"
    );
    // No error comes, so TPDO 1 and 2 are sent once; TPDO 3 tells how the engine reaches its speed.
    let status = counts.remove(&0x381).unwrap_or_default();
    assert!((2..20).contains(&status), "{status} times");
    assert_eq!(counts, BTreeMap::from([(0x181, 1), (0x281, 1)]));
}
