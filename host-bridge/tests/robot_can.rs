//! The simulated robot on a real CAN interface of Linux, which `DEICTIC_CAN` names (`cargo xtask can`
//! makes one), with `candump`, `cansend` and `ip` from outside the project as witnesses. Skipped, with
//! a word, where no interface is named.
#![cfg(target_os = "linux")]

use std::io::{BufRead, BufReader};
use std::process::{Child, Command as Process, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use deictic::robot::end::{End, Listener, Served};
use deictic::robot::remote::Remote;
use deictic::robot::sim::Sim;
use deictic::robot::way::{self, Way};
use deictic::robot::{Command, CommandId, Event, Fault, Robot, World};
use deictic::scene::{SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::can::Frame;
use deictic_core::category::Category;
use deictic_core::command::field::{Id, Number};
use deictic_core::command::message::{FromRobot, Halt, ToRobot};
use deictic_core::command::parcel::{Assembler, Sender, frames};
use deictic_core::large::Intent;
use deictic_core::time::Micros;

/// The interface, for one test at a time: they switch it off and spoil it.
fn interface() -> Option<(String, MutexGuard<'static, ()>)> {
    static ONE: Mutex<()> = Mutex::new(());
    let Ok(named) = std::env::var("DEICTIC_CAN") else {
        eprintln!("skipped: DEICTIC_CAN names no CAN interface; `cargo xtask can` makes one");
        return None;
    };
    Some((named, ONE.lock().unwrap_or_else(PoisonError::into_inner)))
}

fn run(program: &str, arguments: &[&str]) {
    let status = Process::new(program).args(arguments).status().unwrap();
    assert!(status.success(), "{program} {arguments:?}");
}

/// A robot that is served in this process.
struct Far {
    over: Arc<AtomicBool>,
    moving: Arc<AtomicBool>,
    thread: Option<thread::JoinHandle<()>>,
    way: Way,
}

impl Far {
    fn at(listener: Listener) -> Self {
        let (over, moving) = (Arc::<AtomicBool>::default(), Arc::<AtomicBool>::default());
        let (ends, moves) = (Arc::clone(&over), Arc::clone(&moving));
        let way = listener.address().parse().unwrap();
        let thread = thread::spawn(move || {
            let end = End::new(Box::new(Sim::new(1.0)), Lexicon::tabletop().unwrap(), 1);
            let mut served = Served::new(end, listener);
            while !ends.load(Ordering::Relaxed) {
                served.turn(Duration::from_millis(10));
                moves.store(served.end().is_moving(), Ordering::Relaxed);
            }
        });
        let thread = Some(thread);
        Self {
            over,
            moving,
            thread,
            way,
        }
    }

    fn on(interface: &str) -> Self {
        Self::at(Listener::open(&Way::Can(interface.to_owned())).unwrap())
    }
}

impl Drop for Far {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(thread::JoinHandle::join);
    }
}

/// A bridge's side with a table.
struct Near {
    robot: Remote,
    lexicon: Lexicon,
    table: Tabletop,
    began: Instant,
    number: u32,
}

impl Near {
    fn to(way: &Way) -> Self {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        Self {
            robot: way::reach(way, &lexicon).unwrap(),
            lexicon,
            table,
            began: Instant::now(),
            number: 0,
        }
    }

    fn now(&self) -> Micros {
        Micros(u64::try_from(self.began.elapsed().as_micros()).unwrap())
    }

    fn begin(&mut self, action: &str) -> CommandId {
        self.number += 1;
        let id = CommandId {
            run: 1,
            number: self.number,
        };
        let intent = Intent {
            action: self.lexicon.option(Category::ACTION, action).unwrap(),
            ..Intent::default()
        };
        let scene = self.table.version();
        let (table, lexicon) = (&self.table, &self.lexicon);
        let now = self.now();
        let command = Command { id, intent, scene };
        self.robot
            .begin(now, &command, World { table, lexicon })
            .unwrap();
        id
    }

    /// What happens until the command has ended, at most ten seconds.
    fn until_end(&mut self, id: CommandId) -> Vec<Event> {
        let until = Instant::now() + Duration::from_secs(10);
        let mut happened = Vec::new();
        while Instant::now() < until {
            happened.extend(self.robot.poll(self.now()));
            let ends = happened.iter().filter(|event| {
                matches!(event, Event::Done(of) | Event::Stopped { id: of, .. } | Event::Failed { id: of, .. }
                    | Event::Refused { id: of, .. } if *of == id)
            });
            if ends.count() > 0 {
                return happened;
            }
            thread::sleep(Duration::from_millis(2));
        }
        panic!("it never ends: {happened:?}");
    }

    fn pass(&mut self, time: Duration) {
        let until = Instant::now() + time;
        while Instant::now() < until {
            let _ = self.robot.poll(self.now());
            thread::sleep(Duration::from_millis(2));
        }
    }

    fn moves_up(&mut self) {
        let id = self.begin("move-up");
        let happened = self.until_end(id);
        assert_eq!(happened.last(), Some(&Event::Done(id)), "{happened:?}");
    }
}

fn lost(happened: &[Event]) -> bool {
    matches!(
        happened.last(),
        Some(Event::Failed {
            fault: Fault::RobotLost,
            ..
        })
    )
}

/// `candump`, and what it has seen.
struct Witness(Child);

impl Witness {
    fn of(interface: &str) -> Self {
        let mut process = Process::new("candump");
        process.args(["-L", interface]).stdout(Stdio::piped());
        let witness = Self(process.spawn().unwrap());
        thread::sleep(Duration::from_millis(300));
        witness
    }

    fn frames(mut self) -> Vec<Frame> {
        thread::sleep(Duration::from_millis(200));
        self.0.kill().unwrap();
        let output = BufReader::new(self.0.stdout.take().unwrap());
        let lines = output.lines().map_while(Result::ok);
        let frames = lines.filter_map(|line| {
            let (id, data) = line.split_whitespace().nth(2)?.split_once('#')?;
            let byte = |at| u8::from_str_radix(data.get(at..at + 2)?, 16).ok();
            let data: Option<Vec<u8>> = (0..data.len()).step_by(2).map(byte).collect();
            Frame::new(u16::from_str_radix(id, 16).ok()?, &data?)
        });
        let frames = frames.collect();
        self.0.wait().unwrap();
        frames
    }
}

#[test]
fn a_witness_sees_a_command_and_all_that_follows() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let witness = Witness::of(&name);
    let far = Far::on(&name);
    let mut near = Near::to(&far.way);
    near.moves_up();
    let seen = witness.frames();
    let (mut host, mut robot) = (Assembler::new(Sender::Host), Assembler::new(Sender::Robot));
    let (mut said, mut answered) = (Vec::new(), Vec::new());
    for frame in &seen {
        assert_eq!(frame.data().len(), 8);
        if let Some(packet) = host.take(frame) {
            said.push(ToRobot::read(&packet.unwrap()).unwrap());
        }
        if let Some(packet) = robot.take(frame) {
            answered.push(FromRobot::read(&packet.unwrap()).unwrap());
        }
    }
    let executes = said
        .iter()
        .filter(|m| matches!(m, ToRobot::Execute(_)))
        .count();
    assert_eq!(executes, 1, "{said:?}");
    let position = |wanted: fn(&FromRobot) -> bool| answered.iter().position(wanted);
    let accepted = position(|m| matches!(m, FromRobot::Accepted(_))).unwrap();
    let done = position(|m| matches!(m, FromRobot::Done(_))).unwrap();
    assert!(accepted < done);
}

#[test]
fn a_halt_of_anybody_on_the_bus_stops_the_arm() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let far = Far::on(&name);
    let mut near = Near::to(&far.way);
    let id = near.begin("move-up");
    near.pass(Duration::from_millis(100));
    let number = Number::new(0).unwrap();
    let halt = ToRobot::Halt(Halt {
        id: Id { run: 0, number },
    });
    for frame in frames(Sender::Host, &halt.packet()) {
        let data: String = frame.data().iter().map(|b| format!("{b:02X}")).collect();
        run("cansend", &[&name, &format!("{:03X}#{data}", frame.id())]);
    }
    let happened = near.until_end(id);
    assert!(
        matches!(happened.last(), Some(Event::Stopped { .. })),
        "{happened:?}"
    );
}

#[test]
fn an_interface_that_goes_down_ends_the_command_and_comes_back() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let far = Far::on(&name);
    let mut near = Near::to(&far.way);
    let id = near.begin("move-up");
    near.pass(Duration::from_millis(100));
    run("ip", &["link", "set", &name, "down"]);
    let happened = near.until_end(id);
    assert!(lost(&happened), "{happened:?}");
    thread::sleep(Duration::from_millis(500));
    assert!(!far.moving.load(Ordering::Relaxed));
    run("ip", &["link", "set", &name, "up"]);
    near.pass(Duration::from_millis(1_500));
    assert!(!far.moving.load(Ordering::Relaxed), "it goes on by itself");
    near.moves_up();
}

/// Frames with which a controller reports what it meets: `CAN_ERR_BUSOFF`, `CAN_ERR_LOSTARB`.
const BUS_OFF: &str = "20000040#0000000000000000";
const ARBITRATION_LOST: &str = "20000002#0000000000000000";

#[test]
fn a_controller_off_the_bus_ends_the_command() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let far = Far::on(&name);
    let mut near = Near::to(&far.way);
    let id = near.begin("move-up");
    near.pass(Duration::from_millis(100));
    run("cansend", &[&name, BUS_OFF]);
    let happened = near.until_end(id);
    assert!(lost(&happened), "{happened:?}");
    near.pass(Duration::from_millis(1_500));
    assert!(!far.moving.load(Ordering::Relaxed), "it goes on by itself");
    near.moves_up();
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
fn the_kernels_own_slcan_speaks_to_our_adapter() {
    let Some((_, _one)) = interface() else { return };
    let pair = deictic::link::Pair::open().unwrap();
    let port = pair.path().to_owned();
    let _far = Far::at(Listener::Pair {
        pair,
        adapter: true,
    });
    let slcand = Process::new("slcand")
        .args(["-F", "-o", "-s8", &port, "slcan0"])
        .spawn();
    let mut slcand = slcand.unwrap();
    let up = || {
        Process::new("ip")
            .args(["link", "set", "slcan0", "up"])
            .stderr(Stdio::null())
            .status()
    };
    let until = Instant::now() + Duration::from_secs(5);
    while !up().unwrap().success() {
        assert!(Instant::now() < until, "there is no slcan0");
        thread::sleep(Duration::from_millis(50));
    }
    let mut near = Near::to(&Way::Can("slcan0".to_owned()));
    near.moves_up();
    slcand.kill().unwrap();
    slcand.wait().unwrap();
}
