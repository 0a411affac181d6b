//! SysTick as a 64-bit clock in microseconds.

use core::cell::Cell;

use cortex_m::peripheral::syst::SystClkSource;
use cortex_m::peripheral::{SCB, SYST};
use cortex_m_rt::exception;
use critical_section::Mutex;
use deictic_core::time::Micros;

use super::board::MHZ;

/// Microseconds between two ticks. A tick also ends a WFI, so this is how late a timer can fire while the links are
/// silent. 5 ms: far below the 100 ms and more of every timer of the unit, 200 interrupts a second cost nothing, and
/// 850,000 cycles at 170 MHz fit SysTick's 24 bits.
const TICK: u32 = 5_000;

const RELOAD: u32 = {
    assert!(MHZ * TICK <= 1 << 24, "SysTick counts 24 bits");
    MHZ * TICK - 1
};

/// Microseconds up to the last tick.
static TICKED: Mutex<Cell<u64>> = Mutex::new(Cell::new(0));

defmt::timestamp!("{=u64:us}", now().0);

/// Starts the clock at 0.
pub(crate) fn start(mut syst: SYST) {
    syst.set_clock_source(SystClkSource::Core);
    syst.set_reload(RELOAD);
    syst.clear_current();
    syst.enable_interrupt();
    syst.enable_counter();
    // Until its first reload the counter shows 0, which would read as the end of a tick.
    while SYST::get_current() == 0 {}
}

/// Microseconds since the start.
pub(crate) fn now() -> Micros {
    critical_section::with(|cs| {
        let mut ticked = TICKED.borrow(cs).get();
        let mut left = SYST::get_current();
        if SCB::is_pendst_pending() {
            // The counter wrapped and its interrupt waits for this critical section to end: the count read above may
            // be from before or after.
            ticked = ticked.wrapping_add(u64::from(TICK));
            left = SYST::get_current();
        }
        Micros(ticked.wrapping_add(u64::from(RELOAD.wrapping_sub(left) / MHZ)))
    })
}

/// Sleeps until the moment `until` or until an interrupt made `awake` true.
pub(crate) fn sleep(until: Micros, awake: impl Fn() -> bool) {
    while now() < until && !awake() {
        // An interrupt between the question and the WFI would be slept over until the next tick; held back, it still
        // ends the WFI.
        cortex_m::interrupt::free(|_| {
            if !awake() {
                cortex_m::asm::wfi();
            }
        });
    }
}

#[exception]
fn SysTick() {
    critical_section::with(|cs| {
        let ticked = TICKED.borrow(cs);
        ticked.set(ticked.get().wrapping_add(u64::from(TICK)));
    });
}
