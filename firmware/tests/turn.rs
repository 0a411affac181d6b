//! The board-independent loop with a unit and links in memory: what a slow, stuck or broken link must not change.

use std::collections::VecDeque;

use deictic_core::board::{Link, ToHost, ToUnit, Unit};
use deictic_core::gesture::line::{FRAMED, send};
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::message::Hello;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;
use deictic_core::unit::{HEARTBEAT, Statistics};
use deictic_firmware::{Board, Turn, turn};
use embedded_io::{ErrorKind, ErrorType, Read, ReadReady, Write, WriteReady};

/// A link whose ends are queues.
#[derive(Default)]
struct Wire {
    incoming: VecDeque<u8>,
    outgoing: Vec<u8>,
    /// Bytes it takes per turn.
    room: usize,
    broken: bool,
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
struct InMemory {
    link: Wire,
    sensor: Wire,
    now: Micros,
    fed: usize,
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
struct Table {
    board: InMemory,
    unit: Box<Unit>,
    host: Link,
}

impl Table {
    fn new(room: usize) -> Self {
        let mut board = InMemory::default();
        board.link.room = room;
        Self {
            board,
            unit: Box::new(Unit::new(7)),
            host: Link::new(),
        }
    }

    fn say(&mut self, message: &ToUnit) {
        let mut frame = Outbox::<2048>::new();
        assert!(self.host.send(message, &mut frame));
        self.board.link.incoming.extend(frame.waiting());
    }

    fn say_hello(&mut self) {
        self.say(&ToUnit::Hello(Hello {
            version: VERSION,
            schema: SCHEMA,
            boot: 1,
            capacities: Unit::capacities(),
        }));
    }

    /// Turns until a turn moves nothing, and gives the number of turns.
    fn settle(&mut self) -> usize {
        (0..100_000)
            .find(|_| turn(&mut self.board, &mut self.unit).is_idle())
            .expect("the loop comes to rest")
    }

    fn heard(&mut self) -> Vec<ToHost> {
        let bytes = std::mem::take(&mut self.board.link.outgoing);
        let host = &mut self.host;
        bytes
            .into_iter()
            .filter_map(|byte| host.receive(byte).map(|received| received.message))
            .collect()
    }

    fn hears_hello(&mut self) -> bool {
        self.heard()
            .iter()
            .any(|message| matches!(message, ToHost::Hello(hello) if hello.boot == 7))
    }
}

#[test]
fn a_host_is_answered_over_a_link_of_any_width() {
    for room in [1, 7, 64, 4096] {
        let mut table = Table::new(room);
        table.say_hello();
        let turns = table.settle();
        assert!(table.hears_hello(), "{room} bytes per turn");
        assert_eq!(table.board.fed, turns + 1, "the watchdog is fed every turn");
    }
}

#[test]
fn a_stuck_link_loses_nothing_and_does_not_hold_the_loop() {
    let mut table = Table::new(0);
    table.say_hello();
    table.settle();
    assert!(table.board.link.outgoing.is_empty());
    table.board.link.room = 16;
    table.settle();
    assert!(table.hears_hello());
}

#[test]
fn a_broken_link_moves_nothing_until_it_is_whole_again() {
    let mut table = Table::new(64);
    table.say_hello();
    table.board.link.broken = true;
    assert_eq!(turn(&mut table.board, &mut table.unit), Turn::default());
    table.board.link.broken = false;
    table.settle();
    assert!(table.hears_hello());
}

#[test]
fn a_noisy_link_does_not_keep_the_unit_from_its_timers() {
    let mut table = Table::new(4096);
    table.say_hello();
    table.settle();
    table.heard();
    table.board.link.incoming.extend([0x55].repeat(100_000));
    table.board.now = table.board.now.after(HEARTBEAT);
    turn(&mut table.board, &mut table.unit);
    assert!(!table.board.link.incoming.is_empty());
    let heartbeat = |message: &ToHost| matches!(message, ToHost::Heartbeat(_));
    assert!(table.heard().iter().any(heartbeat));
}

#[test]
fn the_sensors_bytes_reach_the_unit() {
    let mut table = Table::new(4096);
    table.say_hello();
    table.settle();
    let mut bytes = vec![0xaa; 100];
    bytes.push(0);
    let mut frame = Outbox::<FRAMED>::new();
    send(&Sample::Nothing(5), &mut frame).expect("a sample fits");
    bytes.extend(frame.waiting());
    table.board.sensor.incoming.extend(&bytes);
    let mut sensed = 0;
    while !table.board.sensor.incoming.is_empty() {
        sensed += turn(&mut table.board, &mut table.unit).sensed;
    }
    assert_eq!(sensed, bytes.len());
    table.say(&ToUnit::AskHand);
    table.settle();
    let statistics = table.heard().into_iter().find_map(|message| match message {
        ToHost::HandStatistics(statistics) => Some(statistics.samples),
        _ => None,
    });
    // Noise, and a sample before there is a vocabulary.
    let counted = statistics.map(|samples| (samples.damaged, samples.unready));
    assert_eq!(counted, Some((1, 1)));
}
