//! Whether a board that goes wrong says so: grows the stack until it meets the guard below it. Must end with a
//! failure; a board whose stack runs into its variables unnoticed ends well.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use deictic_firmware::mps2_an386::Mps2An386;

unsafe extern "C" {
    /// First byte after all variables (cortex-m-rt's link.x).
    static __sheap: u8;
}

#[entry]
fn main() -> ! {
    let board = Mps2An386::start();
    if board.is_some() && deeper(1) > 0 {
        debug::exit(debug::EXIT_SUCCESS);
    }
    loop {
        cortex_m::asm::wfi();
    }
}

/// Calls itself until its frame lies among the variables.
#[inline(never)]
fn deeper(call: u32) -> u32 {
    let frame = black_box([call; 16]);
    if cortex_m::register::msp::read() < core::ptr::addr_of!(__sheap) as u32 {
        return 1;
    }
    deeper(call.wrapping_add(1)).wrapping_add(frame.iter().fold(0, |sum, word| sum | word))
}
