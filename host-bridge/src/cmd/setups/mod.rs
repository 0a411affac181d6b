//! `deictic setups`: the paper's user study replayed on a unit.

mod deciding;

use std::path::PathBuf;

use clap::Args;
use deictic_core::protocol::message::Configuration;
use deictic_core::time::Micros;
use indicatif::{ProgressBar, ProgressStyle};
use miette::{IntoDiagnostic, Result};
use serde::Serialize;

use super::profile::Choice;
use super::{advice, paint};
use crate::explain::{self, Advice};
use crate::link::Address;
use crate::sensor::{Noise, Sensors};
use crate::sensor_model::SensorModel;
use crate::setups::{self, Kind, Tally};
use crate::unit::GestureUnit;
use crate::vocabulary::Lexicon;
use deciding::{decide_here, decide_there};

/// Replay published table set-ups: each command aligned and in four contradicting pairs
///
/// What is said and shown is drawn from the vocabulary's similarity tables under noise. Every
/// decision of a unit is also made here, and the two must be the same.
#[derive(Args, Clone, Debug)]
pub struct Setups {
    /// The set-ups (JSON)
    file: PathBuf,
    /// The unit that decides: serial:PORT@BAUD, tcp:HOST:PORT or qemu; without one it is done here
    #[arg(long, value_name = "ADDRESS")]
    board: Option<Address>,
    /// How often each command is drawn
    #[arg(long, default_value_t = 20)]
    draws: u32,
    /// How noisy the sensors are
    #[arg(long, value_enum, value_name = "LEVEL", default_value_t = Noise::N1)]
    noise: Noise,
    /// What the noise starts from
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    choice: Choice,
    /// Print one JSON object, for programs
    #[arg(long)]
    json: bool,
}

/// A row of the result.
#[derive(Serialize)]
struct Row {
    kind: &'static str,
    #[serde(flatten)]
    tally: Tally,
    right_percent: f64,
}

/// All that `--json` prints.
#[derive(Serialize)]
struct Report {
    decided_by: String,
    kinds: Vec<Row>,
    compared_with_host: u32,
    differences_from_host: u32,
}

impl Setups {
    /// Runs the command.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<()> {
        self.choice.check()?;
        let lexicon = Lexicon::tabletop()?;
        let setups = setups::read(&self.file, &lexicon)?;
        let profile = self.choice.profile();
        let Some(first) = setups.first() else {
            return Err(advice(
                "there is no set-up in the file",
                "name a file with set-ups",
            ));
        };
        // Both sentences come at once, so the window only has to outlast a busy machine.
        let window = Micros::from_millis(60_000);
        let configuration = Configuration {
            profile,
            window,
            ..Configuration::DEFAULT
        };
        let mut unit = match &self.board {
            Some(address) => Some(GestureUnit::connect(
                address,
                lexicon.vocabulary(),
                first.table.scene(),
                configuration,
            )?),
            None => None,
        };
        let model = SensorModel::made_up(&lexicon);
        let known = model.here().map_err(|e| {
            let Advice { what, remedy } = explain::sensor_error(&e);
            advice(what, remedy)
        })?;
        if let Some(unit) = &mut unit {
            unit.set_sensors(model)?;
        }
        let mut sensors = Sensors::new(&lexicon, self.noise, self.seed);
        let mut tallies = [Tally::default(); Kind::ALL.len()];
        let mut differences = 0;
        let bar = self.bar(setups.len());
        let mut table = first.table.clone();
        for setup in &setups {
            let things = setup.table.scene().entities().to_vec();
            table.replace(things, &lexicon).map_err(|e| {
                advice(
                    explain::scene_error(&e).what,
                    explain::scene_error(&e).remedy,
                )
            })?;
            if let Some(unit) = &mut unit {
                unit.set_scene(table.scene())?;
            }
            for _ in 0..self.draws {
                for (kind, tally) in Kind::ALL.into_iter().zip(&mut tallies) {
                    let sentences = kind.observe(setup, &mut sensors).map_err(|e| {
                        advice(
                            explain::sentence_error(&e).what,
                            "make the vocabulary smaller",
                        )
                    })?;
                    let here =
                        decide_here(&lexicon, &table, &sentences, &configuration, known.view())?;
                    let decision = match &mut unit {
                        Some(unit) => decide_there(unit, sentences)?,
                        None => here.clone(),
                    };
                    differences += u32::from(decision != here);
                    tally.add(&decision, &setup.truth);
                    bar.inc(1);
                }
            }
        }
        bar.finish_and_clear();
        let report = Report {
            decided_by: self
                .board
                .as_ref()
                .map_or("this host".to_owned(), ToString::to_string),
            kinds: Kind::ALL
                .into_iter()
                .zip(tallies)
                .map(|(kind, tally)| Row {
                    kind: kind.name(),
                    tally,
                    right_percent: tally.percent(tally.right),
                })
                .collect(),
            compared_with_host: if unit.is_some() {
                tallies.iter().map(|t| t.decisions).sum()
            } else {
                0
            },
            differences_from_host: differences,
        };
        self.print(&report)?;
        if differences > 0 {
            return Err(advice(
                format!("the unit decided otherwise than this host in {differences} cases"),
                "flash the firmware that belongs to this bridge",
            ));
        }
        Ok(())
    }

    fn bar(&self, setups: usize) -> ProgressBar {
        if self.json {
            return ProgressBar::hidden();
        }
        let total = setups as u64 * u64::from(self.draws) * Kind::ALL.len() as u64;
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} decisions  {eta} left");
        ProgressBar::new(total).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
    }

    fn print(&self, report: &Report) -> Result<()> {
        if self.json {
            println!("{}", serde_json::to_string(report).into_diagnostic()?);
            return Ok(());
        }
        anstream::println!(
            "decided by {}, {} draws per command, noise {:?}",
            report.decided_by,
            self.draws,
            self.noise
        );
        anstream::println!(
            "{:<20} {:>9}  {:>8}  {:>15}  {:>15}  {:>6}  {:>7}",
            "",
            "decisions",
            "right",
            "executed right",
            "executed wrong",
            "asked",
            "repeat"
        );
        for Row {
            kind,
            tally,
            right_percent,
        } in &report.kinds
        {
            let share = |count| format!("{:.1} %", tally.percent(count));
            anstream::println!(
                "{kind:<20} {:>9}  {}  {:>15}  {:>15}  {:>6}  {:>7}",
                tally.decisions,
                paint::good(format!("{right_percent:>6.1} %")),
                share(tally.executed_right),
                share(tally.executed_wrong),
                share(tally.asked),
                share(tally.repeated)
            );
        }
        anstream::println!(
            "{}",
            paint::dim(
                "right: the likeliest intent has the meant action, object and storage, whether executed or not"
            )
        );
        if report.compared_with_host > 0 {
            anstream::println!(
                "{} of {} decisions differ from those of the same core on this host",
                report.differences_from_host,
                report.compared_with_host
            );
        }
        Ok(())
    }
}
