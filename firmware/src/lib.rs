//! The gesture unit's board: a thin loop around [`deictic_core::unit::Unit`], which holds all behaviour.
//!
//! [`turn()`] and [`run`] know a board only as a [`Board`]: two byte streams, what a gesture sensor may have recognised, a clock, a watchdog and a way to sleep.
//! They build and are tested on any host. A board module, chosen by a cargo feature, fills the trait in:
//!
//! | feature | board | host link | sensor link | log |
//! |---|---|---|---|---|
//! | `mps2-an386` | QEMU `-M mps2-an386` (Cortex-M4F, 25 MHz) | UART0 | UART2 | RTT ring, read out over semihosting |
//! | `nucleo-g474re` | NUCLEO-G474RE (Cortex-M4F, 170 MHz, FDCAN) | LPUART1 (ST-LINK's virtual COM port), 921600 baud | USART1 on PC4/PC5, 115200 baud | RTT |
//!
//! With the feature `can` the host link is a node on a CAN bus (`can.rs`): FDCAN1 on the real board, and a LAWICEL adapter
//! (`adapter.rs`) on the second UART of the emulated one, which has no controller.
//!
//! In a release image no panic can be reached: the panic handler calls a function that nowhere exists, so an image
//! that still holds a panic does not link.
#![no_std]

#[cfg(test)]
extern crate std;

#[cfg(any(feature = "can", test))]
pub mod adapter;
mod board;
#[cfg(any(feature = "can", test))]
pub mod can;
mod key;
pub mod paj7620;
pub mod recogniser;
pub mod stm32_i2c;
mod turn;

pub use board::Board;
pub use key::lock;
pub use turn::{Turn, run, turn};

#[cfg(all(feature = "mps2-an386", feature = "nucleo-g474re"))]
compile_error!("choose one board: either mps2-an386 or nucleo-g474re");

#[cfg(all(
    target_os = "none",
    any(feature = "mps2-an386", feature = "nucleo-g474re")
))]
mod arm;
#[cfg(all(target_os = "none", feature = "mps2-an386"))]
pub mod mps2_an386;
#[cfg(all(target_os = "none", feature = "nucleo-g474re"))]
pub mod nucleo_g474re;
