//! The unit's image on an emulated board whose host link is a CAN bus (the board is the LAWICEL adapter on
//! its second UART): it decides a session as the unit in this process does.
//!
//! `DEICTIC_IMAGE_MPS2_AN386_CAN` names the image; `cargo xtask test` builds it. Skipped, with a word, where
//! none is named.

use std::net::{Ipv4Addr, TcpListener};
use std::process::{Child, Command, Stdio};

use serde_json::Value;

/// A running board; dropping it pulls the plug.
struct Board(Child);

impl Drop for Board {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn boot(image: &str, port: u16) -> Board {
    let second = format!("tcp:127.0.0.1:{port},server=on,wait=off,nodelay=on");
    let mut qemu = Command::new(deictic::link::QEMU);
    qemu.args(["-M", "mps2-an386", "-display", "none", "-monitor", "none"])
        .args(["-kernel", image])
        .args(["-serial", "null", "-serial", &second, "-serial", "null"]);
    qemu.stdin(Stdio::null()).stdout(Stdio::null());
    Board(qemu.spawn().unwrap())
}

/// What was decided for every command of the demo.
fn decisions(board: &str) -> Vec<Value> {
    let mut bridge = Command::new(env!("CARGO_BIN_EXE_deictic"));
    bridge.args(["play", "--json", "--haste", "20", "--board", board]);
    let output = bridge.output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{board}: {error}");
    let said = String::from_utf8_lossy(&output.stdout);
    let last: Value = serde_json::from_str(said.lines().last().unwrap()).unwrap();
    let rows = last["rows"].as_array().unwrap();
    rows.iter().map(|row| row["decided"].clone()).collect()
}

#[test]
fn a_board_on_a_bus_decides_as_one_in_this_process() {
    let Ok(image) = std::env::var("DEICTIC_IMAGE_MPS2_AN386_CAN") else {
        eprintln!("skipped: no image of a board on a CAN bus; `cargo xtask test` builds one");
        return;
    };
    let free = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let port = free.local_addr().unwrap().port();
    drop(free);
    let _board = boot(&image, port);
    let until = std::time::Instant::now() + std::time::Duration::from_secs(20);
    while std::net::TcpStream::connect((Ipv4Addr::LOCALHOST, port)).is_err() {
        assert!(std::time::Instant::now() < until, "QEMU does not listen");
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    let on_bus = decisions(&format!("slcan:tcp:127.0.0.1:{port}"));
    assert_eq!(on_bus.len(), 20);
    assert_eq!(on_bus, decisions("inside"));
}
