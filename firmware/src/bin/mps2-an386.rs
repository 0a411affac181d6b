//! The gesture unit in QEMU. `cargo xtask qemu` builds and boots it.
#![no_std]
#![no_main]

use core::mem::MaybeUninit;

use cortex_m_rt::entry;
use deictic_core::board::Unit;
use deictic_firmware::mps2_an386::Mps2An386;

#[entry]
fn main() -> ! {
    // Written here rather than copied from flash: its first value is mostly zeros, 17 KB of them.
    static mut UNIT: MaybeUninit<Unit> = MaybeUninit::uninit();
    match Mps2An386::start() {
        Some(mut board) => {
            let unit = UNIT.write(Unit::new(board.boot()));
            deictic_firmware::run(&mut board, unit)
        }
        None => loop {
            cortex_m::asm::wfi();
        },
    }
}
