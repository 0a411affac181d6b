//! What became of each command is on record.

mod common;

use common::*;
use deictic::session::Happening;
use deictic::session::journal::{Became, Journal, Record};

fn take(journal: &mut Journal, happened: &[Happening]) -> Vec<Record> {
    let lexicon = lexicon();
    happened
        .iter()
        .filter_map(|h| journal.hear(h, &lexicon))
        .collect()
}

#[test]
fn every_command_is_on_record_once_with_how_it_ended() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    let mut journal = Journal::default();
    for (text, became) in [
        ("pick can", Became::Done),
        // The hand holds the can.
        ("pick cup", Became::Refused),
        ("release", Became::Done),
    ] {
        session.observe(surely_said(text, &lexicon)).unwrap();
        let records = take(&mut journal, &settle(&mut session));
        let [record] = &records[..] else {
            panic!("{text}: {records:?}");
        };
        assert_eq!(record.became, became, "{text}: {record:?}");
        assert_eq!(record.intent.action, text.split(' ').next().unwrap());
        assert_eq!(record.command.is_some(), became == Became::Done, "{text}");
        assert_eq!(record.why.is_none(), became == Became::Done, "{text}");
        assert!(record.took >= 0.0);
    }
}

#[test]
fn a_stopped_command_and_its_stop_are_two_records() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 5.0);
    let mut journal = Journal::default();
    session.observe(surely_said("pick can", &lexicon)).unwrap();
    let begun = |h: &Happening| {
        matches!(
            h,
            Happening::Robot(deictic::robot::Event::Begun { number: 2, .. })
        )
    };
    let mut records = take(&mut journal, &until(&mut session, begun));
    session.observe(surely_said("stop", &lexicon)).unwrap();
    records.extend(take(&mut journal, &settle(&mut session)));
    let became: Vec<_> = records.iter().map(|r| r.became).collect();
    assert_eq!(became, [Became::Stopped, Became::Done], "{records:?}");
    assert_eq!(records[0].why.as_deref(), Some("approach the can"));
    assert_eq!(records[1].intent.action, "stop");
    assert_ne!(records[0].command, records[1].command);
}

#[test]
fn the_program_logs_what_became_of_each_command() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log.jsonl");
    for say in ["pick the can", "push the cube to the left"] {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_deictic"))
            .args([
                "run", "--board", "inside", "--haste", "1000", "--window", "50",
            ])
            .args(["--say", say, "--log"])
            .arg(&log)
            .output()
            .unwrap();
        assert!(output.status.success());
    }
    let log = std::fs::read_to_string(&log).unwrap();
    let lines: Vec<serde_json::Value> = log
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(lines.len(), 2, "{log}");
    assert!(
        lines
            .iter()
            .all(|line| line["became"] == "done" && line["steps"] == 5),
        "{log}"
    );
    assert_ne!(lines[0]["command"][0], lines[1]["command"][0], "two runs");
}
