//! How the I2C peripheral of an STM32 moves bytes as the only controller of a bus (RM0440, section 41.4): which flag
//! is waited for, and what is done when it does not come. Where its registers are is the board's matter
//! ([`Registers`]), so that this very code meets a peripheral in memory in tests.

use embedded_hal::i2c::{ErrorKind, ErrorType, I2c, NoAcknowledgeSource, Operation};

/// Looks at the flags before a transfer is given up. One takes ten cycles and more, so this is 0.3 ms and more at
/// 170 MHz; a byte takes 23 us at 400 kHz.
const PATIENCE: u32 = 5_000;

/// What the peripheral's status register shows (I2C_ISR).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags {
    /// TXIS: it wants the next byte.
    pub wants: bool,
    /// RXNE: it has a byte.
    pub has: bool,
    /// TC: all bytes of the transfer are through.
    pub complete: bool,
    /// STOPF: the bus is free again.
    pub stopped: bool,
    /// NACKF: nobody acknowledged.
    pub refused: bool,
    /// BERR: a start or a stop where none can be.
    pub misplaced: bool,
    /// ARLO: somebody else drove the bus.
    pub overruled: bool,
}

/// The registers of a peripheral.
pub trait Registers {
    /// What it shows.
    fn flags(&mut self) -> Flags;
    /// Addresses a device, again if a transfer is open, and asks for so many bytes to be read, or written (I2C_CR2
    /// with START, without AUTOEND).
    fn begin(&mut self, address: u8, reads: bool, bytes: u8);
    /// Writes the next byte (I2C_TXDR).
    fn put(&mut self, byte: u8);
    /// Takes a byte (I2C_RXDR).
    fn take(&mut self) -> u8;
    /// Ends the transfer (STOP in I2C_CR2).
    fn stop(&mut self);
    /// Forgets all flags, and whatever it was doing (PE in I2C_CR1 off and on).
    fn restart(&mut self);
}

/// A peripheral with its bus.
#[derive(Debug)]
pub struct Controller<R>(pub R);

impl<R: Registers> Controller<R> {
    fn transfer(&mut self, address: u8, operations: &mut [Operation<'_>]) -> Result<(), ErrorKind> {
        let mut going = None;
        let mut unanswered = NoAcknowledgeSource::Address;
        for at in 0..operations.len() {
            let rest = operations.get(at..).unwrap_or(&[]);
            let way = rest.first().map(reads);
            if way != going {
                if going.is_some() {
                    self.wait(unanswered, |flags| flags.complete)?;
                }
                going = way;
                unanswered = NoAcknowledgeSource::Address;
                let alike = rest.iter().take_while(|o| Some(reads(o)) == way);
                let bytes = alike.map(length).fold(0, usize::saturating_add);
                // What the peripheral counts without being asked again.
                let bytes = u8::try_from(bytes).map_err(|_| ErrorKind::Other)?;
                self.0.begin(address, way == Some(true), bytes);
            }
            match operations.get_mut(at) {
                Some(Operation::Write(bytes)) => {
                    for byte in *bytes {
                        self.wait(unanswered, |flags| flags.wants)?;
                        self.0.put(*byte);
                        unanswered = NoAcknowledgeSource::Data;
                    }
                }
                Some(Operation::Read(bytes)) => {
                    for byte in bytes.iter_mut() {
                        self.wait(unanswered, |flags| flags.has)?;
                        *byte = self.0.take();
                    }
                }
                None => {}
            }
        }
        self.wait(unanswered, |flags| flags.complete)
    }

    fn wait(
        &mut self,
        unanswered: NoAcknowledgeSource,
        wanted: impl Fn(&Flags) -> bool,
    ) -> Result<(), ErrorKind> {
        for _ in 0..PATIENCE {
            let flags = self.0.flags();
            if flags.refused {
                return Err(ErrorKind::NoAcknowledge(unanswered));
            }
            if flags.overruled {
                return Err(ErrorKind::ArbitrationLoss);
            }
            if flags.misplaced {
                return Err(ErrorKind::Bus);
            }
            if wanted(&flags) {
                return Ok(());
            }
        }
        Err(ErrorKind::Other)
    }

    /// Frees the bus, as far as it can be, and leaves nothing behind for the next transfer.
    fn end(&mut self) {
        self.0.stop();
        let _ = (0..PATIENCE).find(|_| self.0.flags().stopped);
        self.0.restart();
    }
}

fn reads(operation: &Operation<'_>) -> bool {
    matches!(operation, Operation::Read(_))
}

fn length(operation: &Operation<'_>) -> usize {
    match operation {
        Operation::Read(bytes) => bytes.len(),
        Operation::Write(bytes) => bytes.len(),
    }
}

impl<R> ErrorType for Controller<R> {
    type Error = ErrorKind;
}

impl<R: Registers> I2c for Controller<R> {
    /// At most 255 bytes one way; more are [`ErrorKind::Other`], as is a bus on which nothing moves.
    fn transaction(
        &mut self,
        address: u8,
        operations: &mut [Operation<'_>],
    ) -> Result<(), ErrorKind> {
        if operations.is_empty() {
            return Ok(());
        }
        let done = self.transfer(address, operations);
        self.end();
        done
    }
}
