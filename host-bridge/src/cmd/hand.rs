//! `deictic hand`: what the unit sees of a hand, live.

mod screen;

use std::path::PathBuf;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::{Duration, Instant};

use clap::Args;
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::message::Configuration;
use miette::{IntoDiagnostic, Result, WrapErr};

use self::screen::Screen;
use super::files::Files;
use super::interrupts::interrupts;
use super::sensing::{Sensing, drain};
use super::{advice, paint};
use crate::explain;
use crate::hand::source::SourceError;
use crate::hand::source::recording::{Recorder, framed};
use crate::link::{Address, Line, open_line};
use crate::unit::{Event, GestureUnit};

/// How often the unit is asked what it sees.
const LOOK: Duration = Duration::from_millis(100);

/// How long after the last sample the unit is still asked: a hand has left after 350 ms.
const AFTERWARDS: Duration = Duration::from_millis(1_000);

/// Show live what the unit sees of a hand: shapes, movements, what is pointed at, words so far
///
/// ```text
/// $ deictic hand --board qemu --hand leap
/// $ deictic hand --board inside --hand "made-up:1:thumbsup cup drawer"
/// $ deictic hand --hand leap --record spiral.hand
/// $ deictic hand --board serial:/dev/ttyACM0 --record spiral.hand    what the unit's own sensor sends
/// $ deictic hand --hand leap --to serial:/dev/ttyUSB0@115200         on the line to a unit's sensor input
/// ```
///
/// Ends with the sensor, or at Ctrl-C. With --json, one object per look and one per sentence.
#[derive(Args, Clone, Debug)]
#[command(verbatim_doc_comment)]
pub struct Hand {
    /// The unit: serial:PORT@BAUD, tcp:HOST:PORT, qemu, or inside for none at all
    #[arg(long, value_name = "ADDRESS", default_value = "inside")]
    board: Address,
    #[command(flatten)]
    sensing: Sensing,
    #[command(flatten)]
    files: Files,
    /// Write what the sensor sends to this file as well; without --hand, what the unit's own sensor sends
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Write what the sensor sends to this line, serial:PORT@BAUD or tcp:HOST:PORT, and talk to no unit: the line leads to
    /// a unit's sensor input
    #[arg(long, value_name = "LINE", requires = "hand", conflicts_with = "board")]
    to: Option<Line>,
    /// Print JSON lines, for programs
    #[arg(long)]
    json: bool,
}

impl Hand {
    /// Runs the command.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<()> {
        let (lexicon, table) = self.files.read()?;
        let setup = self.sensing.setup(&table, &lexicon)?;
        let mut source = self.sensing.open(&table, &lexicon)?;
        let mut record = Record::open(&self)?;
        let interrupts = interrupts()?;
        // The last thing that was odd about the sensor: the run goes on, and has not gone well.
        let mut odd = None;
        if let Some(line) = &self.to {
            let mut wire = open_line(line)?;
            while let Some(open) = &source
                && !is_over(&interrupts)
            {
                let mut written = Ok(());
                let take = |sample| {
                    record.push(&sample);
                    if written.is_ok() {
                        written = wire.write(&framed(&sample));
                    }
                };
                let more = drain(open, take, |error| {
                    anstream::eprintln!("{}", paint::bad(&error));
                    odd = Some(error);
                });
                written
                    .into_diagnostic()
                    .wrap_err_with(|| format!("{line} takes no more"))?;
                source = source.filter(|_| more);
                std::thread::sleep(Duration::from_millis(2));
            }
            record.finish()?;
            return odd.map_or(Ok(()), |error| Err(error.into()));
        }
        if source.is_none() && matches!(self.board, Address::Inside) {
            return Err(advice(
                "there is no sensor: --board inside has no line for one",
                "name one at this machine with --hand, or a board with one on its sensor line with --board",
            ));
        }
        let configuration = Configuration {
            // Whatever is shown is only looked at.
            expected: 0xff,
            ..Configuration::DEFAULT
        };
        let vocabulary = lexicon.vocabulary();
        let mut unit = GestureUnit::connect(&self.board, vocabulary, table.scene(), configuration)?;
        unit.set_hand(setup.clone())?;
        let has_source = source.is_some();
        if self.record.is_some() && !has_source {
            unit.relay()?;
        }
        let mut screen = Screen::new(self.json, &setup, &table, &lexicon);
        let unknown = setup.unknown(&lexicon);
        // The tabletop's own vocabulary has some that are typed only.
        if self.files.vocabulary.is_some() && !unknown.is_empty() {
            let names = unknown.join(", ");
            screen.say(
                "unknown",
                &format!("nobody can show {names}: teach them (--gestures), or type them"),
            );
        }
        let (mut looked, mut over) = (Instant::now(), Instant::now());
        while !is_over(&interrupts) {
            if let Some(open) = &source {
                let take = |sample| {
                    record.push(&sample);
                    // A unit that cannot be told is lost, which it says itself.
                    drop(unit.sense(&sample));
                };
                let told = |error: SourceError| {
                    screen.say("sensor", &error.to_string());
                    odd = Some(error);
                };
                if !drain(open, take, told) {
                    source = None;
                    over = Instant::now();
                }
            }
            if looked.elapsed() >= LOOK {
                looked = Instant::now();
                drop(unit.ask_hand());
            }
            for event in unit.poll(Duration::from_millis(5)) {
                match event {
                    Event::Hand(view) => screen.show(&view),
                    Event::HandStatistics(statistics) => screen.count(&statistics.samples),
                    Event::Sample(sample) => record.push(&sample),
                    Event::Shown { sentence, .. } => {
                        screen.said(&explain::sentence(&sentence, &lexicon));
                    }
                    Event::Fault(fault) => screen.say("unit", &explain::fault(&fault).what),
                    Event::Lost(loss) => {
                        let lost = explain::loss(&loss);
                        return Err(advice(lost.what, lost.remedy));
                    }
                    _ => {}
                }
            }
            record.check()?;
            if has_source && source.is_none() && over.elapsed() >= AFTERWARDS {
                break;
            }
        }
        record.finish()?;
        odd.map_or(Ok(()), |error| Err(error.into()))
    }
}

fn is_over(interrupts: &AtomicU8) -> bool {
    interrupts.load(Ordering::Relaxed) > 0
}

/// The recording, if one is made.
struct Record {
    recorder: Option<Recorder>,
    broken: Option<SourceError>,
}

impl Record {
    fn open(hand: &Hand) -> Result<Self> {
        let recorder = hand.record.as_deref().map(Recorder::create).transpose()?;
        Ok(Self {
            recorder,
            broken: None,
        })
    }

    fn push(&mut self, sample: &Sample) {
        if let Some(recorder) = &mut self.recorder
            && let Err(error) = recorder.push(sample)
        {
            self.broken = Some(error);
        }
    }

    /// Whether all of it could be written so far.
    fn check(&mut self) -> Result<()> {
        self.broken.take().map_or(Ok(()), |error| Err(error.into()))
    }

    fn finish(mut self) -> Result<()> {
        self.check()?;
        self.recorder
            .map_or(Ok(()), |recorder| Ok(recorder.finish()?))
    }
}
