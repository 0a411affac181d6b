//! defmt's logger: whole frames into a ring in RAM, in the layout that debug probes know as RTT.
//!
//! The published loggers panic when they are entered twice, which an image without panics cannot hold; this one drops
//! the inner frame. A frame that finds no room is dropped whole and never waits, so logging cannot slow a link down.

use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicU32, Ordering};

use critical_section::RestoreState;

/// Bytes of the ring; about 100 log lines.
const SIZE: usize = 1024;

/// RTT's description of an up-channel (target to host). Probes read it by address, so its layout is fixed.
#[repr(C)]
struct Channel {
    name: *const u8,
    buffer: *const u8,
    size: u32,
    written: AtomicU32,
    read: AtomicU32,
    mode: u32,
}

/// RTT's control block. Probes find it by its symbol or by its id.
#[repr(C)]
struct Block {
    id: [u8; 16],
    up_channels: u32,
    down_channels: u32,
    up: Channel,
}

// SAFETY: the pointers are to statics, the counters are atomic and nothing else changes.
unsafe impl Sync for Block {}

/// Probes write to `read` only; a mutable section keeps the block in RAM, where they look for it.
#[unsafe(no_mangle)]
#[unsafe(link_section = ".data._SEGGER_RTT")]
static _SEGGER_RTT: Block = Block {
    id: *b"SEGGER RTT\0\0\0\0\0\0",
    up_channels: 1,
    down_channels: 0,
    up: Channel {
        name: c"defmt".as_ptr().cast(),
        buffer: RING.0.get().cast(),
        size: SIZE as u32,
        written: AtomicU32::new(0),
        read: AtomicU32::new(0),
        mode: 0,
    },
};

struct Ring(UnsafeCell<[u8; SIZE]>);

// SAFETY: written only by the logger that holds `LOGGER`, inside a critical section, at places that the reader has
// given back through `read`.
unsafe impl Sync for Ring {}

static RING: Ring = Ring(UnsafeCell::new([0; SIZE]));

struct State {
    encoder: defmt::Encoder,
    /// How many frames are open; only the outermost is written.
    depth: u32,
    /// Where the next byte of the open frame goes; published as `written` once the frame is whole.
    cursor: usize,
    /// The open frame found no room.
    overrun: bool,
    restore: RestoreState,
}

struct Logger(UnsafeCell<State>);

// SAFETY: used only between acquire and release of a critical section. HardFault and NMI can interrupt one; `depth`
// keeps them from the open frame.
unsafe impl Sync for Logger {}

static LOGGER: Logger = Logger(UnsafeCell::new(State {
    encoder: defmt::Encoder::new(),
    depth: 0,
    cursor: 0,
    overrun: false,
    restore: RestoreState::invalid(),
}));

#[defmt::global_logger]
struct Global;

// SAFETY: acquire enters a critical section that release leaves, and write and flush come between them.
unsafe impl defmt::Logger for Global {
    fn acquire() {
        // SAFETY: left in `release`; defmt pairs the calls.
        let restore = unsafe { critical_section::acquire() };
        // SAFETY: inside the critical section, see `Sync for Logger`.
        let state = unsafe { &mut *LOGGER.0.get() };
        state.depth = state.depth.wrapping_add(1);
        if state.depth == 1 {
            state.restore = restore;
            state.cursor = _SEGGER_RTT.up.written.load(Ordering::Relaxed) as usize;
            state.overrun = false;
            let State {
                encoder,
                cursor,
                overrun,
                ..
            } = state;
            encoder.start_frame(|bytes| stage(bytes, cursor, overrun));
        }
    }

    unsafe fn write(bytes: &[u8]) {
        // SAFETY: as in `acquire`.
        let state = unsafe { &mut *LOGGER.0.get() };
        if state.depth == 1 {
            let State {
                encoder,
                cursor,
                overrun,
                ..
            } = state;
            encoder.write(bytes, |bytes| stage(bytes, cursor, overrun));
        }
    }

    unsafe fn flush() {}

    unsafe fn release() {
        // SAFETY: as in `acquire`.
        let state = unsafe { &mut *LOGGER.0.get() };
        if state.depth == 1 {
            let State {
                encoder,
                cursor,
                overrun,
                ..
            } = &mut *state;
            encoder.end_frame(|bytes| stage(bytes, cursor, overrun));
            if !state.overrun {
                let written = state.cursor as u32;
                _SEGGER_RTT.up.written.store(written, Ordering::Release);
            }
        }
        state.depth = state.depth.wrapping_sub(1);
        if state.depth == 0 {
            // SAFETY: pairs with the outermost `acquire`. Inner ones ran with interrupts off and change nothing.
            unsafe { critical_section::release(state.restore) };
        }
    }
}

/// Copies bytes of the open frame to the ring at `cursor`, leaving one byte free so that full and empty differ.
fn stage(bytes: &[u8], cursor: &mut usize, overrun: &mut bool) {
    let read = _SEGGER_RTT.up.read.load(Ordering::Acquire) as usize;
    for byte in bytes {
        let next = wrapped(cursor.wrapping_add(1));
        if *overrun || next == read {
            *overrun = true;
            return;
        }
        // SAFETY: `cursor` stays below SIZE; the place is free, see `Sync for Ring`.
        unsafe { RING.0.get().cast::<u8>().add(*cursor).write(*byte) };
        *cursor = next;
    }
}

const fn wrapped(position: usize) -> usize {
    position % SIZE
}

/// Takes what was logged out of the ring, as a debug probe would, in at most two pieces.
#[cfg_attr(
    not(feature = "mps2-an386"),
    expect(dead_code, reason = "a real board has a probe for this")
)]
pub(crate) fn drain(mut give: impl FnMut(&[u8])) {
    let written = wrapped(_SEGGER_RTT.up.written.load(Ordering::Acquire) as usize);
    let mut read = wrapped(_SEGGER_RTT.up.read.load(Ordering::Relaxed) as usize);
    while read != written {
        let end = if read < written { written } else { SIZE };
        // SAFETY: `read..end` lies inside the ring and the logger does not touch it before `read` moves past it.
        give(unsafe {
            core::slice::from_raw_parts(RING.0.get().cast::<u8>().add(read), end.wrapping_sub(read))
        });
        read = wrapped(end);
        _SEGGER_RTT.up.read.store(read as u32, Ordering::Release);
    }
}
