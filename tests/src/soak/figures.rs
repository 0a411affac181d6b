//! A long session, and what is left of it.

use std::collections::BTreeMap;
use std::fmt;
use std::time::Instant;

use deictic::clock::Hasty;

use super::board::{Cable, HASTE};
use crate::network::trial::{End, Setting, Trial};

/// What came of it.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    /// How long it was, in the board's time.
    pub seconds: u64,
    /// How long it took, in ours.
    pub ours: f64,
    /// How its commands ended.
    pub ends: BTreeMap<End, u64>,
    /// Motions that the robot began.
    pub begun: usize,
    /// How often the unit was lost, and how often the board started.
    pub losses: usize,
    /// Starts of the board.
    pub boots: u32,
    /// How often the unit's statistics were held against what it had said.
    pub looked: u32,
    /// Of these, how often they were something else.
    pub wrong: usize,
    /// Memory of this process after a quarter of the time and at the end, in KiB.
    pub memory: [u64; 2],
    /// How far the board's clock was ahead of ours at most, in microseconds of its own; it may be behind when the
    /// emulation was not given the time.
    pub ahead: i64,
}

/// Resident memory of this process in KiB.
fn memory() -> u64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|l| l.strip_prefix("VmRSS:"));
    let number = line.and_then(|l| l.split_whitespace().next()?.parse().ok());
    number.unwrap_or(0)
}

/// Operates for so long in the board's time.
///
/// # Panics
/// When something does not hold of a command, by the rules of [`crate::network::trial`].
#[must_use]
pub fn soak(setting: &Setting, seconds: u64, seed: u64) -> Figures {
    let _clock = Hasty::start(HASTE);
    let started = Instant::now();
    let cable = Cable::new(seed);
    // The bridge's patience with a board that starts is a fraction of a second of ours.
    let mut tries = 0..TRIES;
    let mut trial = loop {
        let opened = Trial::open(setting, cable.clone(), seed, true);
        match (opened, tries.next()) {
            (Ok(trial), _) => break trial,
            (Err(error), None) => panic!("the board does not answer: {error}"),
            _ => {}
        }
    };
    trial.in_a_hurry();
    let mut figures = Figures {
        seconds,
        ..Figures::default()
    };
    // By this machine's clock, as the bridge's jumps.
    let passed = || (started.elapsed() * HASTE).as_secs();
    while passed() < seconds {
        trial.change_faults();
        trial.command(setting);
        if figures.memory[0] == 0 && passed() >= seconds / 4 {
            figures.memory[0] = memory();
        }
    }
    figures.memory[1] = memory();
    let account = trial.account();
    for end in account.ends {
        *figures.ends.entry(end).or_insert(0) += 1;
    }
    figures.begun = account.begun;
    figures.losses = account.losses;
    figures.boots = cable.boots();
    figures.ours = started.elapsed().as_secs_f64();
    cable.with_heard(|heard| {
        figures.looked = heard.looked;
        figures.wrong = heard.wrong.len();
        for wrong in heard.wrong.iter().take(3) {
            eprintln!(
                "{} decisions were said, and counted: {:?}",
                wrong.0, wrong.1
            );
        }
        figures.ahead = heard
            .behind
            .values()
            .map(|(least, _)| -least)
            .max()
            .unwrap_or(0);
    });
    figures
}

impl Figures {
    /// Sees that nothing leaked and nothing was miscounted.
    ///
    /// # Panics
    /// When something did or was.
    pub fn check(&self) {
        let commands: u64 = self.ends.values().sum();
        assert!(commands > 0 && self.begun > 0, "nothing was done");
        assert!(self.looked > 0 && self.wrong == 0, "the unit miscounts");
        let [before, after] = self.memory;
        assert!(after <= before + LEAK, "{before} KiB, then {after} KiB");
        assert!(
            self.ahead <= AHEAD,
            "the unit's clock runs ahead: {} us",
            self.ahead
        );
    }
}

/// How often a board that has just started is tried.
const TRIES: u32 = 100;

/// How much this process may grow in three quarters of the time, in KiB: what was told is kept for the account.
const LEAK: u64 = 2_048;

/// How far the unit's clock may be ahead, in microseconds.
const AHEAD: i64 = 50_000;

impl fmt::Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let commands: u64 = self.ends.values().sum();
        writeln!(
            f,
            "{} s of the board's time in {:.0} s, {:.1} times as fast",
            self.seconds,
            self.ours,
            self.seconds as f64 / self.ours
        )?;
        writeln!(
            f,
            "{commands} commands, {} starts of the board, {} losses of the unit",
            self.boots, self.losses
        )?;
        for (end, count) in &self.ends {
            writeln!(f, "  {:<8} {count}", format!("{end:?}").to_lowercase())?;
        }
        writeln!(
            f,
            "  the robot began {} motions, each told once by the unit on the scene that was there",
            self.begun
        )?;
        writeln!(
            f,
            "  the unit's statistics were looked at {} times and wrong {} times",
            self.looked, self.wrong
        )?;
        writeln!(
            f,
            "  memory {} KiB after a quarter, {} KiB at the end; the unit's clock was behind by {} ms at least",
            self.memory[0],
            self.memory[1],
            -self.ahead / 1_000
        )
    }
}
