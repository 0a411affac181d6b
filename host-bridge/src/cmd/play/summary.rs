//! What became of each command of a script, in a table.

use deictic_core::decide::{Kind, Outcome};
use serde::Serialize;

use crate::cmd::paint;
use crate::explain;
use crate::robot::Event;
use crate::session::{Happening, Session};

/// A row of the summary.
#[derive(Debug, Default, Serialize)]
pub(super) struct Row {
    pub kind: String,
    pub said: String,
    pub shown: String,
    pub decided: Vec<String>,
    pub robot: String,
}

impl Row {
    /// Notes what became of the command.
    pub fn take(&mut self, happening: &Happening, session: &Session<'_>) {
        match happening {
            Happening::Decided { decision, .. } => self.decided.push(match &decision.outcome {
                Outcome::Execute(intent) => explain::intent(intent, session.lexicon()),
                Outcome::Ask(question) if question.kind == Kind::Confirm => {
                    "asks yes or no".to_owned()
                }
                Outcome::Ask(question) => {
                    format!(
                        "asks which {}",
                        session.lexicon().category_name(question.category)
                    )
                }
                Outcome::Repeat => "asks to repeat".to_owned(),
                Outcome::GiveUp => "gives up".to_owned(),
            }),
            Happening::Distrusted(_)
            | Happening::Overruled
            | Happening::Fault(_)
            | Happening::NoDecision => {
                self.robot = "stands still".to_owned();
            }
            Happening::Refused { refusal, .. } => self.robot = format!("refuses: {refusal}"),
            Happening::Robot(Event::Done(_)) if !self.robot.starts_with("stopped") => {
                self.robot = "done".to_owned();
            }
            Happening::Robot(Event::Stopped { step, .. }) => {
                self.robot = format!("stopped: {step}")
            }
            Happening::Hanging(_) => self.robot = "hangs".to_owned(),
            Happening::Robot(Event::Failed { why, .. }) => self.robot = format!("failed: {why}"),
            _ => {}
        }
    }
}

/// Prints all rows as a table, and what to try next.
pub(super) fn summarise(rows: &[Row]) {
    let head = ["kind", "said", "shown", "decided", "robot"].map(str::to_owned);
    let cells = rows.iter().map(|row| {
        let decided = if row.decided.is_empty() {
            "-".to_owned()
        } else {
            row.decided.join(", then ")
        };
        [&row.kind, &row.said, &row.shown, &decided, &row.robot].map(Clone::clone)
    });
    let lines: Vec<_> = std::iter::once(head).chain(cells).collect();
    let mut widths = [0; 5];
    for line in &lines {
        for (width, cell) in widths.iter_mut().zip(line) {
            *width = cell.chars().count().max(*width);
        }
    }
    anstream::println!();
    for (i, line) in lines.iter().enumerate() {
        let cells = line.iter().zip(widths);
        let text: Vec<_> = cells
            .map(|(cell, width)| format!("{cell:<width$}"))
            .collect();
        let text = text.join("  ");
        if i == 0 {
            anstream::println!("{}", paint::good(text.trim_end()));
        } else {
            anstream::println!("{}", text.trim_end());
        }
    }
    anstream::println!(
        "\nTry next:\n  \
         cargo run -p deictic -- run --board inside     say and show it yourself, without a board\n  \
         cargo xtask qemu                               a board to connect to\n  \
         cargo run -p deictic -- decide --say \"pick the can\" --show \"pick|push can\" --explain"
    );
}
