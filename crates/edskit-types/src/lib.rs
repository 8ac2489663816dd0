//! The words of CANopen.
#![no_std]
