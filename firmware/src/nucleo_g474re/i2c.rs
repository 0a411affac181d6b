//! I2C2 at 400 kHz, for a gesture sensor (RM0440, section 41).

use stm32_metapac::i2c::vals::{Autoend, Dir};
use stm32_metapac::{I2C2, RCC};

use super::{MHZ, pins};
use crate::stm32_i2c::{Controller, Flags, Registers};

/// I2C2's registers.
pub struct I2c2(());

/// Starts I2C2 on its pins.
pub(super) fn start() -> Controller<I2c2> {
    const { assert!(MHZ == 170, "the timing below is that of 170 MHz") };
    pins::connect_i2c();
    RCC.apb1enr1().modify(|w| w.set_i2c2en(true));
    // In steps of 5 / 170 MHz = 29.4 ns, by the sums of RM0440, section 41.4.5, and the limits of the bus's fast mode:
    // low for 1.41 us (1.3 at least), high for 0.76 us (0.6), data held for 0.24 us and set up for 0.41 us before the
    // clock rises. With what both edges take this comes to just under 400 kHz.
    I2C2.timingr().write(|w| {
        w.set_presc(4);
        w.set_scll(47);
        w.set_sclh(25);
        w.set_sdadel(8);
        w.set_scldel(13);
    });
    I2C2.cr1().write(|w| w.set_pe(true));
    Controller(I2c2(()))
}

impl Registers for I2c2 {
    fn flags(&mut self) -> Flags {
        let isr = I2C2.isr().read();
        Flags {
            wants: isr.txis(),
            has: isr.rxne(),
            complete: isr.tc(),
            stopped: isr.stopf(),
            refused: isr.nackf(),
            misplaced: isr.berr(),
            overruled: isr.arlo(),
        }
    }

    fn begin(&mut self, address: u8, reads: bool, bytes: u8) {
        I2C2.cr2().write(|w| {
            w.set_sadd(u16::from(address) << 1);
            w.set_dir(if reads { Dir::READ } else { Dir::WRITE });
            w.set_nbytes(bytes);
            w.set_autoend(Autoend::SOFTWARE);
            w.set_start(true);
        });
    }

    fn put(&mut self, byte: u8) {
        I2C2.txdr().write(|w| w.set_txdata(byte));
    }

    fn take(&mut self) -> u8 {
        I2C2.rxdr().read().rxdata()
    }

    fn stop(&mut self) {
        I2C2.cr2().modify(|w| w.set_stop(true));
    }

    fn restart(&mut self) {
        I2C2.cr1().modify(|w| w.set_pe(false));
        // Three cycles of the bus's clock, which the reading ensures (section 41.4.6).
        while I2C2.cr1().read().pe() {}
        I2C2.cr1().modify(|w| w.set_pe(true));
    }
}
