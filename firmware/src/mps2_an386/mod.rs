//! The board in QEMU: Arm's MPS2 with the AN386 image (Arm DAI 0386), a Cortex-M4F at 25 MHz.
//!
//! ```text
//! qemu-system-arm -M mps2-an386 -kernel IMAGE -display none -monitor none \
//!   -chardev stdio,id=log -semihosting-config enable=on,target=native,chardev=log \
//!   -serial tcp:127.0.0.1:PORT,server=on,wait=off,nodelay=on -serial null -serial null
//! ```
//! The first `-serial` is the link to the host bridge, the third the hand sensor's; the second is not used. The log is defmt frames for
//! `cargo xtask qemu` or `defmt-print`. Without semihosting the image runs too, silently.

#[cfg(feature = "bench")]
pub mod measure;
mod semihosting;
mod uart;
mod vectors;
mod watchdog;

use cortex_m::peripheral::NVIC;
use cortex_m_rt::{ExceptionFrame, exception};
use deictic_core::time::Micros;
use deictic_core::unit::Statistics;

use crate::arm::journal::Journal;
use crate::arm::{clock, fault, guard, log};
use crate::{Board, Turn};
use uart::UartStream;

use vectors::Interrupt;
use watchdog::Watchdog;

/// Core clock in megahertz, as the board's clock counts it.
pub(crate) const MHZ: u32 = if cfg!(feature = "hasty") { 1 } else { 25 };
const HZ: u32 = 25_000_000;
/// QEMU moves bytes as fast as it can; the divider only has to be one that the UART takes.
const BAUD: u32 = 921_600;
/// Longest sleep; the watchdog waits 5 s.
const LONGEST_SLEEP: Micros = Micros::from_millis(100);

/// The host link: UART0.
#[cfg(not(feature = "can"))]
pub type Link = UartStream;
/// The host link: UART1 as a LAWICEL adapter.
#[cfg(feature = "can")]
pub type Link = crate::can::CanLink<crate::adapter::SerialCan<UartStream>>;

#[cfg(not(feature = "can"))]
fn start_link() -> Link {
    uart::LINK.start(HZ, BAUD)
}

#[cfg(feature = "can")]
fn start_link() -> Link {
    crate::can::CanLink::new(crate::adapter::SerialCan::new(
        uart::ADAPTER.start(HZ, BAUD),
    ))
}

#[cfg(feature = "can")]
use uart::ADAPTER as CARRIER;
/// The UART that the link goes over.
#[cfg(not(feature = "can"))]
use uart::LINK as CARRIER;

/// The running board.
pub struct Mps2An386 {
    link: Link,
    sensor: UartStream,
    watchdog: Watchdog,
    boot: u32,
    journal: Journal,
}

impl Mps2An386 {
    /// Starts clock, links and watchdog. None if it was called before.
    #[must_use]
    pub fn start() -> Option<Self> {
        let mut core = cortex_m::Peripherals::take()?;
        guard::enable(&mut core.MPU);
        clock::start(core.SYST);
        let link = start_link();
        let sensor = uart::SENSOR.start(HZ, BAUD);
        for &interrupt in Interrupt::ALL {
            // SAFETY: the handlers share data with the loop only inside critical sections.
            unsafe { NVIC::unmask(interrupt) };
        }
        let boot = semihosting::seconds().unwrap_or(0);
        if let Some(fault) = fault::take_previous() {
            defmt::warn!("restarted after a fault at {=u32:#010x}", fault.pc);
        }
        defmt::info!("mps2-an386 started, boot {=u32}", boot);
        Some(Self {
            link,
            sensor,
            watchdog: Watchdog::start(HZ),
            boot,
            journal: Journal::default(),
        })
    }

    /// A number that tells this start from others: the host's clock in seconds.
    #[must_use]
    pub fn boot(&self) -> u32 {
        self.boot
    }
}

fn has_input() -> bool {
    CARRIER.port().has_input() || uart::SENSOR.port().has_input()
}

impl Board for Mps2An386 {
    type Link = Link;
    type Sensor = UartStream;

    fn link(&mut self) -> &mut Link {
        &mut self.link
    }

    fn sensor(&mut self) -> &mut UartStream {
        &mut self.sensor
    }

    fn now(&mut self) -> Micros {
        clock::now()
    }

    fn feed(&mut self) {
        self.watchdog.feed();
    }

    fn sleep(&mut self, until: Micros) {
        log::drain(semihosting::write);
        clock::sleep(until.min(clock::now().after(LONGEST_SLEEP)), has_input);
    }

    fn log(&mut self, turn: Turn, statistics: Statistics) {
        self.journal.note(turn, statistics, CARRIER.port().lost());
    }
}

/// Lets a semihosting call that nobody answered return; see [`semihosting::refused`].
///
/// # Safety
/// `frame` is the frame that the core pushed when it entered the fault handler.
pub(crate) unsafe fn resume(frame: &mut ExceptionFrame) -> bool {
    // SAFETY: by the caller's word.
    unsafe { semihosting::refused(frame) }
}

/// After a fault: ends QEMU with exit code 1, or, where there is nobody to tell, waits for the watchdog.
pub(crate) fn stop() -> ! {
    log::drain(semihosting::write);
    semihosting::exit_failure();
    loop {
        cortex_m::asm::wfi();
    }
}

/// The watchdog's warning: the loop has not turned for 5 s.
#[exception]
unsafe fn NonMaskableInt() {
    defmt::error!("the loop hangs; the watchdog resets the board");
    stop()
}
