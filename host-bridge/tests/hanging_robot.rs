//! A robot that takes a command and then neither moves nor says anything is stopped, the person is told,
//! and the session goes on; what is queued can be taken back.

mod common;

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use common::*;
use deictic::clock::Simulated;
use deictic::robot::{Command, CommandId, Event, Refusal, Robot, Taken, World};
use deictic::session::Happening;
use deictic::session::journal::{Became, Journal};
use deictic_core::time::Micros;

/// A robot that hangs; it counts what it is told.
#[derive(Clone, Default)]
struct Hangs {
    begun: Arc<AtomicU32>,
    stopped: Arc<AtomicU32>,
}

impl Robot for Hangs {
    fn begin(&mut self, _: Micros, _: &Command, _: World<'_>) -> Result<Taken, Refusal> {
        self.begun.fetch_add(1, Ordering::Relaxed);
        Ok(Taken::Begun)
    }

    fn stop(&mut self, _: Micros) {
        self.stopped.fetch_add(1, Ordering::Relaxed);
    }

    fn poll(&mut self, _: Micros) -> Vec<Event> {
        Vec::new()
    }

    fn progress(&self, _: Micros) -> Option<(CommandId, u8)> {
        None
    }

    fn holding(&self) -> Option<&str> {
        None
    }
}

#[test]
fn a_robot_that_hangs_is_stopped_and_nothing_is_given_twice() {
    let clock = Simulated::start();
    let (cable, lexicon) = (Cable::new(), lexicon());
    let robot = Hangs::default();
    let table = table(&lexicon);
    let mut session = open_with(&cable, &lexicon, Box::new(robot.clone()), table);
    session.observe(surely_said("pick can", &lexicon)).unwrap();
    session.queue([surely_said("release", &lexicon)]);
    let mut journal = Journal::default();
    let (mut happened, mut records) = (Vec::new(), Vec::new());
    for _ in 0..800 {
        for happening in session.turn(Duration::from_millis(1)) {
            records.extend(journal.hear(&happening, &lexicon));
            happened.push(happening);
        }
        clock.advance(Duration::from_millis(100));
    }
    let hanging = happened
        .iter()
        .filter(|h| matches!(h, Happening::Hanging(_)));
    assert_eq!(hanging.count(), 1, "{happened:#?}");
    assert!(happened.iter().any(|h| matches!(h, Happening::Dropped(1))));
    assert_eq!(robot.begun.load(Ordering::Relaxed), 1);
    assert!(robot.stopped.load(Ordering::Relaxed) >= 1);
    assert!(session.is_idle());
    assert_eq!(records.len(), 1);
    assert_eq!(records[0].became, Became::Failed);
}

#[test]
fn what_is_queued_can_be_taken_back_while_the_robot_goes_on() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 50.0);
    session.observe(surely_said("pick can", &lexicon)).unwrap();
    session.queue([surely_said("release", &lexicon)]);
    until(&mut session, |h| matches!(h, Happening::Accepted(_)));
    session.cancel();
    let happened = settle(&mut session);
    assert!(happened.iter().any(|h| matches!(h, Happening::Dropped(1))));
    assert!(happened.iter().any(is_done));
    assert_eq!(session.holding(), Some("can"));
}
