//! Sessions over lines that do everything wrong that lines can: nothing is done twice, nothing that nobody decided,
//! nothing for long after the unit was heard last, and every command ends in exactly one way that the person is told.

use deictic_tests::network::damage::damaged_frames;
use deictic_tests::network::trial::{Setting, run};

/// `cargo xtask faults` runs many more.
const SESSIONS: u64 = 2_000;

#[test]
fn whatever_happens_on_the_way_every_command_ends_once_and_the_robot_obeys() {
    let setting = Setting::default();
    let mut ends = std::collections::BTreeMap::new();
    for seed in 0..SESSIONS {
        for end in run(&setting, seed).ends {
            *ends.entry(end).or_insert(0) += 1;
        }
    }
    eprintln!("{ends:?}");
    assert_eq!(ends.len(), 5, "every way to end was met: {ends:?}");
}

#[test]
fn no_damaged_frame_is_taken_for_another() {
    let report = damaged_frames(50_000, 1);
    assert_eq!(report.accepted, 0, "{report:?}");
    assert!(report.intact < report.frames / 10, "{report:?}");
}
