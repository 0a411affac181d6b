use deictic_core::board::Unit;
use deictic_core::time::Micros;
use embedded_io::{Read, ReadReady, Write, WriteReady};

use crate::Board;

/// Bytes taken from a link at a time: large enough that a turn's fixed cost does not matter, small enough that a
/// noisy link cannot keep the loop from its timers and the watchdog (at 921600 baud 64 bytes are 0.7 ms).
const CHUNK: usize = 64;

/// What one turn of the loop moved; bytes, where it says no other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turn {
    /// Taken from the host link and given to the unit.
    pub received: usize,
    /// Taken from the unit and given to the host link.
    pub sent: usize,
    /// Taken from the sensor link.
    pub sensed: usize,
    /// Whether a sensor had recognised a gesture by itself.
    pub recognised: bool,
}

impl Turn {
    /// Nothing moved, so there is time to sleep.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        *self == Self::default()
    }
}

/// One turn: takes at most a chunk from each link and a gesture from a sensor that recognises them, lets the unit look at its timers, and gives the host link what it
/// takes without blocking. A link that reports an error moves nothing this turn and is asked again in the next.
pub fn turn<B: Board>(board: &mut B, unit: &mut Unit) -> Turn {
    let mut chunk = [0; CHUNK];
    let received = take(board.link(), &mut chunk);
    let now = board.now();
    unit.receive(now, received);
    let received = received.len();

    let sensed = take(board.sensor(), &mut chunk);
    let now = board.now();
    unit.sense(now, sensed);
    let sensed = sensed.len();

    let recognised = recognise(board, unit, now);

    unit.poll(now);
    let sent = give(board.link(), unit.outgoing());
    unit.sent(sent);

    board.feed();
    Turn {
        received,
        sent,
        sensed,
        recognised,
    }
}

/// Gives the unit what a sensor has recognised by itself, if it has. A function of its own: its stack is not that of
/// all else in a turn.
#[inline(never)]
fn recognise<B: Board>(board: &mut B, unit: &mut Unit, now: Micros) -> bool {
    let recognised = board.recognised(now);
    if let Some(likely) = &recognised {
        unit.recognise(likely);
    }
    recognised.is_some()
}

/// Turns for ever, sleeping whenever a turn moved nothing.
pub fn run<B: Board>(board: &mut B, unit: &mut Unit) -> ! {
    loop {
        let done = turn(board, unit);
        board.log(done, unit.statistics());
        if done.is_idle() {
            let until = unit.next_wake().min(board.next_look());
            board.sleep(until);
        }
    }
}

/// What has arrived, up to the length of `chunk`; empty when nothing has.
fn take<'a, L: Read + ReadReady>(link: &mut L, chunk: &'a mut [u8]) -> &'a [u8] {
    let length = match link.read_ready() {
        Ok(true) => link.read(chunk).unwrap_or(0),
        _ => 0,
    };
    chunk.get(..length).unwrap_or(&[])
}

/// How many of `bytes` the link took without blocking.
fn give<L: Write + WriteReady>(link: &mut L, bytes: &[u8]) -> usize {
    if bytes.is_empty() {
        return 0;
    }
    match link.write_ready() {
        Ok(true) => link.write(bytes).unwrap_or(0),
        _ => 0,
    }
}
