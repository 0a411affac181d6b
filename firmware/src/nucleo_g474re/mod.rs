//! NUCLEO-G474RE: an STM32G474RE (Cortex-M4F, 170 MHz, three CAN-FD controllers) with an ST-LINK on board.
//!
//! | what | where |
//! |---|---|
//! | host link | LPUART1, PA2/PA3, the ST-LINK's virtual COM port, 921600 baud, 8N1 |
//! | hand sensor | USART1, PC4 (D1) TX, PC5 (D0) RX, 115200 baud, 8N1 |
//! | gesture sensor | I2C2, PA8 (D7) SDA, PA9 (D8) SCL, 400 kHz: a PAJ7620U2 at 3.3 V, there or not |
//! | CAN | FDCAN1, PA11 RX, PA12 TX, clocked with 24 MHz; off the bus without the feature `can`, with it the host link at 1 Mbit/s |
//! | log | defmt over RTT: `cargo run --release` in `firmware/` shows it |
//!
//! Registers are used directly, through stm32-metapac: the HALs check their configuration with panics, which an image
//! without panics cannot hold.

#[cfg(feature = "can")]
mod can;
mod clocks;
mod i2c;
mod pins;
mod uart;
mod watchdog;

use cortex_m::peripheral::SCB;
use cortex_m_rt::{ExceptionFrame, exception};
use deictic_core::gesture::mapping::STROKES;
use deictic_core::gesture::stroke::Likely;
use deictic_core::time::Micros;
use deictic_core::unit::Statistics;
use stm32_metapac::DBGMCU;

use crate::arm::journal::Journal;
use crate::arm::{clock, fault, guard};
use crate::recogniser::Recogniser;
use crate::stm32_i2c::Controller;
use crate::{Board, Turn};
use i2c::I2c2;
use uart::UartStream;
use watchdog::Watchdog;

/// Core clock in megahertz.
pub(crate) const MHZ: u32 = 170;
const HZ: u32 = MHZ * 1_000_000;
/// Longest sleep; the watchdog waits 2 s.
const LONGEST_SLEEP: Micros = Micros::from_millis(100);

/// The host link: LPUART1.
#[cfg(not(feature = "can"))]
pub type Link = UartStream;
/// The host link: FDCAN1.
#[cfg(feature = "can")]
pub type Link = crate::can::CanLink<can::Fdcan>;

#[cfg(not(feature = "can"))]
fn start_link() -> Link {
    uart::start_link()
}

#[cfg(feature = "can")]
fn start_link() -> Link {
    crate::can::CanLink::new(can::Fdcan::start())
}

/// The running board.
pub struct NucleoG474Re {
    link: Link,
    sensor: UartStream,
    recogniser: Recogniser<Controller<I2c2>>,
    watchdog: Watchdog,
    boot: u32,
    journal: Journal,
}

impl NucleoG474Re {
    /// Starts clocks, links and watchdog. None if it was called before. A board whose clocks do not start resets, to
    /// try again.
    #[must_use]
    pub fn start() -> Option<Self> {
        let mut core = cortex_m::Peripherals::take()?;
        guard::enable(&mut core.MPU);
        // Keeps the debug probe connected while the core sleeps.
        DBGMCU.cr().modify(|w| w.set_dbg_sleep(true));
        let Ok(crystal) = clocks::start() else {
            SCB::sys_reset()
        };
        clock::start(core.SYST);
        let boot = clocks::random();
        pins::connect();
        clocks::supply_can();
        let link = start_link();
        let sensor = uart::start_sensor();
        let recogniser = Recogniser::new(i2c::start());
        if !crystal {
            defmt::warn!("the 24 MHz crystal does not start: CAN is unusable");
        }
        if boot.is_none() {
            defmt::warn!("no random number: a host cannot tell this start from the last");
        }
        if let Some(fault) = fault::take_previous() {
            defmt::warn!("restarted after a fault at {=u32:#010x}", fault.pc);
        }
        let boot = boot.unwrap_or(0);
        defmt::info!("nucleo-g474re started, boot {=u32:#010x}", boot);
        Some(Self {
            link,
            sensor,
            recogniser,
            watchdog: Watchdog::start(),
            boot,
            journal: Journal::default(),
        })
    }

    /// A number that tells this start from others.
    #[must_use]
    pub fn boot(&self) -> u32 {
        self.boot
    }
}

fn has_input() -> bool {
    #[cfg(feature = "can")]
    if can::is_due() {
        return true;
    }
    uart::LINK.port().has_input() || uart::SENSOR.port().has_input()
}

impl Board for NucleoG474Re {
    type Link = Link;
    type Sensor = UartStream;

    fn link(&mut self) -> &mut Link {
        &mut self.link
    }

    fn sensor(&mut self) -> &mut UartStream {
        &mut self.sensor
    }

    fn recognised(&mut self, now: Micros) -> Option<Likely<STROKES>> {
        let before = (self.recogniser.is_there(), self.recogniser.other());
        let recognised = self.recogniser.look(now);
        let after = (self.recogniser.is_there(), self.recogniser.other());
        if after != before {
            match after {
                (true, _) => defmt::info!("a PAJ7620U2 is on the bus"),
                (false, Some(part)) => {
                    defmt::warn!("part {=u16:#06x} answers in the place of a PAJ7620U2", part)
                }
                (false, None) => defmt::warn!("no PAJ7620U2 on the bus any more"),
            }
        }
        if recognised.is_some() {
            defmt::info!("the PAJ7620U2 has recognised a gesture");
        }
        recognised
    }

    fn next_look(&self) -> Micros {
        self.recogniser.due()
    }

    fn now(&mut self) -> Micros {
        clock::now()
    }

    fn feed(&mut self) {
        self.watchdog.feed();
    }

    fn sleep(&mut self, until: Micros) {
        clock::sleep(until.min(clock::now().after(LONGEST_SLEEP)), has_input);
    }

    fn log(&mut self, turn: Turn, statistics: Statistics) {
        self.journal
            .note(turn, statistics, uart::LINK.port().lost());
    }
}

/// No fault can be resumed on this board.
///
/// # Safety
/// None needed; the signature is that of boards that can.
pub(crate) unsafe fn resume(_frame: &mut ExceptionFrame) -> bool {
    false
}

/// After a fault: starts again. The robot has stopped by then, since heartbeats do not come.
pub(crate) fn stop() -> ! {
    SCB::sys_reset()
}

/// The clock security system's, which is off, or a wild jump's.
#[exception]
unsafe fn NonMaskableInt() {
    SCB::sys_reset()
}
