//! Which pin does what (data sheet DS12288, table 13; board manual UM2505).

use stm32_metapac::gpio::Gpio;
use stm32_metapac::gpio::vals::{Moder, Ospeedr, Pupdr};
use stm32_metapac::{GPIOA, GPIOC, RCC};

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
