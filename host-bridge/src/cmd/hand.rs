//! `deictic hand`: what the unit sees of a hand, live.

use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use deictic_core::gesture::counters::SampleCounters;
use deictic_core::gesture::shape::Shape;
use deictic_core::protocol::hand::HandView;
use deictic_core::protocol::message::Configuration;
use miette::Result;
use serde_json::{Value, json};

use super::files::Files;
use super::sensing::{Sensing, drain};
use super::{advice, paint};
use crate::explain;
use crate::hand::meaning::HandSetup;
use crate::hand::source::recording::Recorder;
use crate::link::Address;
use crate::scene::Tabletop;
use crate::unit::{Event, GestureUnit};
use crate::vocabulary::Lexicon;

/// How often the unit is asked what it sees.
const LOOK: Duration = Duration::from_millis(100);

/// How long after the last sample the unit is still asked: a hand has left after 350 ms.
const AFTERWARDS: Duration = Duration::from_millis(1_000);

/// How wide a bar of probability 1 is.
const WIDTH: usize = 30;

/// Show live what the unit sees of a hand: shapes, movements, what is pointed at, words so far
///
/// ```text
/// $ deictic hand --board qemu --hand leap
/// $ deictic hand --board inside --hand "made-up:1:thumbsup cup drawer"
/// $ deictic hand --board inside --hand leap --record spiral.hand
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
    /// Write what the sensor sends to this file as well
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
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
        let mut recorder = self.record.as_deref().map(Recorder::create).transpose()?;
        let configuration = Configuration {
            // Whatever is shown is only looked at.
            expected: 0xff,
            ..Configuration::DEFAULT
        };
        let vocabulary = lexicon.vocabulary();
        let mut unit = GestureUnit::connect(&self.board, vocabulary, table.scene(), configuration)?;
        unit.set_hand(setup.clone())?;
        let mut screen = Screen {
            json: self.json,
            lines: 0,
            setup: &setup,
            table: &table,
            lexicon: &lexicon,
        };
        let has_source = source.is_some();
        let (mut looked, mut over) = (Instant::now(), Instant::now());
        let mut broken = None;
        loop {
            if let Some(open) = &source {
                let take = |sample| {
                    if let Some(recorder) = &mut recorder
                        && let Err(error) = recorder.push(&sample)
                    {
                        broken = Some(error);
                    }
                    // A unit that cannot be told is lost, which it says itself.
                    drop(unit.sense(&sample));
                };
                if !drain(open, take, |odd| screen.say("sensor", &odd)) {
                    source = None;
                    over = Instant::now();
                }
            }
            if let Some(error) = broken.take() {
                return Err(error.into());
            }
            if looked.elapsed() >= LOOK {
                looked = Instant::now();
                drop(unit.ask_hand());
            }
            for event in unit.poll(Duration::from_millis(5)) {
                match event {
                    Event::Hand(view) => screen.show(&view),
                    Event::HandStatistics(statistics) => screen.count(&statistics.samples),
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
            if has_source && source.is_none() && over.elapsed() >= AFTERWARDS {
                return recorder.map_or(Ok(()), |recorder| Ok(recorder.finish()?));
            }
        }
    }
}

/// What is on the terminal.
struct Screen<'a> {
    json: bool,
    /// How many lines the picture has that is to be drawn over.
    lines: usize,
    setup: &'a HandSetup,
    table: &'a Tabletop,
    lexicon: &'a Lexicon,
}

impl Screen<'_> {
    fn thing(&self, number: u8) -> String {
        let things = self.table.scene().entities();
        things.get(usize::from(number)).map_or_else(
            || format!("thing {number}"),
            |t| self.lexicon.option_name(t.category, t.option),
        )
    }

    fn stroke(&self, number: u8) -> String {
        let names = self.setup.strokes();
        let name = names.get(usize::from(number));
        name.map_or_else(|| format!("gesture {number}"), |n| (*n).to_owned())
    }

    fn words(&self, view: &HandView) -> Vec<String> {
        let words = view.words.iter();
        words
            .map(|w| self.lexicon.option_name(w.category, w.option))
            .collect()
    }

    /// The last look, as JSON or as bars over the picture before.
    fn show(&mut self, view: &HandView) {
        let shapes = Shape::ALL
            .iter()
            .map(|s| s.name().to_owned())
            .zip(view.shapes);
        let shapes: Vec<(String, f32)> = shapes.collect();
        let mut strokes: Vec<_> = view
            .strokes
            .iter()
            .map(|g| (self.stroke(g.number), g.p))
            .collect();
        strokes.push(("no gesture".to_owned(), view.no_stroke));
        let mut pointed: Vec<_> = view
            .pointed
            .iter()
            .map(|g| (self.thing(g.number), g.p))
            .collect();
        pointed.push(("nothing".to_owned(), view.nothing));
        if self.json {
            let object = |list: &[(String, f32)]| -> Value {
                list.iter()
                    .map(|(name, p)| (name.clone(), json!(p)))
                    .collect()
            };
            let shown = view.shown.and_then(|s| Shape::ALL.get(usize::from(s)));
            let line = json!({
                "event": "hand", "hand": view.hand.map(|side| format!("{side:?}").to_lowercase()),
                "shapes": object(&shapes), "shown": shown.map(|s| s.name()),
                "movement": object(&strokes), "pointed": object(&pointed),
                "words": self.words(view),
            });
            anstream::println!("{line}");
            return;
        }
        if !std::io::stdout().is_terminal() {
            return;
        }
        let mut picture = vec![match view.hand {
            Some(side) => format!("{side:?} hand"),
            None => "no hand".to_owned(),
        }];
        for (title, list) in [
            ("shape", shapes),
            ("movement", strokes),
            ("points at", pointed),
        ] {
            picture.push(paint::dim(title).to_string());
            picture.extend(list.iter().map(|(name, p)| bar(name, *p)));
        }
        picture.push(format!(
            "{} {}",
            paint::dim("words so far"),
            self.words(view).join(" ")
        ));
        self.erase();
        for line in &picture {
            anstream::println!("{line}");
        }
        self.lines = picture.len();
    }

    /// Goes back to where the picture began.
    fn erase(&mut self) {
        if self.lines > 0 {
            anstream::print!("\x1b[{}A\x1b[J", self.lines);
            let _ = std::io::stdout().flush();
            self.lines = 0;
        }
    }

    fn said(&mut self, text: &str) {
        self.erase();
        if self.json {
            anstream::println!("{}", json!({ "event": "shown", "shown": text }));
        } else {
            anstream::println!("{} {}", paint::dim("shown   "), paint::good(text));
        }
    }

    fn say(&mut self, about: &str, text: &str) {
        self.erase();
        if self.json {
            anstream::println!("{}", json!({ "event": about, "why": text }));
        } else {
            anstream::println!("{} {}", paint::dim(format!("{about:<8}")), paint::bad(text));
        }
    }

    fn count(&self, samples: &SampleCounters) {
        if self.json {
            anstream::println!("{}", json!({ "event": "samples", "samples": samples }));
        }
    }
}

fn bar(name: &str, p: f32) -> String {
    let full = (p.clamp(0.0, 1.0) * WIDTH as f32).round() as usize;
    format!(
        "  {name:<16} {:<WIDTH$} {:>3.0} %",
        "█".repeat(full),
        100.0 * p
    )
}
