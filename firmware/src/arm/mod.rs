//! What every Cortex-M4F board shares.

#[cfg(feature = "mps2-an386")]
use crate::mps2_an386 as board;
#[cfg(feature = "nucleo-g474re")]
use crate::nucleo_g474re as board;

pub(crate) mod clock;
pub(crate) mod fault;
pub(crate) mod guard;
pub(crate) mod journal;
pub(crate) mod log;
mod panic;
pub(crate) mod port;
