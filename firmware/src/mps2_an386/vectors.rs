//! Interrupts of the AN386 image that are used (Arm DAI 0386, table 3-7).

use cortex_m::interrupt::InterruptNumber;

use super::uart;

/// An interrupt's number.
#[derive(Clone, Copy)]
#[repr(u16)]
pub(super) enum Interrupt {
    Uart0Rx = 0,
    Uart0Tx = 1,
    #[cfg(feature = "can")]
    Uart1Rx = 2,
    #[cfg(feature = "can")]
    Uart1Tx = 3,
    Uart2Rx = 4,
    Uart2Tx = 5,
}

impl Interrupt {
    pub(super) const ALL: &[Self] = &[
        Self::Uart0Rx,
        Self::Uart0Tx,
        #[cfg(feature = "can")]
        Self::Uart1Rx,
        #[cfg(feature = "can")]
        Self::Uart1Tx,
        Self::Uart2Rx,
        Self::Uart2Tx,
    ];
}

// SAFETY: the numbers are those of the data sheet and different.
unsafe impl InterruptNumber for Interrupt {
    fn number(self) -> u16 {
        self as u16
    }
}

/// The table's part after the core's own exceptions, at the places of [`Interrupt`]. No other interrupt is unmasked.
#[unsafe(no_mangle)]
#[unsafe(link_section = ".vector_table.interrupts")]
static __INTERRUPTS: [Option<extern "C" fn()>; 6] = [
    Some(uart0_rx),
    Some(uart0_tx),
    UART1_RX,
    UART1_TX,
    Some(uart2_rx),
    Some(uart2_tx),
];

extern "C" fn uart0_rx() {
    uart::LINK.receive();
}

extern "C" fn uart0_tx() {
    uart::LINK.transmit();
}

#[cfg(not(feature = "can"))]
const UART1_RX: Option<extern "C" fn()> = None;
#[cfg(not(feature = "can"))]
const UART1_TX: Option<extern "C" fn()> = None;
#[cfg(feature = "can")]
const UART1_RX: Option<extern "C" fn()> = Some(uart1_rx);
#[cfg(feature = "can")]
const UART1_TX: Option<extern "C" fn()> = Some(uart1_tx);

#[cfg(feature = "can")]
extern "C" fn uart1_rx() {
    uart::ADAPTER.receive();
}

#[cfg(feature = "can")]
extern "C" fn uart1_tx() {
    uart::ADAPTER.transmit();
}

extern "C" fn uart2_rx() {
    uart::SENSOR.receive();
}

extern "C" fn uart2_tx() {
    uart::SENSOR.transmit();
}
