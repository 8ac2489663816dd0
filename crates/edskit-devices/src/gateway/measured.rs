//! What the gateway shows and nobody can set.

use super::name::Name;
use super::parameter::Quantity;

/// The name of a measured value of the gateway (list 2: 11.1, 11.3; GW-APP-38 to GW-APP-42).
///
/// ```
/// use edskit_devices::gateway::measured_value;
/// assert_eq!(measured_value(12412), Some("CanOpInitErr"));
/// assert_eq!(measured_value(427), None);
/// ```
#[must_use]
pub fn measured_value(number: u16) -> Option<&'static str> {
    let place = MEASURED_VALUES.binary_search_by_key(&number, |(own, _)| *own).ok()?;
    MEASURED_VALUES.get(place).map(|(_, name)| *name)
}

/// The number of a measured value of the gateway with this name, in any case and with or without blanks.
///
/// ```
/// use edskit_devices::gateway::measured_value_by_name;
/// assert_eq!(measured_value_by_name("canopiniterr"), Some(12412));
/// ```
#[must_use]
pub fn measured_value_by_name(name: &str) -> Option<u16> {
    MEASURED_VALUES.iter().find(|(_, own)| Name::plain(own).is(name)).map(|(number, _)| *number)
}

/// What a measured value is a number of (11.3).
pub(super) const fn quantity(number: u16) -> Quantity {
    match number {
        2401..=2404 | 2410 | 2411 | 2424 | 2425 | 3099 | 3196..=3198 | 3895..=3898 | 12410 => Quantity::Bits,
        3600 => Quantity::Volts,
        3865 => Quantity::FineMilliseconds,
        3870 => Quantity::Seconds,
        _ => Quantity::Number,
    }
}

/// Every measured value that the lists of the manual name, in the order of the numbers (11.1, 11.3).
pub const MEASURED_VALUES: &[(u16, &str)] = &[
    (2401, "CanTxBufferState"),
    (2402, "CanRxBufferState"),
    (2403, "CanRxTimeout"),
    (2404, "CanTypeMismatch"),
    (2405, "CanOnline"),
    (2406, "CanState"),
    (2410, "CanDCNodeState31to16"),
    (2411, "CanDCNodeState15to01"),
    (2424, "CanPCNodeState31to16"),
    (2425, "CanPCNodeState15to01"),
    (3070, "ErrCanBus1"),
    (3071, "ErrCanComm1"),
    (3072, "ErrCanBus2"),
    (3073, "ErrCanComm2"),
    (3074, "ErrCanOpen"),
    (3076, "ErrParamStore"),
    (3077, "ErrProgramTest"),
    (3078, "ErrRAMTest"),
    (3085, "ErrVoltage"),
    (3090, "ErrData"),
    (3093, "ErrStack"),
    (3094, "ErrIntern"),
    (3099, "EEPROMErrorCode"),
    (3170, "SErrCanBus1"),
    (3171, "SErrCanComm1"),
    (3172, "SErrCanBus2"),
    (3173, "SErrCanComm2"),
    (3174, "SErrCanOpen"),
    (3176, "SErrParamStore"),
    (3177, "SErrProgramTest"),
    (3178, "SErrRAMTest"),
    (3185, "SErrVoltage"),
    (3190, "SErrData"),
    (3193, "SErrStack"),
    (3194, "SErrIntern"),
    (3195, "SExceptionNumber"),
    (3196, "SExceptionAddrLow"),
    (3197, "SExceptionAddrHigh"),
    (3198, "SExceptionFlag"),
    (3600, "PowerSupply"),
    (3840, "HardwareVersion"),
    (3841, "AddHardwareVersion"),
    (3842, "SoftwareVersion"),
    (3843, "BootSoftwareVersion"),
    (3844, "SerialDate"),
    (3845, "SerialNumber"),
    (3850, "Identifier"),
    (3851, "LastIdentifier"),
    (3865, "CalculationTime"),
    (3870, "Timer"),
    (3895, "RAMTestAddr"),
    (3896, "RAMTestPattern"),
    (3897, "CStackTestFreeBytes"),
    (3898, "IStackTestFreeBytes"),
    (12400, "CanOpState"),
    (12401, "CanOpStopped"),
    (12402, "CanOpInit"),
    (12403, "CanOpPreOperational"),
    (12404, "CanOpOperational"),
    (12405, "CanOpOnline"),
    (12410, "CanOpErr"),
    (12411, "CanOpDCResetErr"),
    (12412, "CanOpInitErr"),
    (12413, "CanOpTimeCtrlErr"),
    (12414, "CanOpDCErrCanBus"),
    (12415, "CanOpDCErrCanComm"),
    (12419, "CanOpGWResetErr"),
    (12420, "CanOpHeartbeatErr"),
    (12421, "CanOpGWErrCanBus1"),
    (12422, "CanOpGWErrCanComm1"),
    (12423, "CanOpGWErrCanBus2"),
    (12424, "CanOpGWErrCanComm2"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_is_sorted_and_holds_no_parameter() {
        assert!(MEASURED_VALUES.is_sorted_by(|(a, _), (b, _)| a < b));
        for (number, name) in MEASURED_VALUES {
            assert_eq!(measured_value(*number), Some(*name));
            assert_eq!(
                crate::gateway::Parameter::find(crate::gateway::Owner::Gateway, *number),
                None,
                "{number}"
            );
        }
    }
}
