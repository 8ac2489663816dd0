//! Who the gateway is.

/// What identifies a gateway (8.1, 8.2, 11.3; GW-APP-41). The default is our choice: the manual prints none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identification {
    /// 3840 HardwareVersion, 0 to 9999.
    pub hardware_version: u16,
    /// 3841 AddHardwareVersion, 0 to 9999.
    pub additional_hardware_version: u16,
    /// 3842 SoftwareVersion. Sub-index 03h of 1018h does not show it: it is 0, as the data sheet says (GW-GAP-04).
    pub software_version: u16,
    /// 3843 BootSoftwareVersion.
    pub boot_software_version: u16,
    /// 3844 SerialDate, year and month, 0 to 9912.
    pub serial_date: u16,
    /// 3845 SerialNumber.
    pub serial_number: u16,
}

impl Identification {
    /// The serial number in sub-index 04h of 1018h: the date, then five digits of the number (GW-GAP-04).
    ///
    /// ```
    /// use edskit_devices::gateway::Identification;
    /// let identification = Identification { serial_date: 407, serial_number: 123, ..Identification::default() };
    /// assert_eq!(identification.serial(), 40_700_123);
    /// ```
    #[must_use]
    pub const fn serial(self) -> u32 {
        self.serial_date as u32 * 100_000 + self.serial_number as u32
    }
}

impl Default for Identification {
    fn default() -> Self {
        Self {
            hardware_version: 1,
            additional_hardware_version: 0,
            software_version: 1,
            boot_software_version: 1,
            serial_date: 2611,
            serial_number: 1,
        }
    }
}
