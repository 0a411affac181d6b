//! LPUART1 and USART1 with FIFOs and interrupts (RM0440, sections 37 and 38).

use cortex_m::peripheral::NVIC;
use stm32_metapac::interrupt;
use stm32_metapac::usart::Lpuart;
use stm32_metapac::{Interrupt, LPUART1, RCC};

use super::HZ;
use crate::arm::port::{Port, Stream, Transmitter};

/// Queue lengths of both UARTs; see [`Port`].
const RX: usize = 512;
const TX: usize = 256;

/// The host bridge, through ST-LINK's virtual COM port.
pub(super) const LINK_BAUD: u32 = 921_600;
/// The hand sensor.
pub(super) const SENSOR_BAUD: u32 = 115_200;

/// A UART with its queues. The registers used here lie at the same places in both kinds.
#[derive(Clone, Copy)]
pub struct Uart {
    registers: Lpuart,
    port: &'static Port<RX, TX>,
}

static LINK_PORT: Port<RX, TX> = Port::new();
static SENSOR_PORT: Port<RX, TX> = Port::new();

/// LPUART1: the host bridge.
pub(super) const LINK: Uart = Uart {
    registers: LPUART1,
    port: &LINK_PORT,
};
/// USART1: the hand sensor.
pub(super) const SENSOR: Uart = Uart {
    // SAFETY: the address is USART1's, a superset of the registers of an LPUART.
    registers: unsafe { Lpuart::from_ptr(stm32_metapac::USART1.as_ptr()) },
    port: &SENSOR_PORT,
};

#[cfg_attr(feature = "can", allow(dead_code))]
/// Starts LPUART1: its divider counts 256ths of the clock.
pub(super) fn start_link() -> UartStream {
    RCC.apb1enr2().modify(|w| w.set_lpuart1en(true));
    const DIVIDER: u32 = (256 * (HZ as u64) / (LINK_BAUD as u64)) as u32;
    LINK.start(const { divider(DIVIDER, 0x300) }, Interrupt::LPUART1)
}

/// Starts USART1.
pub(super) fn start_sensor() -> UartStream {
    RCC.apb2enr().modify(|w| w.set_usart1en(true));
    SENSOR.start(const { divider(HZ / SENSOR_BAUD, 16) }, Interrupt::USART1)
}

/// `value` as the register takes it.
const fn divider(value: u32, least: u32) -> u16 {
    assert!(value >= least && value <= u16::MAX as u32, "baud rate");
    value as u16
}

impl Uart {
    fn start(self, divider: u16, interrupt: Interrupt) -> UartStream {
        self.registers.brr().write(|w| w.set_brr(divider));
        self.registers.cr1().write(|w| {
            w.set_fifoen(true);
            w.set_te(true);
            w.set_re(true);
            w.set_rxneie(true);
            w.set_ue(true);
        });
        // SAFETY: the handler shares data with the loop only inside critical sections.
        unsafe { NVIC::unmask(interrupt) };
        Stream::new(self.port, self)
    }

    /// Queues between the UART and the loop.
    pub(super) fn port(&self) -> &Port<RX, TX> {
        self.port
    }

    /// The interrupt of both directions.
    fn serve(self) {
        loop {
            let state = self.registers.isr().read();
            if state.ore() {
                self.registers.icr().write(|w| w.set_ore(true));
                self.port.count_lost(1);
            }
            if !state.rxne() {
                break;
            }
            self.port.arrived(self.registers.rdr().read().dr() as u8);
        }
        while self.registers.cr1().read().txeie() && self.registers.isr().read().txe() {
            match self.port.departing() {
                Some(byte) => self.registers.tdr().write(|w| w.set_dr(u16::from(byte))),
                None => self.registers.cr1().modify(|w| w.set_txeie(false)),
            }
        }
    }
}

impl Transmitter for Uart {
    fn kick(&mut self) {
        // The interrupt changes the same register.
        critical_section::with(|_| self.registers.cr1().modify(|w| w.set_txeie(true)));
    }
}

/// The loop's end of a UART.
pub type UartStream = Stream<Uart, RX, TX>;

#[interrupt]
fn LPUART1() {
    LINK.serve();
}

#[interrupt]
fn USART1() {
    SENSOR.serve();
}
