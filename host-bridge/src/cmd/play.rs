//! `deictic play`: a script of commands on a unit, with a robot that does them.

mod summary;

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use deictic_core::protocol::message::Configuration;
use deictic_core::time::Micros;
use miette::Result;
use serde_json::json;

use self::summary::{Row, summarise};
use super::advice;
use super::conversation::Conversation;
use super::files::Files;
use super::log::Log;
use super::pictures::{Draw, Pictures};
use super::printer::Printer;
use super::profile::Choice;
use super::sensing::{Sensing, drain};
use super::trust::Trust;
use crate::explain;
use crate::hand::source::{Address as Sensor, Source};
use crate::language::Listener;
use crate::link::Address;
use crate::robot::address::reach;
use crate::robot::{self, Event};
use crate::script::{Script, Turn};
use crate::sensor::Sensors;
use crate::session::{Happening, Session};

/// Play a script of commands: what was said and shown, what the unit decided and why, what the robot
/// did
#[derive(Args, Clone, Debug)]
pub struct Play {
    /// The script (TOML); without it the tabletop session that comes with the program
    script: Option<PathBuf>,
    /// The unit: serial:PORT@BAUD, tcp:HOST:PORT, can:INTERFACE, slcan:PORT, qemu, or inside for none
    #[arg(long, value_name = "ADDRESS", default_value = "inside")]
    board: Address,
    /// The robot: sim, can:INTERFACE, can:INTERFACE,fd, slcan:PORT, serial:PORT@BAUD, tcp:HOST:PORT, or
    /// fci:HOST[,no-realtime] for a Panda or Research 3 on its own interface
    #[arg(long, value_name = "ADDRESS", default_value_t = robot::address::Address::Sim)]
    robot: robot::address::Address,
    /// How many times as fast as a careful arm the simulated one moves
    #[arg(long, default_value_t = 8.0, value_parser = super::haste, allow_negative_numbers = true)]
    haste: f32,
    #[command(flatten)]
    trust: Trust,
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    choice: Choice,
    /// Print all figures behind a decision, not only those that count
    #[arg(long)]
    explain: bool,
    #[command(flatten)]
    draw: Draw,
    /// Write what became of each command to the end of this file, as lines of JSON
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// Print JSON lines, for programs
    #[arg(long)]
    json: bool,
}

impl Play {
    /// Runs the command.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<()> {
        let (lexicon, table) = self.files.read()?;
        let script = match &self.script {
            Some(path) => Script::read(path)?,
            None => Script::demo()?,
        };
        let mut listener = Listener::new(&lexicon).map_err(|e| advice(&e, e.remedy()))?;
        listener.uncertainty = self.choice.uncertainty();
        let mut whole = listener.clone();
        whole.uncertainty = self.choice.joint().uncertainty();
        let configuration = Configuration {
            profile: self.choice.profile(),
            // Nobody has to find the time to point: what is shown comes with what is said.
            window: Micros::from_millis(300),
            explain: true,
            ..Configuration::DEFAULT
        };
        let opener = self.trust.opener(&self.board, &self.robot)?;
        let robot_key = self.trust.robot_key(&self.robot)?;
        let robot = reach(&self.robot, &lexicon, self.haste, robot_key.as_ref())?;
        let mut session = Session::open(opener, robot, table, &lexicon, configuration)?;
        let printer = Printer {
            json: self.json,
            full: self.explain,
        };
        let mut pictures = self.draw.open()?;
        let mut log = Log::open(self.log.as_deref())?;
        let setup = Sensing::default().setup(session.table(), &lexicon)?;
        // A unit that cannot be told is lost, which the session tells.
        let _ = session.set_hand(setup);
        printer.greet(&self.board, &session);
        let mut conversation = Conversation::new(&listener, printer);
        let mut rows = Vec::new();
        for (i, turn) in script.turns.iter().enumerate() {
            let (number, of) = (i + 1, script.turns.len());
            printer.title(&format!("{number}/{of} {}: {}", turn.kind, turn.note));
            printer.object(&json!({
                "event": "turn", "number": number, "of": of, "kind": turn.kind, "note": turn.note,
            }));
            let (choice, listener) = match turn.joint {
                true => (self.choice.joint(), &whole),
                false => (self.choice, &listener),
            };
            // A unit that cannot be told is lost, which the session tells.
            let _ = session.decide_by(choice.profile());
            conversation.listen_by(listener);
            let made_up = turn.noise.map(|n| Sensors::new(&lexicon, n, turn.seed));
            conversation.observe_by(&mut session, made_up);
            rows.push(play(
                turn,
                &mut session,
                &mut conversation,
                printer,
                &mut pictures,
                &mut log,
            )?);
        }
        printer.object(&json!({ "event": "summary", "rows": rows }));
        if !self.json {
            summarise(&rows);
        }
        Ok(())
    }
}

/// Plays one command to its end.
fn play(
    turn: &Turn,
    session: &mut Session<'_>,
    conversation: &mut Conversation<'_>,
    printer: Printer,
    pictures: &mut Pictures,
    log: &mut Log,
) -> Result<Row> {
    let text = |text: &Option<String>| text.clone().unwrap_or_else(|| "-".to_owned());
    let noise = turn.noise.map(|noise| format!(" ({noise:?})"));
    let mut row = Row {
        kind: turn.kind.clone() + &noise.unwrap_or_default().to_lowercase(),
        said: text(&turn.said),
        shown: text(&turn.hand.as_ref().or(turn.shown.as_ref()).cloned()),
        robot: "stands still".to_owned(),
        ..Row::default()
    };
    let mut hand = match &turn.hand {
        Some(acts) => {
            let made_up = Sensor::MadeUp {
                seed: turn.seed,
                acts: acts.clone(),
            };
            Some(Source::open(&made_up, session.table(), session.lexicon())?)
        }
        None => None,
    };
    // Who uses the hand speaks while it is shown.
    let mut speaks = hand.is_some();
    if !speaks {
        conversation.take(session, turn.said.as_deref(), turn.shown.as_deref());
    }
    let mut answer = turn.answer.as_deref();
    loop {
        pictures.turn(session);
        let take = |sample| drop(session.sense(&sample));
        if hand
            .as_ref()
            .is_some_and(|hand| !drain(hand, take, |odd| printer.odd(&odd)))
        {
            hand = None;
        }
        if speaks && (session.is_showing() || hand.is_none()) {
            speaks = false;
            conversation.take(session, turn.said.as_deref(), None);
        }
        for happening in session.turn(Duration::from_millis(10)) {
            printer.happening(&happening, session.table(), session.lexicon());
            pictures.happening(&happening, session)?;
            log.hear(&happening, session.lexicon())?;
            row.take(&happening, session);
            match happening {
                Happening::Lost(loss) => {
                    let lost = explain::loss(&loss);
                    return Err(advice(lost.what, lost.remedy));
                }
                Happening::Robot(Event::Begun { number, .. }) if turn.stop_at == Some(number) => {
                    conversation.line(session, b"stop");
                }
                _ => {}
            }
        }
        // What comes next is not to be taken for a part of what was forbidden.
        if !session.is_idle() || session.is_showing() || hand.is_some() || session.forbids() {
            continue;
        }
        let asked = session.question().is_some();
        match answer.take() {
            Some(answer) if asked => {
                // An answer is clear: nobody gives one in a noisy room without being heard.
                conversation.answer_clearly();
                conversation.take(session, Some(answer), None);
            }
            _ => {
                if asked {
                    session.stop();
                }
                return Ok(row);
            }
        }
    }
}
