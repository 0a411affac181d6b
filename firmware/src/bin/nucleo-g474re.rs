//! The gesture unit on a NUCLEO-G474RE. `cargo run --release --features nucleo-g474re --bin nucleo-g474re` in
//! `firmware/` flashes it.
#![no_std]
#![no_main]

use core::mem::MaybeUninit;

use cortex_m_rt::entry;
use deictic_core::board::Unit;
use deictic_firmware::nucleo_g474re::NucleoG474Re;

#[entry]
fn main() -> ! {
    // Written here rather than copied from flash: its first value is mostly zeros, 17 KB of them.
    static mut UNIT: MaybeUninit<Unit> = MaybeUninit::uninit();
    match NucleoG474Re::start() {
        Some(mut board) => {
            let unit = UNIT.write(Unit::new(board.boot()));
            deictic_firmware::run(&mut board, unit)
        }
        None => loop {
            cortex_m::asm::wfi();
        },
    }
}
