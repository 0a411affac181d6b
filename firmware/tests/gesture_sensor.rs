//! A gesture sensor on the board's bus, by the code that the board runs: from what the sensor reports to what the unit
//! decides.

mod common;

use std::cell::RefCell;
use std::rc::Rc;

use common::board::Table;
use common::sensor::{Peripheral, Sensor};
use deictic_core::board::{ToHost, ToUnit};
use deictic_core::decide::Outcome;
use deictic_core::gesture::mapping::Gesture;
use deictic_core::gesture::stroke_table::NAMES;
use deictic_core::protocol::hand::Meaning;
use deictic_core::protocol::message::{Configuration, Heartbeat, ScenePart, VocabularyPart};
use deictic_core::time::Micros;
use deictic_core::unit::HEARTBEAT;
use deictic_core::vocabulary::Action;
use deictic_firmware::recogniser::Recogniser;
use deictic_firmware::stm32_i2c::Controller;
use deictic_firmware::{Board, turn};

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
