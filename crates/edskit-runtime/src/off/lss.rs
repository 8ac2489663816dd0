//! Without LSS: its frames are taken by nobody, and the settings or the device say the node-ID.

use crate::Application;
use crate::context::Context;
use crate::{Frame, Settings};

#[derive(Debug)]
pub(crate) struct Lss;

impl Lss {
    pub(crate) const fn new() -> Self {
        Self
    }

    pub(crate) fn exists(_: &Settings) -> bool {
        false
    }

    pub(crate) fn restart(&mut self) {}

    pub(crate) fn is_in_configuration(&self) -> bool {
        false
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(crate) fn lss_request(&mut self, _: &Frame) {}
}
