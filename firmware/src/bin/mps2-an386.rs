//! The gesture unit in QEMU. `cargo xtask qemu` builds and boots it.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use deictic_core::board::Unit;
use deictic_firmware::mps2_an386::Mps2An386;

#[entry]
fn main() -> ! {
    static mut UNIT: Unit = Unit::new(0);
    match Mps2An386::start() {
        Some(mut board) => {
            UNIT.set_boot(board.boot());
            deictic_firmware::run(&mut board, UNIT)
        }
        None => loop {
            cortex_m::asm::wfi();
        },
    }
}
