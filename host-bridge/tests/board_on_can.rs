//! The unit's image on an emulated board whose host link is a CAN bus (the board is the LAWICEL adapter on
//! its second UART): it decides a session as the unit in this process does.
//!
//! `DEICTIC_IMAGE_MPS2_AN386_CAN` names the image; `cargo xtask test` builds it. Skipped, with a word, where
//! none is named.

use std::process::Command;

use deictic::link::Emulation;
use serde_json::Value;

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
    let mut board = Emulation::start(image.as_ref(), [false, true, false], &[]).unwrap();
    // The bridge comes to the line itself, which takes one host at a time.
    drop(board.take(1));
    let port = board.port(1).unwrap();
    let on_bus = decisions(&format!("slcan:tcp:127.0.0.1:{port}"));
    assert_eq!(on_bus.len(), 20);
    assert_eq!(on_bus, decisions("inside"));
}
