//! What the image asks of QEMU: to take its log, to tell the time, to end.

use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use cortex_m_rt::ExceptionFrame;
use cortex_m_semihosting::{debug, nr, syscall};

/// `bkpt 0xab`, the semihosting call of ARMv7-M.
const CALL: u16 = 0xbeab;

/// QEMU was started without `-semihosting-config enable=on`. Found out by the first call, see [`refused`].
static ABSENT: AtomicBool = AtomicBool::new(false);

/// Handle of QEMU's console; 0 before it was opened.
static CONSOLE: AtomicUsize = AtomicUsize::new(0);

/// Semihosting's "no".
const FAILED: usize = usize::MAX;

/// A semihosting call that nobody answers is a breakpoint without a debugger, so a fault. Notes that there is no
/// semihosting, makes the call return "failed" and says that execution can go on.
///
/// # Safety
/// `frame` is the frame that the core pushed when it entered the fault handler.
pub(super) unsafe fn refused(frame: &mut ExceptionFrame) -> bool {
    let pc = frame.pc();
    // SAFETY: the core has just fetched the instruction there, unless the fault was the fetch itself, which leaves an
    // address outside of the code.
    if pc >= CODE_END || unsafe { (pc as *const u16).read_volatile() } != CALL {
        return false;
    }
    ABSENT.store(true, Ordering::Relaxed);
    // SAFETY: skips the two bytes of the call and sets its result.
    unsafe {
        frame.set_r0(FAILED as u32);
        frame.set_pc(pc.wrapping_add(2));
    }
    true
}

/// Addresses below this one hold code memory on this board.
const CODE_END: u32 = 512 * 1024;

/// Writes to QEMU's console. What it does not take is lost.
pub(super) fn write(bytes: &[u8]) {
    if let Some(console) = console() {
        // SAFETY: pointer and length describe `bytes`.
        let _left = unsafe { syscall!(WRITE, console, bytes.as_ptr(), bytes.len()) };
    }
}

fn console() -> Option<usize> {
    let opened = CONSOLE.load(Ordering::Relaxed);
    if opened != 0 {
        return (opened != FAILED).then_some(opened);
    }
    let name = c":tt";
    // SAFETY: pointer and length describe `name` without its end.
    let handle = unsafe { syscall!(OPEN, name.as_ptr(), nr::open::W_TRUNC, name.count_bytes()) };
    CONSOLE.store(handle, Ordering::Relaxed);
    (handle != FAILED).then_some(handle)
}

/// Seconds since 1970 by the host's clock; none without semihosting.
pub(super) fn seconds() -> Option<u32> {
    // SAFETY: the call takes no argument.
    let seconds = unsafe { cortex_m_semihosting::syscall1(nr::TIME, 0) };
    (!ABSENT.load(Ordering::Relaxed)).then_some(seconds as u32)
}

/// Ends QEMU with exit code 1; returns only without semihosting.
pub(super) fn exit_failure() {
    debug::exit(debug::EXIT_FAILURE);
}
