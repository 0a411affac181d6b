//! Which pin does what (data sheet DS12288, table 13; board manual UM2505).

use stm32_metapac::gpio::Gpio;
use stm32_metapac::gpio::vals::{Moder, Odr, Ospeedr, Ot, Pupdr};
use stm32_metapac::{GPIOA, GPIOC, RCC};

use super::MHZ;

/// Connects the pins to LPUART1 (PA2, PA3: ST-LINK's virtual COM port), USART1 (PC4, PC5: D1 and D0) and FDCAN1
/// (PA11, PA12: to a CAN transceiver).
pub(super) fn connect() {
    RCC.ahb2enr().modify(|w| {
        w.set_gpioaen(true);
        w.set_gpiocen(true);
    });
    alternate::<2, 12>(GPIOA);
    alternate::<3, 12>(GPIOA);
    alternate::<4, 7>(GPIOC);
    alternate::<5, 7>(GPIOC);
    alternate::<11, 9>(GPIOA);
    alternate::<12, 9>(GPIOA);
}

/// Gives a pin to its alternate function. Pulled up, so that an open input reads as an idle line.
fn alternate<const PIN: usize, const FUNCTION: u8>(port: Gpio) {
    port.afr(PIN / 8).modify(|w| w.set_afr(PIN % 8, FUNCTION));
    port.pupdr().modify(|w| w.set_pupdr(PIN, Pupdr::PULL_UP));
    port.ospeedr()
        .modify(|w| w.set_ospeedr(PIN, Ospeedr::HIGH_SPEED));
    port.moder().modify(|w| w.set_moder(PIN, Moder::ALTERNATE));
}

/// Connects PA8 (D7) and PA9 (D8) to I2C2's SDA and SCL. I2C1's usual pins, D14 and D15, are not used: D15 is PB8, which
/// is BOOT0 as well, and a bus's pull-up there would start the chip's own loader instead of the unit.
pub(super) fn connect_i2c() {
    open_drain::<8>();
    open_drain::<9>();
    free_bus();
    alternate_slowly::<8, 4>();
    alternate_slowly::<9, 4>();
}

/// A pin of port A that drives low only. Its own pull-up is enough for a bus without a device; one with a device has
/// stronger ones.
fn open_drain<const PIN: usize>() {
    GPIOA.odr().modify(|w| w.set_odr(PIN, Odr::HIGH));
    GPIOA.otyper().modify(|w| w.set_ot(PIN, Ot::OPEN_DRAIN));
    GPIOA.pupdr().modify(|w| w.set_pupdr(PIN, Pupdr::PULL_UP));
}

/// Gives an open-drain pin of port A to its alternate function; edges of 400 kHz need no speed.
fn alternate_slowly<const PIN: usize, const FUNCTION: u8>() {
    GPIOA.afr(PIN / 8).modify(|w| w.set_afr(PIN % 8, FUNCTION));
    GPIOA.moder().modify(|w| w.set_moder(PIN, Moder::ALTERNATE));
}

/// A device that was sending when the board was reset holds SDA until it has seen the rest of its byte and no
/// acknowledgement: nine clocks on PA9 at most (UM10204, section 3.1.16).
fn free_bus() {
    GPIOA.moder().modify(|w| w.set_moder(9, Moder::OUTPUT));
    for _ in 0..9 {
        GPIOA.odr().modify(|w| w.set_odr(9, Odr::LOW));
        cortex_m::asm::delay(5 * MHZ);
        GPIOA.odr().modify(|w| w.set_odr(9, Odr::HIGH));
        cortex_m::asm::delay(5 * MHZ);
    }
}
