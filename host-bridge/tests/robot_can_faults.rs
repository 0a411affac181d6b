//! What can go wrong on a real CAN interface of Linux, which `DEICTIC_CAN` names (`cargo xtask can` makes one): the
//! arm stops or finishes, the person is told, and nothing goes on by itself. Skipped, with a word, where no
//! interface is named.
#![cfg(target_os = "linux")]

#[path = "common/can.rs"]
mod can;
#[path = "common/trial.rs"]
mod trial;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use can::{Slcand, interface, run};
use deictic::link::bus::{Bus, BusFault, Socket};
use deictic::link::{Pair, Wire};
use deictic::robot::end::Listener;
use deictic::robot::way::Way;
use deictic::robot::{CommandId, Event};
use deictic_core::can::Frame;
use deictic_core::slcan::{Heard, Lines};
use trial::{Far, Near, lost};

/// An arm on this interface that has begun to move.
fn moving(interface: &str) -> (Far, Near, CommandId) {
    let far = Far::on(interface);
    let mut near = Near::to(&far.way);
    let id = near.begin("move-up");
    near.pass(Duration::from_millis(100));
    (far, near, id)
}

/// Holds that nothing goes on by itself, and that the next command is done.
fn stays_and_goes_again(far: &Far, mut near: Near) {
    near.pass(Duration::from_millis(1_500));
    assert!(!far.is_moving(), "it goes on by itself");
    near.moves_up();
}

#[test]
fn an_interface_that_goes_down_ends_the_command_and_comes_back() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let (far, mut near, id) = moving(&name);
    run("ip", &["link", "set", &name, "down"]);
    let happened = near.until_end(id);
    assert!(lost(&happened), "{happened:?}");
    thread::sleep(Duration::from_millis(500));
    assert!(!far.is_moving());
    run("ip", &["link", "set", &name, "up"]);
    stays_and_goes_again(&far, near);
}

/// Frames with which a controller reports what it meets: `CAN_ERR_BUSOFF`, `CAN_ERR_LOSTARB`.
const BUS_OFF: &str = "20000040#0000000000000000";
const ARBITRATION_LOST: &str = "20000002#0000000000000000";

#[test]
fn a_controller_off_the_bus_ends_the_command() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let (far, mut near, id) = moving(&name);
    run("cansend", &[&name, BUS_OFF]);
    let happened = near.until_end(id);
    assert!(lost(&happened), "{happened:?}");
    stays_and_goes_again(&far, near);
}

#[test]
fn lost_arbitration_disturbs_nothing() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let far = Far::on(&name);
    let mut near = Near::to(&far.way);
    let id = near.begin("move-up");
    for _ in 0..5 {
        run("cansend", &[&name, ARBITRATION_LOST]);
        near.pass(Duration::from_millis(5));
    }
    let happened = near.until_end(id);
    assert_eq!(happened.last(), Some(&Event::Done(id)), "{happened:?}");
}

#[test]
fn the_cable_may_be_pulled_at_every_step() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let way = Way::Can(name.clone());
    let mut steps = 1;
    for step in 1.. {
        if step > steps {
            break;
        }
        let far = Far::hasty(Listener::open(&way).unwrap(), 8.0);
        let mut near = Near::to(&way);
        let id = near.begin("put-into can drawer");
        let at = |e: &Event| matches!(e, Event::Begun { number, .. } if *number == step);
        let happened = near.until(at);
        let of = happened.iter().find_map(|event| match event {
            Event::Begun { of, .. } => Some(*of),
            _ => None,
        });
        steps = of.unwrap_or(steps);
        run("ip", &["link", "set", &name, "down"]);
        let happened = near.until_end(id);
        // The last step may have been done just before.
        let done = happened.last() == Some(&Event::Done(id));
        assert!(lost(&happened) || done, "step {step}: {happened:?}");
        thread::sleep(Duration::from_millis(450));
        assert!(!far.is_moving(), "step {step}");
        run("ip", &["link", "set", &name, "up"]);
        near.pass(Duration::from_millis(1_200));
        assert!(!far.is_moving(), "step {step}: it goes on by itself");
        near.moves_up();
    }
    assert!(steps >= 8, "{steps}");
}

/// The adapter's end of a serial line, whose reading a test can put off: slcan0 then queues one frame, and the kernel
/// refuses further ones (`ENOBUFS`).
struct Stuck {
    wire: Box<dyn Wire>,
    _slcand: Slcand,
    socket: Socket,
}

impl Stuck {
    fn new() -> Self {
        let pair = Pair::open().unwrap();
        let slcand = Slcand::on(pair.path());
        run("ip", &["link", "set", "slcan0", "txqueuelen", "1"]);
        Self {
            wire: pair.wire().unwrap(),
            _slcand: slcand,
            socket: Socket::open("slcan0").unwrap(),
        }
    }
}

fn numbered(number: u16) -> Frame {
    Frame::new(0x123, &number.to_le_bytes()).unwrap()
}

#[test]
fn a_queue_that_nobody_empties_is_told() {
    let Some((_, _one)) = interface() else { return };
    let mut stuck = Stuck::new();
    let mut sent = 0;
    let (error, took) = loop {
        let began = Instant::now();
        match stuck.socket.send(&numbered(sent)) {
            Ok(()) => sent += 1,
            Err(error) => break (error, began.elapsed()),
        }
        assert!(sent < 20_000, "the queue takes everything");
    };
    assert_eq!(BusFault::within(&error), Some(BusFault::Full), "{error}");
    assert!(
        took >= Duration::from_millis(250),
        "{took:?}: it was tried again"
    );
    println!("{sent} frames, then: {error}");
}

#[test]
fn a_queue_that_is_full_for_a_while_loses_nothing() {
    let Some((_, _one)) = interface() else { return };
    const FRAMES: u16 = 1_500;
    let Stuck {
        mut wire,
        _slcand,
        mut socket,
    } = Stuck::new();
    let sent = AtomicUsize::new(0);
    let mut arrived = Vec::new();
    thread::scope(|scope| {
        scope.spawn(|| {
            for number in 0..FRAMES {
                socket.send(&numbered(number)).unwrap();
                sent.fetch_add(1, Ordering::Relaxed);
            }
        });
        // Reads now and then only: the queue is full in between.
        let (mut lines, mut buffer) = (Lines::new(), [0; 512]);
        let until = Instant::now() + Duration::from_secs(60);
        while arrived.len() < usize::from(FRAMES) && Instant::now() < until {
            let read = wire.read(&mut buffer, Duration::from_millis(100)).unwrap();
            for &byte in &buffer[..read] {
                if let Some(Heard::Frame(frame)) = lines.hear(byte) {
                    arrived.push(frame);
                }
            }
            thread::sleep(Duration::from_millis(10));
        }
    });
    assert_eq!(sent.load(Ordering::Relaxed), usize::from(FRAMES));
    assert_eq!(arrived, (0..FRAMES).map(numbered).collect::<Vec<_>>());
}
