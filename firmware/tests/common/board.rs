//! A board whose links are queues, with a unit and the host's end of its link.

use std::collections::VecDeque;

use deictic_core::board::{Link, ToHost, ToUnit, Unit};
use deictic_core::gesture::mapping::STROKES;
use deictic_core::gesture::stroke::Likely;
use deictic_core::protocol::message::Hello;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;
use deictic_core::unit::Statistics;
use deictic_firmware::recogniser::Recogniser;
use deictic_firmware::stm32_i2c::Controller;
use deictic_firmware::{Board, Turn, turn};
use embedded_io::{ErrorKind, ErrorType, Read, ReadReady, Write, WriteReady};

use super::sensor::Peripheral;

/// A link whose ends are queues.
#[derive(Default)]
pub struct Wire {
    pub incoming: VecDeque<u8>,
    pub outgoing: Vec<u8>,
    /// Bytes it takes per turn.
    pub room: usize,
    pub broken: bool,
}

impl ErrorType for Wire {
    type Error = ErrorKind;
}

impl Read for Wire {
    fn read(&mut self, into: &mut [u8]) -> Result<usize, ErrorKind> {
        assert!(
            !self.incoming.is_empty(),
            "a read that would block for ever"
        );
        Ok(into
            .iter_mut()
            .map_while(|slot| self.incoming.pop_front().map(|byte| *slot = byte))
            .count())
    }
}

impl ReadReady for Wire {
    fn read_ready(&mut self) -> Result<bool, ErrorKind> {
        if self.broken {
            return Err(ErrorKind::BrokenPipe);
        }
        Ok(!self.incoming.is_empty())
    }
}

impl Write for Wire {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, ErrorKind> {
        assert!(self.room > 0, "a write that would block for ever");
        let taken = bytes.len().min(self.room);
        self.outgoing.extend(&bytes[..taken]);
        Ok(taken)
    }

    fn flush(&mut self) -> Result<(), ErrorKind> {
        Ok(())
    }
}

impl WriteReady for Wire {
    fn write_ready(&mut self) -> Result<bool, ErrorKind> {
        if self.broken {
            return Err(ErrorKind::BrokenPipe);
        }
        Ok(self.room > 0)
    }
}

#[derive(Default)]
pub struct InMemory {
    pub link: Wire,
    pub sensor: Wire,
    pub now: Micros,
    pub fed: usize,
    /// A gesture sensor's place on the board's bus, as on the real board.
    pub recogniser: Option<Recogniser<Controller<Peripheral>>>,
}

impl Board for InMemory {
    type Link = Wire;
    type Sensor = Wire;

    fn link(&mut self) -> &mut Wire {
        &mut self.link
    }

    fn sensor(&mut self) -> &mut Wire {
        &mut self.sensor
    }

    fn recognised(&mut self, now: Micros) -> Option<Likely<STROKES>> {
        self.recogniser.as_mut()?.look(now)
    }

    fn next_look(&self) -> Micros {
        self.recogniser
            .as_ref()
            .map_or(Micros::NEVER, Recogniser::due)
    }

    fn now(&mut self) -> Micros {
        self.now
    }

    fn feed(&mut self) {
        self.fed += 1;
    }

    fn sleep(&mut self, until: Micros) {
        self.now = until;
    }

    fn log(&mut self, _turn: Turn, _statistics: Statistics) {}
}

/// A board with a unit and the host's end of its link.
pub struct Table {
    pub board: InMemory,
    pub unit: Box<Unit>,
    pub host: Link,
}

impl Table {
    pub fn new(room: usize) -> Self {
        let mut board = InMemory::default();
        board.link.room = room;
        Self {
            board,
            unit: Box::new(Unit::new(7)),
            host: Link::new(),
        }
    }

    pub fn say(&mut self, message: &ToUnit) {
        let mut frame = Outbox::<2048>::new();
        assert!(self.host.send(message, &mut frame));
        self.board.link.incoming.extend(frame.waiting());
    }

    pub fn say_hello(&mut self) {
        self.say(&ToUnit::Hello(Hello {
            version: VERSION,
            schema: SCHEMA,
            boot: 1,
            capacities: Unit::capacities(),
        }));
    }

    /// Turns until a turn moves nothing, and gives the number of turns.
    pub fn settle(&mut self) -> usize {
        (0..100_000)
            .find(|_| turn(&mut self.board, &mut self.unit).is_idle())
            .expect("the loop comes to rest")
    }

    pub fn heard(&mut self) -> Vec<ToHost> {
        let bytes = std::mem::take(&mut self.board.link.outgoing);
        let host = &mut self.host;
        bytes
            .into_iter()
            .filter_map(|byte| host.receive(byte).map(|received| received.message))
            .collect()
    }

    pub fn hears_hello(&mut self) -> bool {
        self.heard()
            .iter()
            .any(|message| matches!(message, ToHost::Hello(hello) if hello.boot == 7))
    }
}
