//! How the cost of a decision grows with what there is, in instructions on the board (in QEMU with `-icount shift=10`).
//! `cargo xtask growth` reads the lines `growth MODEL DIRECTION SIZE INSTRUCTIONS`.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use deictic_bits::Bench;
use deictic_bits::growth::{DRAWS, Size};
use deictic_core::profile::Profile;
use deictic_firmware::mps2_an386::measure::Counter;

#[entry]
fn main() -> ! {
    static mut BENCH: Bench = Bench::new();
    if let Some(core) = cortex_m::Peripherals::take() {
        let mut counter = Counter::new(core.SYST);
        for (model, profile) in [("m3", Profile::PAPER), ("joint", Profile::JOINT)] {
            for (direction, size) in Size::directions() {
                let mut sum = 0_u64;
                for draw in 0..DRAWS {
                    BENCH.sized(size, draw);
                    let count = counter.instructions(|| decide(BENCH, &profile));
                    sum = sum.wrapping_add(u64::from(count));
                }
                let along = size.along(direction);
                hprintln!("growth {} {} {} {}", model, direction, along, sum / DRAWS);
            }
        }
        debug::exit(debug::EXIT_SUCCESS);
    }
    loop {
        cortex_m::asm::wfi();
    }
}

/// One decision, its result kept from being optimised away.
#[inline(never)]
fn decide(bench: &mut Bench, profile: &Profile) {
    let decision = bench.decide(black_box(profile));
    black_box(decision.is_ok());
}
