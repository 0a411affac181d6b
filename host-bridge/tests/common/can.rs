//! The CAN interface that `DEICTIC_CAN` names (`cargo xtask can` makes one), and programs that are called for it.
#![allow(dead_code)]

use std::io::{BufRead, BufReader};
use std::process::{Child, Command as Process, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use deictic::robot::Event;
use deictic_core::can::{CLASSIC, FlexibleFrame};
use deictic_core::command::field::{Id, Number};
use deictic_core::command::message::{Halt, ToRobot};
use deictic_core::command::parcel::{Sender, frames};

use crate::trial::{Far, Near};

/// The interface, for one test at a time: they switch it off and spoil it.
pub fn interface() -> Option<(String, MutexGuard<'static, ()>)> {
    static ONE: Mutex<()> = Mutex::new(());
    let Ok(named) = std::env::var("DEICTIC_CAN") else {
        eprintln!("skipped: DEICTIC_CAN names no CAN interface; `cargo xtask can` makes one");
        return None;
    };
    Some((named, ONE.lock().unwrap_or_else(PoisonError::into_inner)))
}

/// Runs a program, which must go well.
pub fn run(program: &str, arguments: &[&str]) {
    let status = Process::new(program).args(arguments).status().unwrap();
    assert!(status.success(), "{program} {arguments:?}");
}

/// Has `cansend` halt whatever moves, in classic frames, as anybody on the bus may.
fn halt(interface: &str) {
    let number = Number::new(0).unwrap();
    let halt = ToRobot::Halt(Halt {
        id: Id { run: 0, number },
    });
    for frame in frames::<CLASSIC>(Sender::Host, &halt.packet()) {
        let data: String = frame.data().iter().map(|b| format!("{b:02X}")).collect();
        run(
            "cansend",
            &[interface, &format!("{:03X}#{data}", frame.id())],
        );
    }
}

/// Holds that an arm on this interface stops when anybody says halt.
pub fn stops_at_a_halt(interface: &str, far: &Far) {
    let mut near = Near::to(&far.way);
    let id = near.begin("move-up");
    near.pass(Duration::from_millis(100));
    halt(interface);
    let happened = near.until_end(id);
    assert!(
        matches!(happened.last(), Some(Event::Stopped { .. })),
        "{happened:?}"
    );
}

/// The kernel's own interface to an adapter, slcan0, there as long as this is.
pub struct Slcand(Child);

impl Slcand {
    /// At the adapter's serial line.
    pub fn on(port: &str) -> Self {
        let slcand = Process::new("slcand")
            .args(["-F", "-o", "-s8", port, "slcan0"])
            .spawn();
        let slcand = Self(slcand.unwrap());
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
        slcand
    }
}

impl Drop for Slcand {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// `candump`, and what it has seen.
pub struct Witness(Child);

impl Witness {
    /// Of what goes over this interface from now on.
    pub fn of(interface: &str) -> Self {
        let mut process = Process::new("candump");
        process.args(["-L", interface]).stdout(Stdio::piped());
        let witness = Self(process.spawn().unwrap());
        thread::sleep(Duration::from_millis(300));
        witness
    }

    /// The frames, of either kind.
    pub fn frames(mut self) -> Vec<FlexibleFrame> {
        thread::sleep(Duration::from_millis(200));
        self.0.kill().unwrap();
        let output = BufReader::new(self.0.stdout.take().unwrap());
        let lines = output.lines().map_while(Result::ok);
        let frames = lines.filter_map(|line| {
            let (id, data) = line.split_whitespace().nth(2)?.split_once('#')?;
            // A frame of CAN FD has a second mark, and a digit for its flags.
            let data = data.strip_prefix('#').map_or(Some(data), |d| d.get(1..))?;
            let byte = |at| u8::from_str_radix(data.get(at..at + 2)?, 16).ok();
            let data: Option<Vec<u8>> = (0..data.len()).step_by(2).map(byte).collect();
            FlexibleFrame::new(u16::from_str_radix(id, 16).ok()?, &data?)
        });
        let frames = frames.collect();
        self.0.wait().unwrap();
        frames
    }
}
