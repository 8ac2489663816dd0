//! A node on a microcontroller: the loop of a firmware, and a CAN controller that consists of a few registers.
#![no_std]
#![no_main]

mod controller;

use controller::Controller;
use core::mem::MaybeUninit;
use core::panic::PanicInfo;
use cortex_m_rt::entry;
use edskit_runtime::{NoApplication, NoStorage, Node};

edskit_runtime::include_dictionary!("device");

type Device = Node<device::Dictionary, NoStorage>;

#[entry]
fn main() -> ! {
    // In memory of its own and not on the stack, so that the linker says what it takes.
    static mut NODE: MaybeUninit<Device> = MaybeUninit::uninit();
    let node = NODE.write(Node::new(device::Dictionary::new(), device::SETTINGS, NoStorage));
    let mut application = NoApplication;
    let mut can = Controller;
    loop {
        let now = can.now();
        while let Some(frame) = can.receive() {
            node.receive(now, &frame, &mut application);
        }
        node.poll(now, &mut application);
        while let Some(frame) = node.transmit() {
            can.transmit(&frame);
        }
        can.sleep_until(node.next_deadline(now));
    }
}

#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    loop {}
}
