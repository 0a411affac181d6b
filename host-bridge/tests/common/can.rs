//! The CAN interface that `DEICTIC_CAN` names (`cargo xtask can` makes one), and programs that are called for it.
#![allow(dead_code)]

use std::process::{Child, Command as Process, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

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
