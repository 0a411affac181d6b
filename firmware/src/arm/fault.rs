//! HardFault: what happened goes to the log, then the board decides how to stop.

use core::mem::MaybeUninit;

use cortex_m::peripheral::SCB;
use cortex_m_rt::ExceptionFrame;

use super::board;

/// A fault as the core describes it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Fault {
    /// Where the faulting instruction lies.
    pub pc: u32,
    /// Where its function would have returned to.
    pub lr: u32,
    /// Configurable Fault Status Register (ARMv7-M, B3.2.15).
    pub status: u32,
}

/// Marks a record that a fault wrote, against what RAM holds after power-up.
const WRITTEN: u32 = 0x6661_756c;

/// Survives a reset: start-up code leaves this section as it is.
#[unsafe(link_section = ".uninit.FAULT")]
static mut RECORD: MaybeUninit<(u32, Fault)> = MaybeUninit::uninit();

/// The fault that ended the run before this one, if one did. Forgets it.
pub(crate) fn take_previous() -> Option<Fault> {
    let record = core::ptr::addr_of_mut!(RECORD).cast::<u32>();
    // SAFETY: four plain words, of which every bit pattern is valid; only HardFault writes them, and it never returns.
    unsafe {
        let found = record.read_volatile() == WRITTEN;
        record.write_volatile(0);
        found.then(|| Fault {
            pc: record.add(1).read_volatile(),
            lr: record.add(2).read_volatile(),
            status: record.add(3).read_volatile(),
        })
    }
}

fn remember(fault: &Fault) {
    let record = core::ptr::addr_of_mut!(RECORD).cast::<u32>();
    // SAFETY: as in `take_previous`.
    unsafe {
        record.add(1).write_volatile(fault.pc);
        record.add(2).write_volatile(fault.lr);
        record.add(3).write_volatile(fault.status);
        record.write_volatile(WRITTEN);
    }
}

/// Entry: hands the frame that the core pushed to [`handle`], which returns as an exception does.
#[unsafe(naked)]
#[unsafe(export_name = "HardFault")]
#[unsafe(link_section = ".HardFault.user")]
unsafe extern "C" fn hard_fault() {
    core::arch::naked_asm!("mrs r0, msp", "b {handle}", handle = sym handle)
}

/// # Safety
/// `frame` is what the core pushed on entry.
unsafe extern "C" fn handle(frame: &mut ExceptionFrame) {
    // SAFETY: the frame is the handler's own until it returns.
    if unsafe { board::resume(frame) } {
        return;
    }
    // SAFETY: the register may be read at any time.
    let status = unsafe { (*SCB::PTR).cfsr.read() };
    let fault = Fault {
        pc: frame.pc(),
        lr: frame.lr(),
        status,
    };
    remember(&fault);
    defmt::error!(
        "fault at {=u32:#010x}, called from {=u32:#010x}, status {=u32:#010x}",
        fault.pc,
        fault.lr,
        fault.status
    );
    board::stop()
}
