//! Independent watchdog on its own 32 kHz oscillator (RM0440, section 42).

use stm32_metapac::iwdg::vals::{Key, Pr};
use stm32_metapac::{DBGMCU, IWDG};

/// Counts of 32 kHz / 64 = 500 Hz to the reset: 2 s. The loop feeds at least every 0.1 s.
const COUNTS: u16 = 1_000;

/// The running watchdog. Nothing but a reset stops it.
pub(super) struct Watchdog(());

impl Watchdog {
    /// Starts it. It pauses while a debugger halts the core.
    pub(super) fn start() -> Self {
        DBGMCU.apb1lfzr().modify(|w| w.set_iwdg(true));
        IWDG.kr().write(|w| w.set_key(Key::START));
        IWDG.kr().write(|w| w.set_key(Key::ENABLE));
        IWDG.pr().write(|w| w.set_pr(Pr::DIVIDE_BY64));
        IWDG.rlr().write(|w| w.set_rl(COUNTS));
        let mut watchdog = Self(());
        watchdog.feed();
        watchdog
    }

    /// Counts from the beginning again.
    pub(super) fn feed(&mut self) {
        IWDG.kr().write(|w| w.set_key(Key::RESET));
    }
}
