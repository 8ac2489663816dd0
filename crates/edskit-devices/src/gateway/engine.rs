//! A simple engine with its governor, so that values move.

use super::governor::Governor;
use super::inputs::{Inputs, Sensor};
use super::parameter::{Owner, Parameter, known};
use super::signal::{NamedSignals, SignalType, Signals};

/// P811 FunctIdleSpeed, P827 FunctSetpoint2Or1 and P835 FunctLoadEnable (7.1.4.1).
const IDLE_SPEED: Parameter = known(Owner::Governor, 811);
const SETPOINT_2_OR_1: Parameter = known(Owner::Governor, 827);
const LOAD_ENABLE: Parameter = known(Owner::Governor, 835);
/// The assignments of external setpoint 1 and 2 and of the current load (7.1.4.2).
const SETPOINT_1: Parameter = known(Owner::Governor, 900);
const SETPOINT_2: Parameter = known(Owner::Governor, 901);
const CURRENT_LOAD: Parameter = known(Owner::Governor, 917);

/// The speed at idle, in 1/min.
const IDLE: u16 = 700;
/// The highest setpoint, in 1/min.
const MOST_SPEED: u16 = 3000;
/// The actuator fully open, in 0.01 %.
const OPEN: i32 = 10_000;
/// The highest load, in 0.1 %.
const MOST_LOAD: u16 = 1000;
/// Values are kept in so many parts of their unit, so that slow changes are not lost.
const PARTS: i32 = 256;
/// The errors that belong to the engine and its sensors, 3000 to 3069.
const ENGINE_ERRORS: u128 = (1 << 70) - 1;

/// A diesel engine with a speed governor: the speed follows setpoint and load.
///
/// The manual leaves the internal ranges of values to the governor. Here the speeds are in 1/min, positions in 0.01 %, the
/// oil pressure in mbar, the charge air temperature in 0.1 °C and the load in 0.1 %.
///
/// What comes from CANopen goes before what is set here: external setpoints, the load, and the switch functions idle
/// speed, setpoint 2 or 1, and load enable. A faulty sensor is replaced by what is set.
#[derive(Clone, Debug)]
pub struct Engine {
    setpoint: u16,
    load: u16,
    is_wanted: bool,
    errors: u128,
    /// The setpoint and the load that count, after CANopen.
    present_setpoint: u16,
    present_load: u16,
    has_load_control: bool,
    /// In parts of 1/min and of 0.01 %.
    speed: i32,
    position: i32,
    position_setpoint: i32,
    integral: i32,
    /// In parts of 0.1 °C.
    temperature: i32,
}

impl Engine {
    /// An engine that stands, and is to run at 1500/min without load.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            setpoint: 1500,
            load: 0,
            is_wanted: true,
            errors: 0,
            present_setpoint: 0,
            present_load: 0,
            has_load_control: false,
            speed: 0,
            position: 0,
            position_setpoint: 0,
            integral: 0,
            temperature: 250 * PARTS,
        }
    }

    /// The speed setpoint where CANopen brings none, in 1/min, up to 3000.
    pub fn set_setpoint(&mut self, speed: u16) {
        self.setpoint = speed.min(MOST_SPEED);
    }

    /// The load where CANopen brings none, in 0.1 %, up to 1000.
    pub fn set_load(&mut self, load: u16) {
        self.load = load.min(MOST_LOAD);
    }

    /// Whether the engine is to run. The engine stop is hard wired: CANopen cannot bring it (7.1.4.1; GW-CFG-05).
    pub fn set_running(&mut self, is_wanted: bool) {
        self.is_wanted = is_wanted;
    }

    /// An error of the engine or its own sensors comes or goes, 3000 to 3069; false for other numbers.
    pub fn set_error(&mut self, number: u16, is_present: bool) -> bool {
        let bit = number.checked_sub(3000).and_then(|nth| 1_u128.checked_shl(nth.into())).unwrap_or(0);
        let bit = bit & ENGINE_ERRORS;
        self.errors = if is_present { self.errors | bit } else { self.errors & !bit };
        bit != 0
    }

    /// The setpoint and the load of this main cycle.
    fn take(&mut self, inputs: &Inputs<'_>) {
        let valid = |assignment, or| match inputs.sensor(assignment) {
            Some(Sensor::Valid(value)) => value,
            _ => or,
        };
        let is_active = |function| inputs.switch_function(function).unwrap_or(false);
        self.present_load = valid(CURRENT_LOAD, self.load).min(MOST_LOAD);
        self.has_load_control = is_active(LOAD_ENABLE);
        let assignment = if is_active(SETPOINT_2_OR_1) { SETPOINT_2 } else { SETPOINT_1 };
        self.present_setpoint = match is_active(IDLE_SPEED) {
            true => IDLE,
            false => valid(assignment, self.setpoint).min(MOST_SPEED),
        };
        if self.has_load_control {
            // A droop of 4 % at full load.
            let droop = u32::from(self.present_setpoint) * u32::from(self.present_load) / 25_000;
            self.present_setpoint = self.present_setpoint.saturating_sub(droop as u16);
        }
    }
}

impl Default for Engine {
    fn default() -> Self {
        Self::new()
    }
}

impl Signals for Engine {
    fn signal_type(&self, number: u16) -> Option<SignalType> {
        NamedSignals.signal_type(number)
    }
}

impl Governor for Engine {
    fn start(&mut self) {
        (self.position_setpoint, self.integral) = (0, 0);
    }

    fn main_cycle(&mut self, inputs: &Inputs<'_>) {
        self.take(inputs);
        let difference = i32::from(self.present_setpoint) * PARTS - self.speed;
        let open = OPEN * PARTS;
        self.integral = (self.integral + difference / 16).clamp(0, open);
        let wanted = (self.integral + 4 * difference).clamp(0, open);
        self.position_setpoint = if self.is_wanted { wanted } else { 0 };
        if !self.is_wanted {
            self.integral = 0;
        }
        self.position += (self.position_setpoint - self.position) / 4;
        // What the load and the friction take, as a part of the torque at full opening.
        let taken = i32::from(self.present_load) * 8 * PARTS + self.speed / 2;
        self.speed = (self.speed + (self.position - taken) / 256).max(0);
        let warm = (400 + i32::from(self.present_load)) * PARTS;
        self.temperature += (warm - self.temperature) / 512;
    }

    fn value(&self, number: u16) -> u16 {
        let whole = |parts: i32| (parts / PARTS) as u16;
        match number {
            2000 => whole(self.speed),
            2031 => self.present_setpoint,
            2300 => whole(self.position),
            2330 => whole(self.position_setpoint),
            2905 => whole(self.speed) * 3,
            2908 => whole(self.temperature),
            2917 => self.present_load,
            _ => 0,
        }
    }

    /// Bit 0: the engine turns; bit 1: its speed is within 10/min of the setpoint; bit 2: load control is enabled; bit 3:
    /// it is not to run; bit 7: an error is present (our choice; GW-NOTE-04).
    fn engine_status(&self) -> u8 {
        let speed = self.value(2000);
        u8::from(speed > 0)
            | u8::from(speed.abs_diff(self.present_setpoint) <= 10) << 1
            | u8::from(self.has_load_control) << 2
            | u8::from(!self.is_wanted) << 3
            | u8::from(self.errors != 0) << 7
    }

    fn errors(&self) -> u128 {
        self.errors
    }
}

#[cfg(test)]
mod tests {
    use super::super::Configuration;
    use super::super::inputs::Reception;
    use super::*;
    use std::vec::Vec;

    /// The engine after so many seconds.
    fn run(engine: &mut Engine, seconds: u32) {
        let configuration = Configuration::new();
        let inputs = Inputs { configuration: &configuration, reception: Reception::default() };
        (0..64 * seconds).for_each(|_| engine.main_cycle(&inputs));
    }

    #[test]
    fn the_speed_follows_setpoint_and_load() {
        let mut engine = Engine::new();
        run(&mut engine, 60);
        let at_no_load = (engine.value(2000), engine.value(2300));
        assert!(at_no_load.0.abs_diff(1500) <= 2, "{at_no_load:?}");
        engine.set_load(800);
        let mut lowest = u16::MAX;
        for _ in 0..60 {
            run(&mut engine, 1);
            lowest = lowest.min(engine.value(2000));
        }
        assert!(lowest < 1490 && engine.value(2000).abs_diff(1500) <= 2, "{lowest}");
        assert!(engine.value(2300) > at_no_load.1 + 1000, "more load takes more fuel");
        engine.set_setpoint(1000);
        run(&mut engine, 60);
        assert!(engine.value(2000).abs_diff(1000) <= 2);
        assert_eq!(engine.engine_status(), 0b011);
        engine.set_running(false);
        run(&mut engine, 60);
        assert_eq!((engine.value(2000), engine.value(2330)), (0, 0));
        assert_eq!(engine.engine_status(), 0b1000);
    }

    #[test]
    fn errors_of_the_engine_only() {
        let mut engine = Engine::new();
        let set: Vec<bool> =
            [2999, 3000, 3069, 3070, 4000].map(|number| engine.set_error(number, true)).into();
        assert_eq!(set, [false, true, true, false, false]);
        assert_eq!(engine.errors(), 1 | 1 << 69);
        engine.set_error(3000, false);
        assert_eq!((engine.errors(), engine.engine_status() >> 7), (1 << 69, 1));
    }

    // GW-PDO-07
    #[test]
    fn every_named_signal_has_a_value() {
        let mut engine = Engine::new();
        engine.set_load(500);
        run(&mut engine, 30);
        for signal in super::super::NAMED_SIGNALS {
            assert!(engine.value(signal.number) > 0, "{}", signal.name);
        }
    }
}
