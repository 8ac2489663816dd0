//! The lists of parameters and measured values of the Heinzmann CANopen gateway, where its manual has two readings.

use edskit_devices::gateway::{Owner, Parameter, measured_value};

#[test]
fn errors_have_the_names_of_the_main_program() {
    // GW-NOTE-31
    assert_eq!([3076, 3078].map(measured_value), [Some("ErrParamStore"), Some("ErrRAMTest")]);
    // GW-NOTE-32
    let communication = [12422, 12424].map(measured_value);
    assert_eq!(communication, [Some("CanOpGWErrCanComm1"), Some("CanOpGWErrCanComm2")]);
    // GW-NOTE-35: those without S are the bootloader's.
    let exception = ["SExceptionNumber", "SExceptionAddrLow", "SExceptionAddrHigh", "SExceptionFlag"];
    assert_eq!([3195, 3196, 3197, 3198].map(measured_value), exception.map(Some));
    assert!((3095..=3098).all(|number| measured_value(number).is_none()));
}

#[test]
fn only_the_gateway_has_a_propagation_segment() {
    // GW-NOTE-38
    for (owner, last) in [(Owner::Gateway, 415), (Owner::Governor, 414)] {
        let is_segment = |number| Parameter::find(owner, number).is_some();
        assert_eq!((410..=415).filter(|number| is_segment(*number)).max(), Some(last), "{owner:?}");
    }
}
