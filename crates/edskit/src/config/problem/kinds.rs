//! The kinds of problems, each with what `edskit explain` says of it.

use super::Kind;
use edskit_lint::Severity;

macro_rules! kinds {
    ($($(#[doc = $doc:literal])* $kind:ident = $code:literal $name:literal $severity:ident;)*) => {
        $(
            pub(crate) const $kind: &Kind = &Kind {
                code: $code,
                name: $name,
                severity: Severity::$severity,
                lines: &[$($doc),*],
            };
        )*

        /// Every kind, in the order of the codes.
        pub(crate) const ALL: &[&Kind] = &[$($kind),*];
    };
}

// The examples are parameter files without their first line, `device = "heinzmann-canopen-gateway"`, or scenarios. A test
// has each of the first ones give its finding, and none of the second ones.
kinds! {
    /// The file is no TOML
    ///
    /// ## What it does
    /// Reports what the reader of TOML does not understand, and files that are not UTF-8.
    ///
    /// ## Why is this bad
    /// Nothing follows from a file that cannot be read whole.
    ///
    /// ## Example
    /// ```toml
    /// [gateway
    /// 427 = 5
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 427 = 5
    /// ```
    TOML_SYNTAX = "GWC001" "toml-syntax" Error;
    /// `device` is missing or names something else
    ///
    /// ## What it does
    /// Looks for `device = "heinzmann-canopen-gateway"` at the top of a parameter file.
    ///
    /// ## Why is this bad
    /// The numbers of parameters mean something else in every device.
    ///
    /// ## Example
    /// ```toml
    /// device = "heinzmann-gateway"
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// device = "heinzmann-canopen-gateway"
    /// ```
    UNKNOWN_DEVICE = "GWC002" "unknown-device" Error;
    /// A key that the file has no place for
    ///
    /// ## What it does
    /// Reports everything beside `device`, `[gateway]` and `[governor]` in a parameter file, and keys that a scenario or a step
    /// does not have.
    ///
    /// ## Why is this bad
    /// Nothing follows from it, and something was meant.
    ///
    /// ## Example
    /// ```toml
    /// [gatway]
    /// 427 = 5
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 427 = 5
    /// ```
    UNKNOWN_KEY = "GWC003" "unknown-key" Error;
    /// A parameter that the unit does not have
    ///
    /// ## What it does
    /// Reports numbers and names that the lists of the manual do not have. All of `[governor]` are one warning: a governor has
    /// many parameters that the manual of the gateway does not name, and nothing follows from them here.
    ///
    /// ## Why is this bad
    /// The parameter that was meant has its default.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 431 = 5
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 430 = 5
    /// 428 = 2
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1 and 11.1 to 11.5.
    UNKNOWN_PARAMETER = "GWC004" "unknown-parameter" Error;
    /// A measured value is set
    ///
    /// ## What it does
    /// Reports values that the gateway measures, where they are set like parameters.
    ///
    /// ## Why is this bad
    /// They can only be read. A scenario reads them with `read`.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 2411 = 2
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 402 = 1
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 11.3.
    MEASURED_VALUE = "GWC005" "measured-value" Error;
    /// A parameter is set twice
    ///
    /// ## What it does
    /// Reports a key that stands twice, and a parameter that is set under two of its names or numbers. The bit rate of the
    /// governor has two numbers, 409 and 416, and so has the switch of its bit timing, 4409 and 4416; both may be given if they
    /// say the same.
    ///
    /// ## Why is this bad
    /// Only one of the two can be meant.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 427 = 5
    /// CanOpenMyNodeID = 6
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 427 = 5
    /// ```
    DUPLICATE_KEY = "GWC006" "duplicate-key" Error;
    /// Number and name of a key belong to two parameters
    ///
    /// ## What it does
    /// Compares number and name where a key gives both. Names are understood as the lists of the manual spell them, as its
    /// examples do, and with or without blanks.
    ///
    /// ## Why is this bad
    /// One of the two is a mistake, and nobody can tell which.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// "427 CanOpenBaudrate" = 125
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// "426 CanOpenBaudrate" = 125
    /// ```
    NAME_NUMBER_MISMATCH = "GWC007" "name-number-mismatch" Error;
    /// A value is no number
    ///
    /// ## What it does
    /// Reports values of another type than the key takes.
    ///
    /// ## Why is this bad
    /// The parameter has no value.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 427 = "5"
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 427 = 5
    /// ```
    WRONG_TYPE = "GWC008" "wrong-type" Error;
    /// A value that is not possible
    ///
    /// ## What it does
    /// Compares values with the ranges of the manual, and the assignments of switch functions and sensors with the places
    /// that the RPDOs have.
    ///
    /// ## Why is this bad
    /// The PC tool does not take it, or it has no effect.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 426 = 800
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 426 = 1000
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1.4, 11.2, 11.4 and 11.5.
    OUT_OF_RANGE = "GWC009" "out-of-range" Error;
    /// An entry of `[governor.signals]` is not understood
    ///
    /// ## What it does
    /// Reports numbers, names and types that describe no parameter of the governor. A single bit that the manual names stays
    /// one, whatever is written; that is a warning.
    ///
    /// ## Why is this bad
    /// The words of the TPDOs would not be those of the device.
    ///
    /// ## Example
    /// ```toml
    /// [governor.signals]
    /// 2950 = "u32"
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [governor.signals]
    /// 2950 = "u16"
    /// ```
    INVALID_SIGNAL = "GWC010" "invalid-signal" Error;
    /// Two have one identifier, or one that the gateway forbids
    ///
    /// ## What it does
    /// Runs the check that the gateway makes at its initialisation (1 to 8 of 7.3): no two active PDOs have the same
    /// identifier, and none has that of NMT, SYNC, TIME, the gateway's SDO and heartbeat, or its partner's heartbeat.
    ///
    /// ## Why is this bad
    /// The initialisation fails, and after three attempts the gateway stays off CANopen with 12412 CanOpInitErr.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 16404 = 0x182
    /// 427 = 2
    /// [governor]
    /// 14401 = 1
    /// 16404 = 2000
    /// 16461 = 100
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 16404 = 0x1C5
    /// 427 = 2
    /// [governor]
    /// 14401 = 1
    /// 16404 = 2000
    /// 16461 = 100
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.3 and 9.5 on 12412.
    IDENTIFIER_CONFLICT = "GWC011" "identifier-conflict" Error;
    /// Gateway and partner have one node-ID
    ///
    /// ## What it does
    /// Compares P427 CanOpenMyNodeID with P428 CanOpenPartnerNodeID (check 9 of 7.3).
    ///
    /// ## Why is this bad
    /// The initialisation fails, and after three attempts the gateway stays off CANopen with 12412 CanOpInitErr.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 427 = 5
    /// 428 = 5
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 427 = 5
    /// 428 = 6
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.3.
    EQUAL_NODE_IDS = "GWC012" "equal-node-ids" Error;
    /// CiA 301 restricts an identifier that the gateway accepts
    ///
    /// ## What it does
    /// Reports active PDOs on identifiers that CiA 301 keeps for other services.
    ///
    /// ## Why is this bad
    /// The gateway accepts it, and the manual's own example uses 003h; another device on the bus may use it too.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 16404 = 0x003
    /// [governor]
    /// 16404 = 2000
    /// 16461 = 100
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 16404 = 0x1C5
    /// [governor]
    /// 16404 = 2000
    /// 16461 = 100
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2.0, 7.3.5.
    RESTRICTED_CAN_ID = "GWC013" "restricted-can-id" Warning;
    /// The engine stop comes from CANopen
    ///
    /// ## What it does
    /// Reports P4810 = 3.
    ///
    /// ## Why is this bad
    /// The manual forbids it: the engine stop has to be wired.
    ///
    /// ## Example
    /// ```toml
    /// [governor]
    /// 4810 = 3
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [governor]
    /// 4810 = 0
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1.4.1.
    ENGINE_STOP = "GWC014" "engine-stop-from-canopen" Error;
    /// An input comes from CANopen, but from nowhere there
    ///
    /// ## What it does
    /// Reports switch functions and sensors of type 3 (CANopen) whose assignment is 0.
    ///
    /// ## Why is this bad
    /// The switch function is always 0, the sensor is never received.
    ///
    /// ## Example
    /// ```toml
    /// [governor]
    /// 4900 = 3
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [governor]
    /// 4900 = 3
    /// 900 = 1
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1.4.
    UNASSIGNED_INPUT = "GWC015" "unassigned-input" Warning;
    /// Two inputs are at one place
    ///
    /// ## What it does
    /// Reports two switch functions on one bit, or two sensors on one channel.
    ///
    /// ## Why is this bad
    /// It may be meant; more often a number was copied.
    ///
    /// ## Example
    /// ```toml
    /// [governor]
    /// 4900 = 3
    /// 900 = 1
    /// 4901 = 3
    /// 901 = 1
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [governor]
    /// 4900 = 3
    /// 900 = 1
    /// 4901 = 3
    /// 901 = 2
    /// ```
    SHARED_INPUT = "GWC016" "shared-input" Info;
    /// A TPDO is to carry a single bit
    ///
    /// ## What it does
    /// Reports assignments of parameters that are single bits: those that the manual itself names, such as 3074 ErrCanOpen,
    /// 12401 CanOpStopped and 14401 CanOpenSendErrors, and those that `[governor.signals]` describes as `bit`.
    ///
    /// ## Why is this bad
    /// The word is left out and the rest moves up, so that the TPDO is shorter than it looks; a TPDO of bits alone is not
    /// active.
    ///
    /// ## Example
    /// ```toml
    /// [governor]
    /// 16400 = 12401
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [governor]
    /// 14401 = 1
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 4.1.2 and 7.1.2.2.
    NOT_ANALOGUE = "GWC017" "not-analogue" Warning;
    /// Nothing is known of a parameter that a TPDO is to carry
    ///
    /// ## What it does
    /// Reports assignments of parameters that neither the manual names nor `[governor.signals]` describes.
    ///
    /// ## Why is this bad
    /// Whether the governor has it, and with how many bits, decides on the words of the TPDO. It is taken to have 16 bits
    /// without sign.
    ///
    /// ## Example
    /// ```toml
    /// [governor]
    /// 16400 = 2950
    /// 16460 = 100
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [governor]
    /// 16400 = 2950
    /// 16460 = 100
    /// [governor.signals]
    /// 2950 = { name = "ExhaustTemp", type = "i16" }
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1.2.2.
    UNKNOWN_SIGNAL = "GWC018" "unknown-signal" Info;
    /// A time is longer than the longest
    ///
    /// ## What it does
    /// Reports cycle and monitoring times of the governor beyond 255 of its main cycles.
    ///
    /// ## Why is this bad
    /// It counts as 3984.375 ms.
    ///
    /// ## Example
    /// ```toml
    /// [governor]
    /// 16480 = 5000
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [governor]
    /// 16480 = 3900
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1.3.
    CAPPED_TIME = "GWC019" "capped-time" Warning;
    /// A TPDO has data or a cycle time, but not both
    ///
    /// ## What it does
    /// Reports TPDO4 to TPDO16 that are not active because one of the two is missing.
    ///
    /// ## Why is this bad
    /// It is not sent, though something was set up for it.
    ///
    /// ## Example
    /// ```toml
    /// [governor]
    /// 16400 = 2000
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [governor]
    /// 16400 = 2000
    /// 16460 = 100
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.3.
    IDLE_TPDO = "GWC020" "idle-tpdo" Info;
    /// The heartbeat of nobody is monitored
    ///
    /// ## What it does
    /// Reports P430 CanOpHeartBeatRxTime with P428 CanOpenPartnerNodeID = 0.
    ///
    /// ## Why is this bad
    /// There is no node 0, so that the monitoring triggers and all inputs from CANopen are faulty.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 430 = 1000
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 428 = 127
    /// 430 = 1000
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.2.3.
    NO_PARTNER = "GWC021" "no-partner" Warning;
    /// What must be equal in gateway and governor is not
    ///
    /// ## What it does
    /// Compares the node numbers (401 with 403, 402 with 401) and the bit rates (416 with 416 or 409) of the HEINZMANN bus; what
    /// the file does not set has its default. Different start delays (400) are a warning.
    ///
    /// ## Why is this bad
    /// The units do not hear each other: there is no initialisation, no CANopen and no DCF.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 416 = 500
    /// [governor]
    /// 416 = 250
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 416 = 500
    /// [governor]
    /// 416 = 500
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1.1, 7.2.1 and 9.4 on 3070.
    UNITS_DISAGREE = "GWC022" "units-disagree" Error;
    /// Gateway and governor do not talk to each other
    ///
    /// ## What it does
    /// Reports P4400 HzmCanCommDCOn = 0 and P4406 CanCommCMOn = 0.
    ///
    /// ## Why is this bad
    /// There is no initialisation, no CANopen and no DCF.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 4400 = 0
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 4400 = 1
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1.1 and 7.2.1.
    COMMUNICATION_OFF = "GWC023" "communication-off" Warning;
    /// An identifier is written in decimal digits
    ///
    /// ## What it does
    /// Reports identifiers that are not written in hexadecimal digits. Where such a number runs into another rule, it is that
    /// finding which says so.
    ///
    /// ## Why is this bad
    /// The manual and the PC tool show identifiers in hexadecimal digits: who types 282 from there means 282h, and gets 11Ah.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 16404 = 282
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 16404 = 0x282
    /// ```
    DECIMAL_IDENTIFIER = "GWC024" "decimal-identifier" Info;
    /// A word that cannot stand there
    ///
    /// ## What it does
    /// Reports words of a scenario that its keys do not know.
    ///
    /// ## Why is this bad
    /// The step would do nothing.
    ///
    /// ## Example
    /// ```toml
    /// [[step]]
    /// at = 0.5
    /// nmt = "begin"
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [[step]]
    /// at = 0.5
    /// nmt = "start"
    /// ```
    UNKNOWN_WORD = "GWC025" "unknown-word" Error;
    /// A step does not say when it is
    ///
    /// ## What it does
    /// Looks for `at` in every step of a scenario.
    ///
    /// ## Why is this bad
    /// Nobody knows when to carry it out.
    ///
    /// ## Example
    /// ```toml
    /// [[step]]
    /// nmt = "start"
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [[step]]
    /// at = 0.5
    /// nmt = "start"
    /// ```
    NO_TIME = "GWC026" "no-time" Error;
    /// A step is after the end
    ///
    /// ## What it does
    /// Compares the times of a scenario with `--simulate`.
    ///
    /// ## Why is this bad
    /// The step is not carried out.
    ///
    /// ## Example
    /// ```toml
    /// [[step]]
    /// at = 100
    /// nmt = "start"
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [[step]]
    /// at = 0.5
    /// nmt = "start"
    /// ```
    TOO_LATE = "GWC027" "too-late" Warning;
    /// A line is written as the manual prints it
    ///
    /// ## What it does
    /// Recognises what people type from the manual or copy from the PC tool, where TOML writes it otherwise: hexadecimal
    /// digits without `0x`, decimal commas, units, names with blanks or parentheses, rows of tables. The help has the line as
    /// it has to be.
    ///
    /// ## Why is this bad
    /// The file is no TOML.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 16404 CanOpTPDO5-16ID(0) = 57F
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// "16404 CanOpTPDO5-16ID(0)" = 0x57F
    /// ```
    MANUAL_NOTATION = "GWC028" "manual-notation" Error;
    /// A bit timing without its switch
    ///
    /// ## What it does
    /// Reports segments of a manual bit timing (410 to 415 and 420 to 425 of the gateway, 410 to 414 of the governor) that are
    /// not 0 while their switch (4416, 4426; of the governor 4416 or 4409) is.
    ///
    /// ## Why is this bad
    /// They have no effect: the manual says that the switch must be set too.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 420 = 3
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 420 = 3
    /// 4426 = 1
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1.1, 7.2.1 and 7.2.2.
    UNUSED_BIT_TIMING = "GWC029" "unused-bit-timing" Warning;
    /// Bit timings that cannot be compared
    ///
    /// ## What it does
    /// Says where the bit rates of gateway and governor on the HEINZMANN bus are not compared: one unit alone has a manual
    /// bit timing, or the segments of the two differ.
    ///
    /// ## Why is this bad
    /// They must come to the same bit rate. The manual gives no formula, so that nobody can check it here; the live device
    /// takes them to fit.
    ///
    /// ## Example
    /// ```toml
    /// [gateway]
    /// 410 = 3
    /// 4416 = 1
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// [gateway]
    /// 410 = 3
    /// 4416 = 1
    /// [governor]
    /// 410 = 3
    /// 4416 = 1
    /// ```
    ///
    /// ## References
    /// Manual DG 04 005-d / 07-04, 7.1.1 and 7.2.1.
    UNCOMPARED_BIT_TIMING = "GWC030" "uncompared-bit-timing" Info;
    /// The file is one of another kind
    ///
    /// ## What it does
    /// Recognises other files that edskit reads where a parameter file or a scenario is wanted, and names the command that
    /// takes them.
    ///
    /// ## Why is this bad
    /// A list of mistakes would hide the one that was made.
    ///
    /// ## Example
    /// ```toml
    /// device = "heinzmann-canopen-gateway"
    /// [[step]]
    /// at = 0.5
    /// ```
    ///
    /// ## Use instead
    /// ```toml
    /// device = "heinzmann-canopen-gateway"
    /// [gateway]
    /// 427 = 5
    /// ```
    OTHER_FILE = "GWC031" "other-file" Error;
    /// A row of a table is not understood
    ///
    /// ## What it does
    /// Reports rows of an exported table that name a parameter and no value that can be read. They become comments of the
    /// parameter file, so that nothing is lost.
    ///
    /// ## Why is this bad
    /// The parameter has its default.
    ///
    /// ## Example
    /// ```csv
    /// Number;Name;Value;Unit
    /// 427;CanOpenMyNodeID;;
    /// ```
    ///
    /// ## Use instead
    /// ```csv
    /// Number;Name;Value;Unit
    /// 427;CanOpenMyNodeID;5;
    /// ```
    UNREADABLE_ROW = "GWC032" "unreadable-row" Error;
}
