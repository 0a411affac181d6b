//! `faults SESSIONS FRAMES [SEED]`: many sessions under faults and many damaged frames, every second one sealed, and what
//! came of them.

use std::collections::BTreeMap;
use std::time::Instant;

use deictic_core::time::Micros;
use deictic_tests::network::damage::damaged_frames;
use deictic_tests::network::trial::{Setting, run};

fn main() {
    let mut numbers = std::env::args()
        .skip(1)
        .map(|n| n.parse().expect("a number"));
    let mut next = |default: u64| numbers.next().unwrap_or(default);
    let (sessions, frames, seed) = (next(100_000), next(1_000_000), next(0));
    let setting = Setting::default();
    let (mut begun, mut losses, mut alone) = (0, 0, Micros(0));
    let mut ends = BTreeMap::new();
    let started = Instant::now();
    for session in seed..seed + sessions {
        let account = std::panic::catch_unwind(|| run(&setting, session));
        let Ok(account) = account else {
            eprintln!(
                "session {session} breaks what must hold: `faults 1 0 {session}` plays it again"
            );
            std::process::exit(1);
        };
        for end in account.ends {
            *ends.entry(end).or_insert(0_u64) += 1;
        }
        begun += account.begun;
        losses += account.losses;
        alone = alone.max(account.alone);
    }
    let commands: u64 = ends.values().sum();
    println!(
        "{sessions} sessions, {commands} commands, {losses} losses of the unit, {:.0} s",
        started.elapsed().as_secs_f64()
    );
    for (end, count) in &ends {
        println!("  {:<8} {count}", format!("{end:?}").to_lowercase());
    }
    println!(
        "  the robot began {begun} motions, each told once by the unit on the scene that was there"
    );
    println!(
        "  it moved at most {} ms after the unit was last heard",
        alone.0 / 1_000
    );
    let report = damaged_frames(frames, seed);
    println!(
        "{} damaged frames, {} taken",
        report.frames - report.intact,
        report.accepted
    );
    assert_eq!(report.accepted, 0, "a damaged frame was taken");
}
