//! Whether the board decides exactly as the host does: hashes every figure of many decisions and ends with a failure
//! where the hash is not the host's. Line: `bits SAMPLES HASH`.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use deictic_bits::{Bench, GOLDEN, SAMPLES, START};
use deictic_firmware as _;

#[entry]
fn main() -> ! {
    static mut BENCH: Bench = Bench::new();
    let hash = BENCH.hash(START, 0..SAMPLES);
    hprintln!("bits {} {:#018x}", SAMPLES, hash);
    debug::exit(if hash == GOLDEN {
        debug::EXIT_SUCCESS
    } else {
        debug::EXIT_FAILURE
    });
    loop {
        cortex_m::asm::wfi();
    }
}
