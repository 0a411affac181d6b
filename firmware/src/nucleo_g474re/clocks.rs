//! 170 MHz for the core, an exact 24 MHz for CAN, a random number for the boot.

use stm32_metapac::rcc::vals::{Clk48sel, Fdcansel, Hpre, Pllm, Plln, Pllr, Pllsrc, Ppre, Sw};
use stm32_metapac::{FLASH, PWR, RCC, RNG, flash::vals::Latency};

use super::MHZ;

/// Polls of a status bit before giving up; the slowest thing waited for, the crystal, takes 2 ms, 32,000 cycles of the
/// 16 MHz the core starts with.
const PATIENCE: u32 = 100_000;

/// Waits until `ready` holds; false when it did not come to hold.
fn wait(ready: impl Fn() -> bool) -> bool {
    (0..PATIENCE).any(|_| ready())
}

/// Brings core and buses to 170 MHz in voltage range 1 with boost (RM0440, sections 6.1.5 and 7.2), from the board's
/// 24 MHz crystal or, where it does not start, from the internal 16 MHz oscillator, whose 1 % is enough for the serial
/// ports but not for CAN. `Err` when nothing starts, else whether the crystal did.
pub(super) fn start() -> Result<bool, ()> {
    const { assert!(MHZ == 170, "the PLL below makes 170 MHz") };
    RCC.apb1enr1().modify(|w| w.set_pwren(true));
    RCC.cr().modify(|w| w.set_hseon(true));
    let crystal = wait(|| RCC.cr().read().hserdy());

    RCC.pllcfgr().write(|w| {
        w.set_pllsrc(if crystal { Pllsrc::HSE } else { Pllsrc::HSI });
        // 24 MHz / 6 or 16 MHz / 4 = 4 MHz; times 85 = 340 MHz; by 2 = 170 MHz.
        w.set_pllm(if crystal { Pllm::DIV6 } else { Pllm::DIV4 });
        w.set_plln(Plln::MUL85);
        w.set_pllr(Pllr::DIV2);
        w.set_pllren(true);
    });
    RCC.cr().modify(|w| w.set_pllon(true));
    if !wait(|| RCC.cr().read().pllrdy()) {
        return Err(());
    }

    PWR.cr5().modify(|w| w.set_r1mode(false));
    FLASH.acr().modify(|w| {
        w.set_latency(Latency::WS4);
        w.set_prften(true);
    });
    // Above 80 MHz in two steps: first at half the speed, for at least 1 us.
    RCC.cfgr().modify(|w| {
        w.set_hpre(Hpre::DIV2);
        w.set_ppre1(Ppre::DIV1);
        w.set_ppre2(Ppre::DIV1);
    });
    RCC.cfgr().modify(|w| w.set_sw(Sw::PLL1_R));
    if !wait(|| RCC.cfgr().read().sws() == Sw::PLL1_R) {
        return Err(());
    }
    cortex_m::asm::delay(MHZ);
    RCC.cfgr().modify(|w| w.set_hpre(Hpre::DIV1));
    Ok(crystal)
}

/// Gives the CAN controller its clock and leaves it in the initialisation mode that it resets to: off the bus.
pub(super) fn supply_can() {
    RCC.ccipr().modify(|w| w.set_fdcansel(Fdcansel::HSE));
    RCC.apb1enr1().modify(|w| w.set_fdcanen(true));
}

/// A random number from the hardware generator (RM0440, section 26); none where its clock or its self-test fails.
pub(super) fn random() -> Option<u32> {
    RCC.crrcr().modify(|w| w.set_hsi48on(true));
    if !wait(|| RCC.crrcr().read().hsi48rdy()) {
        return None;
    }
    RCC.ccipr().modify(|w| w.set_clk48sel(Clk48sel::HSI48));
    RCC.ahb2enr().modify(|w| w.set_rngen(true));
    RNG.cr().write(|w| w.set_rngen(true));
    let found = wait(|| RNG.sr().read().drdy()).then(|| RNG.dr().read());
    RNG.cr().write(|_| {});
    RCC.ahb2enr().modify(|w| w.set_rngen(false));
    RCC.crrcr().modify(|w| w.set_hsi48on(false));
    found.filter(|number| *number != 0)
}
