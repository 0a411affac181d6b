//! The two byte queues between a UART's interrupts and the loop.

use core::cell::{Cell, RefCell};
use core::convert::Infallible;

use critical_section::Mutex;
use embedded_io::{ErrorType, Read, ReadReady, Write, WriteReady};
use heapless::Deque;

/// Queue lengths in bytes: `RX` bridges the longest the loop is away from the link (a decision of 12,000 instructions
/// is 0.5 ms at 25 MHz, 48 bytes at 921600 baud); `TX` lets a turn hand over a whole frame.
pub(crate) struct Port<const RX: usize, const TX: usize> {
    rx: Mutex<RefCell<Deque<u8, RX>>>,
    tx: Mutex<RefCell<Deque<u8, TX>>>,
    lost: Mutex<Cell<u32>>,
}

impl<const RX: usize, const TX: usize> Port<RX, TX> {
    pub(crate) const fn new() -> Self {
        Self {
            rx: Mutex::new(RefCell::new(Deque::new())),
            tx: Mutex::new(RefCell::new(Deque::new())),
            lost: Mutex::new(Cell::new(0)),
        }
    }

    /// From the receive interrupt. A byte that finds no room is dropped and counted; the frame it belonged to fails
    /// its CRC.
    pub(crate) fn arrived(&self, byte: u8) {
        critical_section::with(|cs| {
            let kept = match self.rx.borrow(cs).try_borrow_mut() {
                Ok(mut rx) => rx.push_back(byte).is_ok(),
                Err(_) => false,
            };
            if !kept {
                self.count_lost(1);
            }
        });
    }

    /// From the transmit interrupt: the next byte to put on the wire.
    pub(crate) fn departing(&self) -> Option<u8> {
        critical_section::with(|cs| self.tx.borrow(cs).try_borrow_mut().ok()?.pop_front())
    }

    /// Adds to the bytes lost, here or in the UART itself.
    pub(crate) fn count_lost(&self, bytes: u32) {
        critical_section::with(|cs| {
            let lost = self.lost.borrow(cs);
            lost.set(lost.get().saturating_add(bytes));
        });
    }

    /// Received bytes lost since the start.
    pub(crate) fn lost(&self) -> u32 {
        critical_section::with(|cs| self.lost.borrow(cs).get())
    }

    /// A received byte waits.
    pub(crate) fn has_input(&self) -> bool {
        critical_section::with(|cs| {
            self.rx
                .borrow(cs)
                .try_borrow()
                .is_ok_and(|rx| !rx.is_empty())
        })
    }

    /// A byte to send would find room.
    pub(crate) fn has_room(&self) -> bool {
        critical_section::with(|cs| {
            self.tx
                .borrow(cs)
                .try_borrow()
                .is_ok_and(|tx| !tx.is_full())
        })
    }

    fn read(&self, into: &mut [u8]) -> usize {
        critical_section::with(|cs| {
            let Ok(mut rx) = self.rx.borrow(cs).try_borrow_mut() else {
                return 0;
            };
            into.iter_mut()
                .map_while(|slot| rx.pop_front().map(|byte| *slot = byte))
                .count()
        })
    }

    fn write(&self, bytes: &[u8]) -> usize {
        critical_section::with(|cs| {
            let Ok(mut tx) = self.tx.borrow(cs).try_borrow_mut() else {
                return 0;
            };
            bytes
                .iter()
                .take_while(|byte| tx.push_back(**byte).is_ok())
                .count()
        })
    }
}

/// Starts a UART's transmitter after bytes were queued. A type and not a function pointer: the worst-case stack is
/// read from the calls in the image, and an indirect one hides its target.
pub trait Transmitter {
    /// Makes the transmit interrupt run, which then feeds itself.
    fn kick(&mut self);
}

/// The loop's end of a port.
pub struct Stream<T, const RX: usize, const TX: usize> {
    port: &'static Port<RX, TX>,
    transmitter: T,
}

impl<T: Transmitter, const RX: usize, const TX: usize> Stream<T, RX, TX> {
    pub(crate) const fn new(port: &'static Port<RX, TX>, transmitter: T) -> Self {
        Self { port, transmitter }
    }
}

impl<T, const RX: usize, const TX: usize> ErrorType for Stream<T, RX, TX> {
    type Error = Infallible;
}

impl<T: Transmitter, const RX: usize, const TX: usize> Read for Stream<T, RX, TX> {
    fn read(&mut self, into: &mut [u8]) -> Result<usize, Infallible> {
        loop {
            let read = self.port.read(into);
            if read > 0 || into.is_empty() {
                return Ok(read);
            }
            cortex_m::asm::wfi();
        }
    }
}

impl<T: Transmitter, const RX: usize, const TX: usize> ReadReady for Stream<T, RX, TX> {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.port.has_input())
    }
}

impl<T: Transmitter, const RX: usize, const TX: usize> Write for Stream<T, RX, TX> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        loop {
            let written = self.port.write(bytes);
            self.transmitter.kick();
            if written > 0 || bytes.is_empty() {
                return Ok(written);
            }
            cortex_m::asm::wfi();
        }
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        while critical_section::with(|cs| {
            self.port
                .tx
                .borrow(cs)
                .try_borrow()
                .is_ok_and(|tx| !tx.is_empty())
        }) {
            cortex_m::asm::wfi();
        }
        Ok(())
    }
}

impl<T: Transmitter, const RX: usize, const TX: usize> WriteReady for Stream<T, RX, TX> {
    fn write_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.port.has_room())
    }
}
