//! The attributes of an object or a sub-object (CiA 306 v1.3, 4.6.3.2).

use super::{Entry, Field, ResolvedType, Section};
use crate::key::KeyName;
use crate::value::Value;
use core::ops::Deref;
use edskit_types::{AccessType, DataType, Index, ObjectCode};

/// A section that describes an object or a sub-object, of the device or of a module.
///
/// Each attribute is read when it is asked for; `None` means that the entry is missing or empty, which is the same.
#[derive(Clone, Copy, Debug)]
pub struct Description<'a> {
    pub(super) section: Section<'a>,
}

impl<'a> Deref for Description<'a> {
    type Target = Section<'a>;

    fn deref(&self) -> &Section<'a> {
        &self.section
    }
}

impl<'a> Description<'a> {
    /// The section that the description is.
    #[inline]
    pub fn section(self) -> Section<'a> {
        self.section
    }

    /// `ParameterName`
    pub fn parameter_name(self) -> Option<Entry<'a>> {
        self.filled(KeyName::ParameterName)
    }

    /// `ObjectType`: the object code.
    pub fn object_type(self) -> Option<Field<'a, ObjectCode>> {
        self.filled(KeyName::ObjectType).map(Entry::object_code)
    }

    /// The object code that counts: VAR where none is given; `None` where the text means nothing.
    #[inline]
    pub fn object_code(self) -> Option<ObjectCode> {
        self.object_type().map_or(Some(ObjectCode::Var), Field::known)
    }

    /// `DataType`: the index of the data type.
    #[inline]
    pub fn data_type(self) -> Option<Field<'a, u16>> {
        self.filled(KeyName::DataType).map(Entry::unsigned)
    }

    /// The data type of CiA 301: the one that is named, or the one behind a type that the file defines; DOMAIN for a
    /// DOMAIN object without one.
    #[inline]
    pub fn standard_type(self) -> Option<DataType> {
        match self.data_type() {
            Some(field) => {
                let index = Index(field.known()?);
                DataType::from_index(index).or_else(|| Some(self.sheet().resolve_type(index)?.data_type))
            }
            None => (self.object_code() == Some(ObjectCode::Domain)).then_some(DataType::Domain),
        }
    }

    /// The data type with its limits, where `DataType` names one that the file defines.
    pub fn resolved_type(self) -> Option<ResolvedType<'a>> {
        let index = Index(self.data_type()?.known()?);
        if DataType::from_index(index).is_some() { None } else { self.sheet().resolve_type(index) }
    }

    /// `AccessType`
    #[inline]
    pub fn access_type(self) -> Option<Field<'a, AccessType>> {
        self.filled(KeyName::AccessType).map(Entry::access_type)
    }

    /// The access that counts: `rw` for a DOMAIN object without one.
    pub fn access(self) -> Option<AccessType> {
        match self.access_type() {
            Some(field) => field.known(),
            None => (self.object_code() == Some(ObjectCode::Domain)).then_some(AccessType::Rw),
        }
    }

    /// `PDOMapping`
    #[inline]
    pub fn pdo_mapping(self) -> Option<Field<'a, bool>> {
        self.filled(KeyName::PdoMapping).map(Entry::flag)
    }

    /// Whether the object may be mapped into a PDO; no where nothing understandable is said.
    pub fn is_mappable(self) -> bool {
        self.pdo_mapping().and_then(Field::known).unwrap_or(false)
    }

    /// `DefaultValue`, read by the data type.
    #[inline]
    pub fn default_value(self) -> Option<Field<'a, Value<'a>>> {
        self.typed(KeyName::DefaultValue)
    }

    /// `ParameterValue` of a DCF, read by the data type.
    #[inline]
    pub fn parameter_value(self) -> Option<Field<'a, Value<'a>>> {
        self.typed(KeyName::ParameterValue)
    }

    /// The value that counts: `ParameterValue` where there is one, else `DefaultValue`.
    pub fn value(self) -> Option<Field<'a, Value<'a>>> {
        self.parameter_value().or_else(|| self.default_value())
    }

    /// `LowLimit`, read by the data type.
    #[inline]
    pub fn low_limit(self) -> Option<Field<'a, Value<'a>>> {
        self.typed(KeyName::LowLimit)
    }

    /// `HighLimit`, read by the data type.
    #[inline]
    pub fn high_limit(self) -> Option<Field<'a, Value<'a>>> {
        self.typed(KeyName::HighLimit)
    }

    /// `SubNumber`: how many sub-objects are described, FFh not counted.
    #[inline]
    pub fn sub_number(self) -> Option<Field<'a, u8>> {
        self.filled(KeyName::SubNumber).map(Entry::unsigned)
    }

    /// `CompactSubObj`: how many equal sub-objects exist that are not described one by one.
    #[inline]
    pub fn compact_sub_obj(self) -> Option<Field<'a, u8>> {
        self.filled(KeyName::CompactSubObj).map(Entry::unsigned)
    }

    /// `ObjFlags`: bit 0 refuse write on download, bit 1 refuse read on scan.
    pub fn obj_flags(self) -> Option<Field<'a, u32>> {
        self.filled(KeyName::ObjFlags).map(Entry::unsigned)
    }

    /// `Denotation` of a DCF: the name that the application gives.
    pub fn denotation(self) -> Option<Entry<'a>> {
        self.filled(KeyName::Denotation)
    }

    /// `ParamRefd` of a DCF: the reference designator.
    pub fn param_refd(self) -> Option<Entry<'a>> {
        self.filled(KeyName::ParamRefd)
    }

    /// `UploadFile` of a DCF: the file that takes what is read from a DOMAIN.
    pub fn upload_file(self) -> Option<Entry<'a>> {
        self.filled(KeyName::UploadFile)
    }

    /// `DownloadFile` of a DCF: the file that is written to a DOMAIN.
    pub fn download_file(self) -> Option<Entry<'a>> {
        self.filled(KeyName::DownloadFile)
    }

    /// `SRDOMapping`: whether the object may be mapped into an SRDO (CiA 306-1 v1.4, Annex A).
    pub fn srdo_mapping(self) -> Option<Field<'a, bool>> {
        self.filled(KeyName::SrdoMapping).map(Entry::flag)
    }

    /// `InvertedSRAD`: index and sub-index of the inverted safety data (CiA 306-1 v1.4, Annex A).
    pub fn inverted_srad(self) -> Option<Field<'a, u32>> {
        self.filled(KeyName::InvertedSrad).map(Entry::unsigned)
    }

    #[inline]
    fn typed(self, name: KeyName) -> Option<Field<'a, Value<'a>>> {
        let entry = self.filled(name)?;
        Some(entry.value(self.standard_type()))
    }
}
