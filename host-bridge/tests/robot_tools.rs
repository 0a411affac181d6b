//! A host made of python-can and cantools alone (`tools/robot.py`) speaks to the simulated robot behind
//! our LAWICEL adapter, and decodes all that it says with the committed DBC file.
//!
//! `DEICTIC_PYTHON` names a Python that has both; `cargo xtask test` makes one. Skipped, with a word,
//! where none is named.

use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use deictic::link::Pair;
use deictic::robot::end::{End, Listener, Served};
use deictic::robot::sim::Sim;
use deictic::vocabulary::Lexicon;
use deictic_core::protocol::seal::{KEY, Key};

#[test]
fn python_can_and_cantools_understand_the_robot() {
    speaks(None);
}

#[test]
fn python_seals_what_it_says_and_opens_what_it_hears() {
    speaks(Some(0x5a));
}

/// Has the Python host speak to a robot that has the key of 32 such bytes, or none.
fn speaks(byte: Option<u8>) {
    let Ok(python) = std::env::var("DEICTIC_PYTHON") else {
        eprintln!("skipped: DEICTIC_PYTHON names no Python with python-can and cantools");
        return;
    };
    let pair = Pair::open().unwrap();
    let port = pair.path().to_owned();
    let lexicon = Lexicon::tabletop().unwrap();
    let vocabulary = lexicon.vocabulary().fingerprint().to_string();
    let over = Arc::new(AtomicBool::new(false));
    let ends = Arc::clone(&over);
    let robot = thread::spawn(move || {
        let end = End::new(Box::new(Sim::new(4.0)), lexicon, 1);
        let listener = Listener::Pair {
            pair,
            adapter: true,
        };
        let mut served = Served::new(end, listener);
        if let Some(key) = byte.and_then(|byte| Key::new(&[byte; KEY])) {
            served = served.with_key(&key).unwrap();
        }
        while !ends.load(Ordering::Relaxed) {
            served.turn(Duration::from_millis(10));
        }
    });
    let here = env!("CARGO_MANIFEST_DIR");
    let output = Command::new(python)
        .arg(format!("{here}/tests/tools/robot.py"))
        .args([&port, &format!("{here}/../docs/deictic.dbc"), &vocabulary])
        .args(byte.map(|byte| format!("{byte:02x}").repeat(KEY)))
        .output()
        .unwrap();
    over.store(true, Ordering::Relaxed);
    robot.join().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    println!("{said}");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}{error}");
    assert!(said.contains("frames decoded"), "{said}");
    assert_eq!(said.contains("under a seal"), byte.is_some(), "{said}");
}
