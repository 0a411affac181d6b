//! Measuring code on the board in QEMU.

use core::hint::black_box;

use cortex_m::interrupt;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

/// SysTick's range.
const RANGE: u32 = 1 << 24;

/// Painted on unused stack.
const PAINT: u32 = 0xdead_57ac;

/// Bytes kept clear below the painter's own frame.
const MARGIN: u32 = 256;

/// Counts instructions, in QEMU with `-icount shift=10`, which makes each take 1024 ns: 25.6 of SysTick's 40 ns.
pub struct Counter {
    syst: SYST,
    overhead: u32,
}

impl Counter {
    /// A counter that leaves out what counting itself costs.
    #[must_use]
    pub fn new(mut syst: SYST) -> Self {
        syst.set_clock_source(SystClkSource::Core);
        syst.set_reload(RANGE - 1);
        syst.clear_current();
        syst.enable_counter();
        let mut counter = Self { syst, overhead: 0 };
        counter.overhead = counter.ticks(|| ());
        counter
    }

    /// Instructions of `work`, at most 655,000: SysTick wraps beyond that.
    pub fn instructions<R>(&mut self, work: impl FnOnce() -> R) -> u32 {
        let ticks = self.ticks(work).saturating_sub(self.overhead);
        // 256 ticks are 10 instructions.
        (u64::from(ticks) * 10).div_ceil(256) as u32
    }

    fn ticks<R>(&mut self, work: impl FnOnce() -> R) -> u32 {
        interrupt::free(|_| {
            self.syst.clear_current();
            let before = SYST::get_current();
            black_box(work());
            before.wrapping_sub(SYST::get_current()) % RANGE
        })
    }
}

/// The most bytes of stack that `work` uses, its caller's frame not among them. Paints the unused stack before and
/// looks after how far the paint is gone.
pub fn stack_used(work: impl FnOnce()) -> u32 {
    unsafe extern "C" {
        static __sheap: u8;
    }
    let bottom = (core::ptr::addr_of!(__sheap) as u32).next_multiple_of(4);
    let top = cortex_m::register::msp::read();
    for address in (bottom..top.saturating_sub(MARGIN)).step_by(4) {
        // SAFETY: lies between the variables and the stack pointer, where nothing is kept.
        unsafe { (address as *mut u32).write_volatile(PAINT) };
    }
    work();
    // SAFETY: as above; reads only.
    let deepest = (bottom..top)
        .step_by(4)
        .find(|address| unsafe { (*address as *const u32).read_volatile() } != PAINT);
    top.saturating_sub(deepest.unwrap_or(top))
}
