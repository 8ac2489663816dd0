//! `[FileInfo]`, `[DeviceInfo]` and `[DeviceComissioning]`.

use super::{Datasheet, Entry, Field, Section};
use crate::key::KeyName;
use crate::section::SectionKind;
use core::ops::Deref;
use edskit_types::{Bitrate, NodeId, PdoDirection};

macro_rules! section_view {
    ($(#[$doc:meta])* $name:ident, $kind:ident, $method:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name<'a> {
            section: Section<'a>,
        }

        impl<'a> Deref for $name<'a> {
            type Target = Section<'a>;

            fn deref(&self) -> &Section<'a> {
                &self.section
            }
        }

        impl Datasheet {
            #[doc = concat!("The section `[", stringify!($kind), "]`.")]
            pub fn $method(&self) -> Option<$name<'_>> {
                self.section(SectionKind::$kind).map(|section| $name { section })
            }
        }
    };
}

section_view! {
    /// What the file is (CiA 306 v1.3, 4.4). Keys without a method of their own are read through [`Section::filled`].
    FileInfo, FileInfo, file_info
}

section_view! {
    /// What the device is (CiA 306 v1.3, 4.5). Keys without a method of their own are read through [`Section::filled`].
    DeviceInfo, DeviceInfo, device_info
}

section_view! {
    /// How the device is put into its network, in a DCF (CiA 306 v1.3, 5.3.2). Both spellings of the section are read.
    Commissioning, DeviceCommissioning, commissioning
}

impl<'a> FileInfo<'a> {
    /// `FileName`
    pub fn file_name(self) -> Option<Entry<'a>> {
        self.filled(KeyName::FileName)
    }

    /// `EDSVersion`: the edition of CiA 306, `x.y`; 3.0 where it is missing.
    pub fn eds_version(self) -> Option<Entry<'a>> {
        self.filled(KeyName::EdsVersion)
    }

    /// `Description`
    pub fn description(self) -> Option<Entry<'a>> {
        self.filled(KeyName::Description)
    }

    /// `LastEDS`: the EDS that a DCF was made from.
    pub fn last_eds(self) -> Option<Entry<'a>> {
        self.filled(KeyName::LastEds)
    }
}

impl<'a> DeviceInfo<'a> {
    /// `VendorName`
    pub fn vendor_name(self) -> Option<Entry<'a>> {
        self.filled(KeyName::VendorName)
    }

    /// `VendorNumber`: as in 1018h sub-index 01h.
    pub fn vendor_number(self) -> Option<Field<'a, u32>> {
        self.filled(KeyName::VendorNumber).map(Entry::unsigned)
    }

    /// `ProductName`
    pub fn product_name(self) -> Option<Entry<'a>> {
        self.filled(KeyName::ProductName)
    }

    /// `ProductNumber`: as in 1018h sub-index 02h.
    pub fn product_number(self) -> Option<Field<'a, u32>> {
        self.filled(KeyName::ProductNumber).map(Entry::unsigned)
    }

    /// `RevisionNumber`: as in 1018h sub-index 03h.
    pub fn revision_number(self) -> Option<Field<'a, u32>> {
        self.filled(KeyName::RevisionNumber).map(Entry::unsigned)
    }

    /// `OrderCode`
    pub fn order_code(self) -> Option<Entry<'a>> {
        self.filled(KeyName::OrderCode)
    }

    /// The flag `BaudRate_x` of a bit rate.
    pub fn supports(self, bitrate: Bitrate) -> Option<Field<'a, bool>> {
        let name = match bitrate {
            Bitrate::Kbit10 => KeyName::BaudRate10,
            Bitrate::Kbit20 => KeyName::BaudRate20,
            Bitrate::Kbit50 => KeyName::BaudRate50,
            Bitrate::Kbit125 => KeyName::BaudRate125,
            Bitrate::Kbit250 => KeyName::BaudRate250,
            Bitrate::Kbit500 => KeyName::BaudRate500,
            Bitrate::Kbit800 => KeyName::BaudRate800,
            Bitrate::Kbit1000 => KeyName::BaudRate1000,
        };
        self.filled(name).map(Entry::flag)
    }

    /// The bit rates whose flag is 1.
    pub fn bitrates(self) -> impl Iterator<Item = Bitrate> {
        let supported = move |bitrate: &Bitrate| self.supports(*bitrate).and_then(Field::known) == Some(true);
        Bitrate::ALL.iter().copied().filter(supported)
    }

    /// `Granularity`: 0 for a fixed mapping, else the smallest unit that can be mapped, 1..64 bits.
    pub fn granularity(self) -> Option<Field<'a, u8>> {
        self.filled(KeyName::Granularity).map(Entry::unsigned)
    }

    /// `CompactPDO`: which sub-indices implicit PDO communication records have.
    pub fn compact_pdo(self) -> Option<Field<'a, u8>> {
        self.filled(KeyName::CompactPdo).map(Entry::unsigned)
    }

    /// `NrOfRXPDO` or `NrOfTXPDO`: the number of PDOs, implicit ones included.
    pub fn pdo_count(self, direction: PdoDirection) -> Option<Field<'a, u16>> {
        let name = match direction {
            PdoDirection::Receive => KeyName::NrOfRxPdo,
            PdoDirection::Transmit => KeyName::NrOfTxPdo,
        };
        self.filled(name).map(Entry::unsigned)
    }

    /// `LSS_Supported`
    pub fn lss_supported(self) -> Option<Field<'a, bool>> {
        self.filled(KeyName::LssSupported).map(Entry::flag)
    }

    /// `DynamicChannelsSupported`: other than 0 where `[DynamicChannels]` exists.
    pub fn dynamic_channels_supported(self) -> Option<Field<'a, u8>> {
        self.filled(KeyName::DynamicChannelsSupported).map(Entry::unsigned)
    }
}

impl Datasheet {
    /// The node-ID that `[DeviceComissioning]` gives the device, in a DCF; `None` where it names none of 1..127.
    pub fn commissioned_node_id(&self) -> Option<NodeId> {
        NodeId::new(self.commissioning()?.node_id()?.known()?).ok()
    }

    /// The bit rate that `[DeviceComissioning]` gives the device, in a DCF; `None` where it names none of CANopen.
    pub fn commissioned_bitrate(&self) -> Option<Bitrate> {
        Bitrate::from_kbit_per_s(self.commissioning()?.baudrate()?.known()?.into())
    }
}

impl<'a> Commissioning<'a> {
    /// `NodeID`, 1..127 in a correct file.
    pub fn node_id(self) -> Option<Field<'a, u8>> {
        self.filled(KeyName::NodeId).map(Entry::unsigned)
    }

    /// `NodeName`
    pub fn node_name(self) -> Option<Entry<'a>> {
        self.filled(KeyName::NodeName)
    }

    /// `Baudrate` in kbit/s.
    pub fn baudrate(self) -> Option<Field<'a, u16>> {
        self.filled(KeyName::Baudrate).map(Entry::unsigned)
    }

    /// `NetNumber`
    pub fn net_number(self) -> Option<Field<'a, u32>> {
        self.filled(KeyName::NetNumber).map(Entry::unsigned)
    }

    /// `NetworkName`
    pub fn network_name(self) -> Option<Entry<'a>> {
        self.filled(KeyName::NetworkName)
    }

    /// `CANopenManager`
    pub fn canopen_manager(self) -> Option<Field<'a, bool>> {
        self.filled(KeyName::CanopenManager).map(Entry::flag)
    }

    /// `LSS_SerialNumber`: as in 1018h sub-index 04h.
    pub fn lss_serial_number(self) -> Option<Field<'a, u32>> {
        self.filled(KeyName::LssSerialNumber).map(Entry::unsigned)
    }
}
