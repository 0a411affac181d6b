//! What the terminal shows of what a unit sees.

use std::io::{IsTerminal, Write};

use deictic_core::gesture::counters::SampleCounters;
use deictic_core::gesture::shape::Shape;
use deictic_core::protocol::hand::HandView;
use serde_json::{Value, json};

use crate::cmd::{json, paint};
use crate::hand::meaning::HandSetup;
use crate::scene::Tabletop;
use crate::vocabulary::Lexicon;

/// How wide a bar of probability 1 is.
const WIDTH: usize = 30;

/// What is on the terminal.
pub(super) struct Screen<'a> {
    json: bool,
    /// How many lines the picture has that is to be drawn over.
    lines: usize,
    setup: &'a HandSetup,
    table: &'a Tabletop,
    lexicon: &'a Lexicon,
}

impl<'a> Screen<'a> {
    /// Nothing is on it yet; `json` for programs.
    pub(super) fn new(
        json: bool,
        setup: &'a HandSetup,
        table: &'a Tabletop,
        lexicon: &'a Lexicon,
    ) -> Self {
        Self {
            json,
            lines: 0,
            setup,
            table,
            lexicon,
        }
    }

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
    pub(super) fn show(&mut self, view: &HandView) {
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
            json::print(&line);
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

    pub(super) fn said(&mut self, text: &str) {
        self.erase();
        if self.json {
            anstream::println!("{}", json!({ "event": "shown", "shown": text }));
        } else {
            anstream::println!("{} {}", paint::dim("shown   "), paint::good(text));
        }
    }

    pub(super) fn say(&mut self, about: &str, text: &str) {
        self.erase();
        if self.json {
            anstream::println!("{}", json!({ "event": about, "why": text }));
        } else {
            anstream::println!("{} {}", paint::dim(format!("{about:<8}")), paint::bad(text));
        }
    }

    pub(super) fn count(&self, samples: &SampleCounters) {
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
