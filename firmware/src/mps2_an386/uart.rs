//! CMSDK APB UART (Arm DUI 0646, chapter on the APB UART) with receive and transmit interrupts.

use cortex_m::peripheral::NVIC;

use super::Interrupt;
use crate::arm::port::{Port, Stream, Transmitter};

/// Queue lengths of both UARTs; see [`Port`].
const RX: usize = 512;
const TX: usize = 256;

const DATA: usize = 0;
const STATE: usize = 1;
const CONTROL: usize = 2;
const INTERRUPTS: usize = 3;
const BAUD_DIVIDER: usize = 4;

const STATE_TX_FULL: u32 = 1;
const STATE_RX_FULL: u32 = 1 << 1;
const STATE_RX_OVERRUN: u32 = 1 << 3;
const INTERRUPT_TX: u32 = 1;
const INTERRUPT_RX: u32 = 1 << 1;
/// TX and RX, each with its interrupt.
const CONTROL_ON: u32 = 0b1111;

/// One of the board's UARTs.
pub(super) struct Uart {
    base: usize,
    transmit: Interrupt,
    port: &'static Port<RX, TX>,
}

/// UART0: the host bridge.
pub(super) static LINK: Uart = Uart {
    base: 0x4000_4000,
    transmit: Interrupt::Uart0Tx,
    port: &LINK_PORT,
};
/// UART1: the host bridge's LAWICEL adapter.
#[cfg(feature = "can")]
pub(super) static ADAPTER: Uart = Uart {
    base: 0x4000_5000,
    transmit: Interrupt::Uart1Tx,
    port: &ADAPTER_PORT,
};
/// UART2: the hand sensor.
pub(super) static SENSOR: Uart = Uart {
    base: 0x4000_6000,
    transmit: Interrupt::Uart2Tx,
    port: &SENSOR_PORT,
};
static LINK_PORT: Port<RX, TX> = Port::new();
#[cfg(feature = "can")]
static ADAPTER_PORT: Port<RX, TX> = Port::new();
static SENSOR_PORT: Port<RX, TX> = Port::new();

impl Uart {
    fn read(&self, register: usize) -> u32 {
        // SAFETY: `base` is a UART of this board and `register` one of its first five words.
        unsafe { (self.base as *const u32).add(register).read_volatile() }
    }

    fn write(&self, register: usize, value: u32) {
        // SAFETY: as in `read`.
        unsafe { (self.base as *mut u32).add(register).write_volatile(value) }
    }

    /// Turns the UART on at `baud`, both directions with interrupts.
    pub(super) fn start(&'static self, core_hz: u32, baud: u32) -> UartStream {
        self.write(BAUD_DIVIDER, core_hz.checked_div(baud).unwrap_or(16));
        self.write(CONTROL, CONTROL_ON);
        Stream::new(self.port, Kick(self.transmit))
    }

    /// Queues between the UART and the loop.
    pub(super) fn port(&self) -> &Port<RX, TX> {
        self.port
    }

    /// Receive interrupt: takes what has arrived.
    pub(super) fn receive(&self) {
        self.write(INTERRUPTS, INTERRUPT_RX);
        loop {
            let state = self.read(STATE);
            if state & STATE_RX_OVERRUN != 0 {
                self.write(STATE, STATE_RX_OVERRUN);
                self.port.count_lost(1);
            }
            if state & STATE_RX_FULL == 0 {
                return;
            }
            self.port.arrived(self.read(DATA) as u8);
        }
    }

    /// Transmit interrupt: gives the UART what it takes.
    pub(super) fn transmit(&self) {
        self.write(INTERRUPTS, INTERRUPT_TX);
        while self.read(STATE) & STATE_TX_FULL == 0 {
            match self.port.departing() {
                Some(byte) => self.write(DATA, u32::from(byte)),
                None => return,
            }
        }
    }
}

/// Starts the transmitter by calling its interrupt.
pub struct Kick(Interrupt);

impl Transmitter for Kick {
    fn kick(&mut self) {
        NVIC::pend(self.0);
    }
}

/// The loop's end of a UART.
pub type UartStream = Stream<Kick, RX, TX>;
