//! `deictic gestures`: gestures of a user's own.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use deictic_core::gesture::wire::Sample;
use miette::{IntoDiagnostic, Result, WrapErr};

use super::aiming::Aim;
use super::{advice, counted};
use crate::hand::learning::learn;
use crate::hand::performance::{Performance, strokes};
use crate::hand::source::recording;
use crate::hand::taught::{Taught, known};

/// Gestures of one's own, and how one aims
#[derive(Args, Clone, Debug)]
pub struct Gestures {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand, Clone, Debug)]
enum What {
    Learn(Learn),
    Aim(Aim),
}

/// Learn movements from recordings
///
/// ```text
/// $ deictic hand --hand leap --record zigzag.hand      several times, with a rest in between
/// $ deictic gestures learn zigzag=zigzag.hand spiral=spiral.hand --out mine.gestures
/// $ deictic run --board qemu --hand leap --gestures mine.gestures --vocabulary mine.toml
/// ```
///
/// The vocabulary's `gestures` name them like those a unit knows. Recordings of other people may have
/// the same name: zigzag=anna.hand zigzag=ben.hand.
#[derive(Args, Clone, Debug)]
#[command(verbatim_doc_comment)]
struct Learn {
    /// What a recording shows, and the recording
    #[arg(value_name = "NAME=FILE", required = true)]
    recordings: Vec<String>,
    /// Where to write the gestures (TOML)
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Examples of each gesture that the unit keeps
    #[arg(long, default_value_t = 6, value_name = "N")]
    each: usize,
    /// Tell apart only these, not those that a unit knows without being taught
    #[arg(long)]
    only: bool,
}

impl Gestures {
    /// Runs the command.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<()> {
        match self.what {
            What::Learn(learn) => learn.run(),
            What::Aim(aim) => aim.run(),
        }
    }
}

impl Learn {
    fn run(self) -> Result<()> {
        let mut performances = Vec::new();
        for (subject, written) in self.recordings.iter().enumerate() {
            let Some((name, path)) = written
                .split_once('=')
                .filter(|(n, p)| !n.is_empty() && !p.is_empty())
            else {
                return Err(advice(
                    format!("`{written}` names no gesture"),
                    "write what it shows in front: zigzag=zigzag.hand",
                ));
            };
            let samples = recording::read(Path::new(path))?;
            let found = of_recording(subject, name, &samples);
            let count = counted(found.len(), "movement");
            anstream::println!("{name:<16} {count} in {path}");
            if found.is_empty() {
                return Err(advice(
                    format!("{path} holds no movement"),
                    "rest for a moment before and after each movement, and move faster than 0.3 m/s",
                ));
            }
            performances.extend(found);
        }
        let performances: Vec<&Performance> = performances.iter().collect();
        let learned = learn(&performances, self.each)
            .map_err(|e| advice(&e, "record at least one movement of each, and at most 24"))?;
        let first = if self.only { 0 } else { known() };
        let mut templates = learned.templates;
        for template in &mut templates {
            let number = usize::from(template.gesture) + first;
            template.gesture = u8::try_from(number).unwrap_or(u8::MAX);
        }
        let taught = Taught {
            known: !self.only,
            gestures: learned.gestures,
            scale: if self.only {
                learned.scale
            } else {
                Taught::default().scale
            },
            templates,
        };
        let out = self.out.display().to_string();
        taught.check(&out).map_err(|e| advice(&e, e.remedy()))?;
        let text = toml::to_string(&taught).into_diagnostic()?;
        std::fs::write(&self.out, text)
            .into_diagnostic()
            .wrap_err_with(|| format!("cannot write {out}"))?;
        let (gestures, examples) = (taught.gestures.len(), taught.templates.len());
        let (gestures, examples) = (counted(gestures, "gesture"), counted(examples, "example"));
        anstream::println!("{gestures} with {examples}: {out}");
        Ok(())
    }
}

/// Every movement of a recording as a performance of the gesture.
fn of_recording(subject: usize, name: &str, samples: &[Sample]) -> Vec<Performance> {
    let performance = |stroke| Performance {
        subject: subject.to_string(),
        gesture: name.to_owned(),
        stroke: Some(stroke),
    };
    strokes(samples).into_iter().map(performance).collect()
}
