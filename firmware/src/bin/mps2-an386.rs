//! The gesture unit in QEMU. `cargo xtask qemu` builds and boots it.
#![no_std]
#![no_main]

use core::mem::MaybeUninit;

use cortex_m_rt::entry;
use deictic_core::board::Unit;
use deictic_firmware::mps2_an386::Mps2An386;

#[entry]
fn main() -> ! {
    // SAFETY: zeros are a value of every part of a unit; for one of which they were not, the compiler would refuse this.
    static mut UNIT: Unit = unsafe { MaybeUninit::zeroed().assume_init() };
    match Mps2An386::start() {
        Some(mut board) => {
            UNIT.restart(board.boot());
            deictic_firmware::lock(UNIT);
            deictic_firmware::run(&mut board, UNIT)
        }
        None => loop {
            cortex_m::asm::wfi();
        },
    }
}
