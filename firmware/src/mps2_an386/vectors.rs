//! Interrupts of the AN386 image that are used (Arm DAI 0386, table 3-7).

use cortex_m::interrupt::InterruptNumber;

use super::uart;

/// An interrupt's number.
#[derive(Clone, Copy)]
#[repr(u16)]
pub(super) enum Interrupt {
    Uart0Rx = 0,
    Uart0Tx = 1,
    Uart1Rx = 2,
    Uart1Tx = 3,
}

impl Interrupt {
    pub(super) const ALL: [Self; 4] = [Self::Uart0Rx, Self::Uart0Tx, Self::Uart1Rx, Self::Uart1Tx];
}

// SAFETY: the numbers are those of the data sheet and different.
unsafe impl InterruptNumber for Interrupt {
    fn number(self) -> u16 {
        self as u16
    }
}

/// The table's part after the core's own exceptions, in the order of [`Interrupt`]. No other interrupt is unmasked.
#[unsafe(no_mangle)]
#[unsafe(link_section = ".vector_table.interrupts")]
static __INTERRUPTS: [extern "C" fn(); 4] = [uart0_rx, uart0_tx, uart1_rx, uart1_tx];

extern "C" fn uart0_rx() {
    uart::LINK.receive();
}

extern "C" fn uart0_tx() {
    uart::LINK.transmit();
}

extern "C" fn uart1_rx() {
    uart::SENSOR.receive();
}

extern "C" fn uart1_tx() {
    uart::SENSOR.transmit();
}
