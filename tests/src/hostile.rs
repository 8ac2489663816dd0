//! Files made to cost time and memory.

/// How often a line, a section or a key is repeated.
const MANY: usize = 100_000;

/// How often where each is to have another number of 16 bits.
const NUMBERS: usize = 65_000;

/// The length of a line that never ends.
const LONG: usize = 1_000_000;

/// A kind of hostile file.
pub struct Hostile {
    /// What it is.
    pub what: &'static str,
    /// A file name with the ending that counts.
    pub name: &'static str,
    /// The size that is asked of it: a number of bytes or of lines.
    size: usize,
    make: fn(usize) -> String,
}

impl Hostile {
    /// A file that is `divisor` times smaller than the size that is asked of it.
    pub fn text(&self, divisor: usize) -> String {
        (self.make)(self.size / divisor)
    }
}

/// Every kind; the size is a number of bytes where [`LONG`] stands, else a number of lines.
pub const ALL: &[Hostile] = &[
    kind("one line of NUL", "a.eds", LONG, |size| object(&"\0".repeat(size))),
    kind("only NUL", "a.eds", LONG, |size| "\0".repeat(size)),
    kind("one line of [", "a.eds", LONG, |size| object(&"[".repeat(size))),
    kind("one line of ]", "a.eds", LONG, |size| object(&"]".repeat(size))),
    kind("one line of =", "a.eds", LONG, |size| object(&"=".repeat(size))),
    kind("one line of ;", "a.eds", LONG, |size| object(&";".repeat(size))),
    kind("a long key", "a.eds", LONG, |size| object(&format!("{}=1", "x".repeat(size)))),
    kind("a long value", "a.eds", LONG, |size| object(&format!("ParameterName={}", "x".repeat(size)))),
    kind("a long number", "a.eds", LONG, |size| {
        object(&format!("DataType=7\nDefaultValue={}", "1".repeat(size)))
    }),
    kind("a long access type", "a.eds", LONG, |size| {
        object(&format!("AccessType={}", "rw".repeat(size / 2)))
    }),
    kind("a long section name", "a.eds", LONG, |size| object(&format!("[{}]", "1".repeat(size)))),
    kind("a long sum", "a.eds", LONG, |size| {
        object(&format!("DataType=7\nDefaultValue=$NODEID{}", "+1".repeat(size / 2)))
    }),
    kind("many variables in a sum", "a.eds", LONG, |size| {
        object(&format!("DataType=7\nDefaultValue={}1", "$NODEID+".repeat(size / 8)))
    }),
    kind("a line of beginnings of comments", "a.eds", LONG, |size| {
        object(&format!("DataType=7\nDefaultValue=1{}", " ;".repeat(size / 2)))
    }),
    kind("lines of [", "a.eds", LONG, |size| object(&"[\n".repeat(size / 2))),
    kind("lines of ]", "a.eds", LONG, |size| object(&"]\n".repeat(size / 2))),
    kind("lines of =", "a.eds", LONG, |size| object(&"=\n".repeat(size / 2))),
    kind("lines of blanks", "a.eds", LONG, |size| object(&" \n".repeat(size / 2))),
    kind("lines of three kinds of ending", "a.eds", LONG, |size| object(&"\n\r\r\n".repeat(size / 4))),
    kind("merge markers", "a.eds", MANY, |size| object(&"<<<<<<< a\n".repeat(size))),
    kind("one section many times", "a.eds", MANY, |size| object(&"[1000]\n".repeat(size))),
    kind("one sub-object many times", "a.eds", MANY, |size| object(&"[1018sub1]\n".repeat(size))),
    kind("one unknown section many times", "a.eds", MANY, |size| object(&"[Vendor]\n".repeat(size))),
    kind("one list many times", "a.eds", MANY, |size| object(&"[OptionalObjects]\n1=0x1000\n".repeat(size))),
    kind("[DeviceInfo] many times", "a.eds", MANY, |size| {
        object(&"[DeviceInfo]\nNrOfRXPDO=1\n".repeat(size))
    }),
    kind("one key many times", "a.eds", MANY, |size| object(&"ParameterName=a\n".repeat(size))),
    kind("one unknown key many times", "a.eds", MANY, |size| object(&"ParamterNane=a\n".repeat(size))),
    kind("many unknown sections", "a.eds", MANY, |size| {
        numbered(size, "", &|number| format!("[Vendor{number}]"))
    }),
    kind("many unknown keys", "a.eds", MANY, |size| {
        numbered(size, "[1000]", &|number| format!("Vendor{number}=1"))
    }),
    kind("many objects", "a.eds", NUMBERS, |size| {
        numbered(size, "", &|number| format!("[{:X}]\nParameterName=a", number))
    }),
    kind("many sub-objects", "a.eds", MANY, |size| {
        numbered(size, "", &|number| {
            format!("[{:X}sub{:X}]\nParameterName=a", number >> 8 & 0xFFFF, number & 0xFF)
        })
    }),
    kind("many items of objects that do not exist", "a.eds", NUMBERS, |size| {
        numbered(size, "[OptionalObjects]\nSupportedObjects=65535", &|number| {
            format!("{}=0x{:04X}", number + 1, number)
        })
    }),
    kind("many items of one object", "a.eds", MANY, |size| {
        numbered(size, "[OptionalObjects]\nSupportedObjects=65535", &|number| {
            format!("{}=0x1000", number + 1)
        })
    }),
    kind("many comments", "a.eds", NUMBERS, |size| {
        numbered(size, "[Comments]\nLines=65535", &|number| format!("Line{}=a", number + 1))
    }),
    kind("many dummies", "a.eds", NUMBERS, |size| {
        numbered(size, "[DummyUsage]", &|number| format!("Dummy{number:04X}=1"))
    }),
    kind("many links", "a.eds", MANY, |size| {
        numbered(size, "[1000ObjectLinks]\nObjectLinks=65535", &|number| format!("{}=0x1000", number + 1))
    }),
    kind("many values of a compact object", "a.dcf", MANY, |size| {
        let head = "[2100]\nParameterName=a\nObjectType=8\nDataType=5\nCompactSubObj=254\n[2100Value]\nNrOfEntries=254";
        numbered(size, head, &|number| format!("{}=1", number + 1))
    }),
    kind("many modules", "a.eds", NUMBERS, |size| {
        numbered(size, "[SupportedModules]\nNrOfEntries=65535", &|number| {
            format!("[M{number}ModuleInfo]\nProductName=a")
        })
    }),
    kind("many fixed objects of a module", "a.eds", MANY, |size| {
        let head = "[SupportedModules]\nNrOfEntries=1\n[M1ModuleInfo]\nProductName=a\n[M1FixedObjects]\nNrOfEntries=65535";
        numbered(size, head, &|number| format!("{}=0x2000", number + 1))
    }),
    kind("many connected modules", "a.dcf", MANY, |size| {
        let head = "[SupportedModules]\nNrOfEntries=1\n[M1ModuleInfo]\nProductName=a\n[ConnectedModules]\nNrOfEntries=65535";
        numbered(size, head, &|number| format!("{}=1", number + 1))
    }),
    kind("many channels", "a.eds", MANY, |size| {
        numbered(size, "[DynamicChannels]\nNrOfSeg=255", &|number| format!("Type{}=0x0007", number + 1))
    }),
    kind("many tools", "a.eds", NUMBERS, |size| {
        numbered(size, "[Tools]\nItems=255", &|number| format!("[Tool{number}]\nName=a"))
    }),
    kind("many mapped objects", "a.eds", NUMBERS / 2, |size| {
        numbered(size, "", &|number| {
            let (pdo, sub) = (number / 64, number % 64 + 1);
            format!(
                "[{:X}sub{sub:X}]\nParameterName=a\nDataType=7\nAccessType=rw\nDefaultValue=0x20000020",
                0x1A00 + pdo
            )
        })
    }),
    kind("many nodes", "nodelist.cpj", NUMBERS, |size| {
        numbered(size, "[Topology]\nNodes=0x7F", &|number| {
            format!("Node{number}Present=0x01\nNode{number}Name=a")
        })
    }),
    kind("many networks", "nodelist.cpj", NUMBERS, |size| {
        numbered(size, "", &|number| format!("[Topology{number}]\nNodes=0x01\nNode1Present=0x01"))
    }),
];

const fn kind(what: &'static str, name: &'static str, size: usize, make: fn(usize) -> String) -> Hostile {
    Hostile { what, name, size, make }
}

/// A file with one object that ends with `rest`.
fn object(rest: &str) -> String {
    format!("[FileInfo]\nFileName=a.eds\n[DeviceInfo]\nVendorName=a\n[1000]\n{rest}\n")
}

/// `head` and as many lines as `size` says, each with another number.
fn numbered(size: usize, head: &str, line: &dyn Fn(usize) -> String) -> String {
    let mut text = format!("[FileInfo]\nFileName=a.eds\n{head}\n");
    for number in 0..size {
        text.push_str(&line(number));
        text.push('\n');
    }
    text
}
