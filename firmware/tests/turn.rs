//! The board-independent loop with a unit and links in memory: what a slow, stuck or broken link must not change.

mod common;

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use common::{Peripheral, Sensor};
use deictic_core::board::{Link, ToHost, ToUnit, Unit};
use deictic_core::decide::Outcome;
use deictic_core::gesture::line::{FRAMED, send};
use deictic_core::gesture::mapping::Gesture;
use deictic_core::gesture::mapping::STROKES;
use deictic_core::gesture::stroke::Likely;
use deictic_core::gesture::stroke_table::NAMES;
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::hand::Meaning;
use deictic_core::protocol::message::{Configuration, Heartbeat, Hello, ScenePart, VocabularyPart};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;
use deictic_core::unit::{HEARTBEAT, Statistics};
use deictic_core::vocabulary::Action;
use deictic_firmware::recogniser::Recogniser;
use deictic_firmware::stm32_i2c::Controller;
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
    /// A gesture sensor's place on the board's bus, as on the real board.
    recogniser: Option<Recogniser<Controller<Peripheral>>>,
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

/// A table with a gesture sensor, at which waving stops, and swiping right and pushing are actions 1 and 2.
struct Swiping {
    table: Table,
    sensor: Rc<RefCell<Sensor>>,
    beat: Micros,
}

const RIGHT: u16 = 1 << 3;
const LEFT: u16 = 1 << 2;
const FORWARD: u16 = 1 << 4;
const WAVE: u16 = 1 << 8;

impl Swiping {
    fn new() -> Self {
        let mut table = Table::new(4096);
        let peripheral = Peripheral::default();
        let sensor = Rc::clone(&peripheral.sensor);
        table.board.recogniser = Some(Recogniser::new(Controller(peripheral)));
        table.say_hello();
        table.say(&ToUnit::Vocabulary(VocabularyPart {
            fingerprint: 9,
            parameters: [1, 1].into_iter().collect(),
            features: 0,
            stop: Some(0),
            total: 3,
            first: 0,
            actions: [Action::default(); 3].into_iter().collect(),
        }));
        table.say(&ToUnit::Scene(ScenePart {
            version: 1,
            total: 0,
            first: 0,
            entities: heapless::Vec::new(),
        }));
        table.say(&ToUnit::Configure(Configuration {
            expected: 0b1,
            ..Configuration::DEFAULT
        }));
        let stroke = |name: &str| NAMES.iter().position(|n| *n == name).unwrap() as u8;
        let names = ["wave", "swipe-right", "swipe-forward"];
        let meanings = names.iter().zip(0..).map(|(name, action)| Meaning {
            gesture: Gesture::Stroke(stroke(name)),
            action,
        });
        table.say(&ToUnit::Meanings(meanings.collect()));
        Self {
            table,
            sensor,
            beat: Micros(0),
        }
    }

    /// Runs the loop for so many milliseconds, and gives the actions that were decided on.
    fn pass(&mut self, milliseconds: u64) -> Vec<u8> {
        let end = self
            .table
            .board
            .now
            .after(Micros::from_millis(milliseconds));
        while self.table.board.now < end {
            let now = self.table.board.now;
            if now >= self.beat {
                self.beat = now.after(HEARTBEAT);
                self.table.say(&ToUnit::Heartbeat(Heartbeat {
                    now,
                    vocabulary: 0,
                    scene: 0,
                }));
            }
            if turn(&mut self.table.board, &mut self.table.unit).is_idle() {
                let (board, unit) = (&mut self.table.board, &self.table.unit);
                let until = unit.next_wake().min(board.next_look());
                board.sleep(until.min(self.beat).min(end).max(now));
            }
        }
        let heard = self.table.heard().into_iter();
        heard
            .filter_map(|message| match message {
                ToHost::Decision(decided) => match decided.decision.outcome {
                    Outcome::Execute(intent) => Some(intent.action),
                    other => panic!("{other:?}"),
                },
                ToHost::Fault(fault) => panic!("{fault:?}"),
                _ => None,
            })
            .collect()
    }

    fn see(&mut self, gestures: u16) {
        self.sensor.borrow_mut().see(gestures);
    }

    fn is_there(&self) -> bool {
        let recogniser = self.table.board.recogniser.as_ref();
        recogniser.is_some_and(Recogniser::is_there)
    }
}

#[test]
fn a_swipe_over_the_boards_gesture_sensor_becomes_a_decision() {
    let mut swiping = Swiping::new();
    assert_eq!(swiping.pass(1_000), []);
    assert!(swiping.is_there());
    // Both banks were written, each where it belongs.
    let registers = swiping.sensor.borrow().registers.clone();
    assert_eq!((registers[&(0, 0x41)], registers[&(1, 0x72)]), (0xff, 0x01));
    swiping.see(RIGHT);
    assert_eq!(swiping.pass(780), []);
    assert_eq!(swiping.pass(50), [1]);
    assert_eq!(swiping.pass(3_000), []);
}

#[test]
fn a_push_is_not_the_swipe_that_it_begins_with_nor_the_one_that_it_ends_with() {
    let mut swiping = Swiping::new();
    swiping.pass(1_000);
    swiping.see(RIGHT);
    assert_eq!(swiping.pass(400), []);
    swiping.see(FORWARD);
    assert_eq!(swiping.pass(20), [2]);
    swiping.see(RIGHT);
    assert_eq!(swiping.pass(2_000), []);
    swiping.see(RIGHT);
    assert_eq!(swiping.pass(1_000), [1]);
}

#[test]
fn a_hand_that_goes_to_and_fro_waves() {
    let mut swiping = Swiping::new();
    swiping.pass(1_000);
    for swipe in [RIGHT, LEFT, RIGHT, LEFT] {
        swiping.see(swipe);
        assert_eq!(swiping.pass(500), []);
    }
    swiping.see(LEFT | WAVE);
    // It means stop.
    assert_eq!(swiping.pass(20), [0]);
    assert_eq!(swiping.pass(2_000), []);
}

#[test]
fn a_gesture_sensor_may_come_late_and_go_and_come_back() {
    let mut swiping = Swiping::new();
    swiping.sensor.borrow_mut().power(false);
    swiping.pass(2_000);
    assert!(!swiping.is_there());
    for _ in 0..2 {
        swiping.sensor.borrow_mut().power(true);
        swiping.pass(1_000);
        assert!(swiping.is_there());
        swiping.see(RIGHT);
        assert_eq!(swiping.pass(1_000), [1]);
        // What it was about to say is not said by a sensor that is gone.
        swiping.see(RIGHT);
        swiping.pass(100);
        swiping.sensor.borrow_mut().power(false);
        assert_eq!(swiping.pass(1_000), []);
        assert!(!swiping.is_there());
    }
    swiping.sensor.borrow_mut().power(true);
    swiping.sensor.borrow_mut().part = [0x34, 0x12];
    swiping.pass(1_000);
    let recogniser = swiping.table.board.recogniser.as_ref();
    assert_eq!(recogniser.and_then(Recogniser::other), Some(0x1234));
}

#[test]
fn a_gesture_sensor_is_looked_at_a_hundred_times_a_second() {
    let mut swiping = Swiping::new();
    swiping.pass(1_000);
    swiping.sensor.borrow_mut().looked = 0;
    swiping.pass(1_000);
    let looked = swiping.sensor.borrow().looked;
    assert!((95..=101).contains(&looked), "{looked}");
}
