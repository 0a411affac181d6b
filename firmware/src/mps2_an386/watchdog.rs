//! CMSDK APB watchdog (Arm DDI 0479): an NMI when it has counted down once, a reset when it has done so twice.

const BASE: usize = 0x4000_8000;
const LOAD: usize = 0x000;
const CONTROL: usize = 0x008;
const CLEAR: usize = 0x00c;
const LOCK: usize = 0xc00;
const UNLOCK: u32 = 0x1acc_e551;
/// Interrupt and reset.
const CONTROL_ON: u32 = 0b11;

/// Milliseconds to the NMI; the reset follows after as many again. The loop feeds at least every 0.1 s; QEMU on a busy
/// host may not run for a second or two.
const MILLISECONDS: u32 = 5_000;

/// The running watchdog.
pub(super) struct Watchdog(());

impl Watchdog {
    /// Starts it on a clock of `hz`.
    pub(super) fn start(hz: u32) -> Self {
        write(LOCK, UNLOCK);
        write(LOAD, (hz / 1_000).saturating_mul(MILLISECONDS));
        write(CONTROL, CONTROL_ON);
        Self(())
    }

    /// Counts from the beginning again.
    pub(super) fn feed(&mut self) {
        write(CLEAR, 1);
    }
}

fn write(offset: usize, value: u32) {
    // SAFETY: a register of the watchdog, which nothing but this module uses.
    unsafe { ((BASE.wrapping_add(offset)) as *mut u32).write_volatile(value) }
}
