//! The simulated robot behind every link that it can be reached over: twenty commands that depend on
//! each other end alike on all of them, and a command is accepted soon.
//!
//! `DEICTIC_CAN` names a CAN interface of this machine, such as vcan0; with it that link alone is tried,
//! without it all others. `cargo xtask can` makes one, if need be in a Linux of its own.

#[path = "common/bus.rs"]
mod bus;

use std::fmt::Write as _;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command as Process, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use deictic::robot::end::{End, Listener, Served};
use deictic::robot::remote::{Carrier, OnBus, Remote};
use deictic::robot::sim::Sim;
use deictic::robot::way::{self, Way};
use deictic::robot::{Command, CommandId, Event, Robot, Taken, World};
use deictic::scene::SceneFile;
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::command::parcel::Sender;
use deictic_core::large::Intent;
use deictic_core::time::Micros;
use serde_json::Value;

/// The interface that the tests may use.
fn interface() -> Option<String> {
    let named = std::env::var("DEICTIC_CAN").ok();
    if named.is_none() {
        eprintln!(
            "can: skipped, since DEICTIC_CAN names no interface; `cargo xtask can` makes one"
        );
    }
    named
}

/// Where the simulated robot is to listen.
fn places() -> Vec<String> {
    // A guest that has CAN has one processor: the links that are everywhere are tried outside.
    if let Some(name) = interface() {
        return vec![format!("can:{name}")];
    }
    let everywhere = [
        "tcp:127.0.0.1:0",
        "serial:pty",
        "slcan:pty",
        "slcan:tcp:127.0.0.1:0",
    ];
    everywhere.map(str::to_owned).to_vec()
}

/// A robot in a process of its own.
struct Far(Child);

impl Far {
    fn listening(at: &str) -> (Self, String) {
        let mut process = Process::new(env!("CARGO_BIN_EXE_deictic"));
        process.args(["robot-sim", "--json", "--haste", "8", "--listen", at]);
        let mut child = process.stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        let mut output = BufReader::new(child.stdout.take().unwrap());
        output.read_line(&mut line).unwrap();
        // What else it says is of no interest, but it must be able to say it.
        thread::spawn(move || output.lines().map_while(Result::ok).for_each(drop));
        let told: Value = serde_json::from_str(&line).unwrap();
        (Self(child), told["address"].as_str().unwrap().to_owned())
    }
}

impl Drop for Far {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// How every command of the demo ends with this robot. Where a stop meets the arm is not compared.
fn endings(robot: &str) -> Vec<String> {
    let mut process = Process::new(env!("CARGO_BIN_EXE_deictic"));
    process.args(["play", "--json", "--haste", "8", "--robot", robot]);
    let output = process.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success(),
        "{robot}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    let last: Value = serde_json::from_str(said.lines().last().unwrap()).unwrap();
    let rows = last["rows"].as_array().unwrap();
    let ending = |row: &Value| {
        let robot = row["robot"].as_str().unwrap();
        let robot = robot
            .split_once(": ")
            .filter(|(what, _)| *what == "stopped");
        let robot = robot.map_or(row["robot"].as_str().unwrap(), |(what, _)| what);
        format!("{} -> {robot}", row["decided"])
    };
    rows.iter().map(ending).collect()
}

#[test]
fn twenty_commands_end_alike_over_every_link() {
    let near = thread::spawn(|| endings("sim"));
    let far = places().into_iter().map(|at| {
        thread::spawn(move || {
            let (_far, address) = Far::listening(&at);
            (at, endings(&address))
        })
    });
    let far: Vec<_> = far.collect();
    let near = near.join().unwrap();
    assert_eq!(near.len(), 20);
    assert!(
        near.iter().filter(|e| e.ends_with("-> done")).count() >= 12,
        "{near:#?}"
    );
    let mut table = String::from("command: ending with the robot in this process");
    let far: Vec<_> = far.into_iter().map(|link| link.join().unwrap()).collect();
    for (at, _) in &far {
        let _ = write!(table, " | {at}");
    }
    for (i, ending) in near.iter().enumerate() {
        let _ = write!(table, "\n{:2} {ending}", i + 1);
        for (_, endings) in &far {
            let same = endings.get(i) == Some(ending);
            let _ = write!(table, " | {}", if same { "same" } else { "DIFFERENT" });
        }
    }
    println!("{table}");
    for (at, endings) in far {
        assert_eq!(endings, near, "over {at}");
    }
}

/// Serves a robot in this process until the switch is thrown.
fn serve(at: &str, over: &Arc<AtomicBool>) -> Way {
    let listener = match at.strip_suffix(":pty") {
        Some(kind) => Listener::Pair {
            pair: deictic::link::Pair::open().unwrap(),
            adapter: kind == "slcan",
        },
        None => Listener::open(&at.parse().unwrap()).unwrap(),
    };
    let address = listener.address().parse().unwrap();
    let end = End::new(Box::new(Sim::new(1.0)), Lexicon::tabletop().unwrap(), 1);
    let over = Arc::clone(over);
    thread::spawn(move || {
        let mut served = Served::new(end, listener);
        while !over.load(Ordering::Relaxed) {
            served.turn(Duration::from_millis(20));
        }
    });
    address
}

/// A robot behind a bus that takes no time, so that what is left is the two programs' own share.
fn without_a_line(over: &Arc<AtomicBool>, lexicon: &Lexicon) -> Remote {
    let bus = bus::MemoryBus::default();
    let mut theirs = OnBus::new(Box::new(bus.node()), Sender::Robot);
    let mut end = End::new(Box::new(Sim::new(1.0)), Lexicon::tabletop().unwrap(), 1);
    let over = Arc::clone(over);
    thread::spawn(move || {
        let began = Instant::now();
        let now = || Micros(u64::try_from(began.elapsed().as_micros()).unwrap());
        while !over.load(Ordering::Relaxed) {
            let mut out = Vec::new();
            end.poll(now(), &mut out);
            if let Some(packet) = theirs.receive(Duration::from_millis(5)).unwrap() {
                end.take(now(), &packet, &mut out);
            }
            for packet in out {
                theirs.send(&packet).unwrap();
            }
        }
    });
    let open = Box::new(move || {
        let ours = OnBus::new(Box::new(bus.node()), Sender::Host);
        Ok(Box::new(ours) as Box<dyn Carrier>)
    });
    let mut remote = Remote::open(open, lexicon).unwrap();
    remote.wait(Duration::from_secs(3)).unwrap();
    remote
}

/// Gives commands one after the other, each stopped as soon as it is accepted; how long every
/// acceptance took, in microseconds, the shortest first.
fn acceptances(mut remote: Remote, lexicon: &Lexicon, commands: u32) -> Vec<u128> {
    let table = SceneFile::table().unwrap().tabletop(lexicon).unwrap();
    let began = Instant::now();
    let now = || Micros(u64::try_from(began.elapsed().as_micros()).unwrap());
    let mut took = Vec::new();
    for number in 1..=commands {
        let id = CommandId { run: 1, number };
        let command = Command {
            id,
            intent: Intent {
                action: lexicon.option(Category::ACTION, "move-up").unwrap(),
                ..Intent::default()
            },
            scene: table.version(),
        };
        let world = World {
            table: &table,
            lexicon,
        };
        let given = Instant::now();
        let mut accepted = match remote.begin(now(), &command, world).unwrap() {
            Taken::Begun => Some(given.elapsed()),
            Taken::Sent => None,
        };
        let mut ended = false;
        while !ended {
            assert!(
                given.elapsed() < Duration::from_secs(5),
                "command {number} never ends"
            );
            for event in remote.poll(now()) {
                match event {
                    Event::Accepted(_) if accepted.is_none() => accepted = Some(given.elapsed()),
                    Event::Stopped { .. } | Event::Done(_) => ended = true,
                    Event::Failed { why, .. } => panic!("command {number}: {why}"),
                    Event::Refused { refusal, .. } => panic!("command {number}: {refusal}"),
                    _ => {}
                }
            }
            if accepted.is_some() && !ended {
                remote.stop(now());
                thread::sleep(Duration::from_micros(50));
            }
        }
        took.push(accepted.unwrap().as_micros());
    }
    took.sort_unstable();
    took
}

/// `DEICTIC_COMMANDS` says how many commands every link is given; 500 when it is not there.
#[test]
fn how_soon_a_command_is_accepted_over_every_link() {
    let commands = std::env::var("DEICTIC_COMMANDS").map_or(500, |n| n.parse().unwrap());
    let lexicon = Lexicon::tabletop().unwrap();
    let over = Arc::new(AtomicBool::new(false));
    println!("link: acceptance of {commands} commands, p50 / p99 / longest in us");
    let told = |link: &str, took: &[u128]| {
        let at = |share: usize| took[(took.len() - 1) * share / 100];
        println!("{link}: {} / {} / {}", at(50), at(99), at(100));
        assert_eq!(took.len(), commands as usize);
    };
    told(
        "none",
        &acceptances(without_a_line(&over, &lexicon), &lexicon, commands),
    );
    for at in places() {
        let way = serve(&at, &over);
        let remote = way::reach(&way, &lexicon).unwrap();
        told(&at, &acceptances(remote, &lexicon, commands));
    }
    over.store(true, Ordering::Relaxed);
}
