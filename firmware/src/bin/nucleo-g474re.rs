//! The gesture unit on a NUCLEO-G474RE. `cargo run --release --features nucleo-g474re --bin nucleo-g474re` in
//! `firmware/` flashes it.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use deictic_core::board::Unit;
use deictic_firmware::nucleo_g474re::NucleoG474Re;

#[entry]
fn main() -> ! {
    static mut UNIT: Unit = Unit::new(0);
    match NucleoG474Re::start() {
        Some(mut board) => {
            UNIT.set_boot(board.boot());
            deictic_firmware::run(&mut board, UNIT)
        }
        None => loop {
            cortex_m::asm::wfi();
        },
    }
}
