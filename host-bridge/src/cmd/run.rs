//! `deictic run`: a unit, a robot, and a person who types.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Args;
use deictic_core::protocol::message::Configuration;
use deictic_core::time::Micros;
use miette::Result;

use super::conversation::{Conversation, Ending};
use super::ears::Speech;
use super::files::Files;
use super::interrupts::interrupts;
use super::lines::{Lines, Typed};
use super::log::Log;
use super::pictures::Draw;
use super::printer::Printer;
use super::profile::Choice;
use super::scenes::Scenes;
use super::sensing::{Sensing, drain};
use super::trust::Trust;
use super::{advice, paint};
use crate::language::Listener;
use crate::language::speech::{Expected, Heard};
use crate::link::Address;
use crate::robot::{self, address::reach};
use crate::scene::SceneLine;
use crate::sensor::{Noise, Sensors};
use crate::session::{Order, Session};

/// How long one turn waits for the unit: a typed stop is at the robot within this.
const TURN: Duration = Duration::from_millis(10);

/// Run a session: what is said and shown goes to the unit, what it decides is done by the robot
///
/// ```text
/// $ deictic run --board qemu
/// > pick the can                     said
/// > // pick can                      shown
/// > put it there // put-into drawer  said and shown
/// > stop
/// ```
///
/// With --speech, a person speaks, and what the hand shows meanwhile is typed, or comes from another
/// program, as `// pick can`.
///
/// Without --say and --show, lines are read from standard input until its end or `quit`. What is
/// shown is typed as in `deictic decide --show`. With them, one command is given; the exit code is 0
/// when it was done and 2 when it was not.
#[derive(Args, Clone, Debug)]
#[command(verbatim_doc_comment)]
pub struct Run {
    /// The unit: serial:PORT@BAUD, tcp:HOST:PORT, can:INTERFACE, slcan:PORT, qemu, or inside for none
    #[arg(long, value_name = "ADDRESS")]
    board: Address,
    /// The robot: sim, can:INTERFACE, can:INTERFACE,fd, slcan:PORT, serial:PORT@BAUD, tcp:HOST:PORT, or
    /// fci:HOST[,no-realtime] for a Panda or Research 3 on its own interface
    #[arg(long, value_name = "ADDRESS", default_value_t = robot::address::Address::Sim)]
    robot: robot::address::Address,
    /// How many times as fast as a careful arm the simulated one moves
    #[arg(long, default_value_t = 1.0, value_parser = super::haste, allow_negative_numbers = true)]
    haste: f32,
    #[command(flatten)]
    trust: Trust,
    #[command(flatten)]
    files: Files,
    /// Read the scene file again whenever it changes
    #[arg(long, requires = "scene")]
    watch: bool,
    /// Take scene changes, as lines of JSON, at this port of this machine; 0 takes a free one.
    /// `deictic scene` speaks to it. Lines that are typed and begin with { are scene changes as well
    #[arg(long, value_name = "PORT")]
    scene_port: Option<u16>,
    /// Say this, and end when it is done
    #[arg(long, value_name = "TEXT")]
    say: Option<String>,
    /// Show this, and end when it is done
    #[arg(long, value_name = "TEXT")]
    show: Option<String>,
    #[command(flatten)]
    speech: Speech,
    #[command(flatten)]
    sensing: Sensing,
    #[command(flatten)]
    choice: Choice,
    /// How long the unit waits for what is shown after it heard what is said, and the other way
    /// round, in milliseconds; 1000, and 3000 with speech, which is heard a while after it was said
    #[arg(long, value_name = "MS", value_parser = clap::value_parser!(u64).range(20..=3_600_000))]
    window: Option<u64>,
    /// Observe what is said and shown through made-up sensors with this much noise
    #[arg(long, value_enum, value_name = "LEVEL")]
    noise: Option<Noise>,
    /// What the noise starts from; the same seed makes the same noise
    #[arg(long, default_value_t = 1, requires = "noise")]
    seed: u64,
    /// Print why the unit decided as it did
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

impl Run {
    /// Runs the command; gives its exit code.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<u8> {
        self.choice.check()?;
        let (lexicon, table) = self.files.read()?;
        let mut listener = Listener::new(&lexicon).map_err(|e| advice(&e, e.remedy()))?;
        listener.uncertainty = self.choice.uncertainty();
        let printer = Printer {
            json: self.json,
            full: true,
        };
        let mut ears = self.speech.open(&lexicon, &mut listener, printer)?;
        let configuration = Configuration {
            profile: self.choice.profile(),
            window: Micros::from_millis(self.window()),
            explain: self.explain,
            ..Configuration::DEFAULT
        };
        let robot_key = self.trust.robot_key(&self.robot)?;
        let robot = reach(&self.robot, &lexicon, self.haste, robot_key.as_ref())?;
        let opener = self.trust.opener(&self.board, &self.robot)?;
        let mut session = Session::open(opener, robot, table, &lexicon, configuration)?;
        let setup = self.sensing.setup(session.table(), &lexicon)?;
        let mut hand = self.sensing.open(session.table(), &lexicon)?;
        // A unit that cannot be told is lost, which the session tells.
        let _ = session.set_hand(setup);
        let interrupts = interrupts()?;
        let mut pictures = self.draw.open()?;
        let mut log = Log::open(self.log.as_deref())?;
        printer.greet(&self.board, &session);
        let mut scenes = Scenes::open(&self.files, self.watch, self.scene_port, printer)?;
        let mut conversation = Conversation::new(&listener, printer);
        let made_up = self.noise.map(|n| Sensors::new(&lexicon, n, self.seed));
        conversation.observe_by(&mut session, made_up);
        let mut lines = None;
        if self.say.is_some() || self.show.is_some() {
            let (say, show) = (self.say.as_deref(), self.show.as_deref());
            match say.filter(|text| show.is_none() && Order::of(text).is_some()) {
                Some(order) => conversation.line(&mut session, order.as_bytes()),
                None => conversation.take(&mut session, say, show),
            }
        } else {
            lines = Some(Lines::of_stdin());
        }
        let once = lines.is_none();
        let mut prompted = false;
        // Why nobody listens any more.
        let mut deaf = None;
        loop {
            if let Some(typed) = &lines {
                match typed.next() {
                    Typed::Line(line) => {
                        prompted = false;
                        if SceneLine::is_meant(&line) {
                            scenes.line(&mut session, &line);
                            continue;
                        }
                        conversation.line(&mut session, &line);
                    }
                    // Whoever speaks need not type.
                    Typed::End if ears.is_some() => lines = None,
                    Typed::End => conversation.quit(),
                    Typed::Nothing => {}
                }
            }
            scenes.turn(&mut session);
            pictures.turn(&session);
            if let Some(open) = &mut ears {
                open.expect(match session.question() {
                    Some(_) => Expected::Answer,
                    None if session.is_moving() => Expected::Underway,
                    None => Expected::Command,
                });
                match open.poll() {
                    Heard::Spoken(spoken) => conversation.spoken(&mut session, spoken),
                    Heard::Nothing(error) => conversation.unheard(&mut session, &error),
                    Heard::Silence => {}
                    Heard::Failed(error) => {
                        ears = None;
                        deaf = Some(advice(&error, error.remedy()));
                        conversation.deaf(&mut session);
                    }
                    Heard::End => {
                        ears = None;
                        conversation.quit();
                    }
                }
            }
            conversation.next(&mut session);
            let take = |sample| drop(session.sense(&sample));
            let odd = |error| {
                printer.odd(&error);
                conversation.fail();
            };
            if hand.as_ref().is_some_and(|hand| !drain(hand, take, odd)) {
                hand = None;
            }
            match interrupts.swap(0, Ordering::Relaxed) {
                0 => {}
                _ if session.is_idle() => conversation.quit(),
                _ => {
                    session.stop();
                    printer.line("stopped", "Ctrl-C again ends the session");
                }
            }
            for happening in session.turn(TURN) {
                conversation.hear(&happening);
                printer.happening(&happening, session.table(), &lexicon);
                pictures.happening(&happening, &session)?;
                log.hear(&happening, &lexicon)?;
            }
            match conversation.ending(&session, once) {
                // What the hand is still to show belongs to it.
                Some(_) if hand.is_some() && deaf.is_none() => {}
                Some(ending) => return deaf.map_or(Ok(exit_code(ending)), Err),
                None if session.is_idle() && !once && !prompted && self.prompts() => {
                    anstream::print!("{} ", paint::dim(">"));
                    let _ = std::io::Write::flush(&mut anstream::stdout());
                    prompted = true;
                }
                None => {}
            }
            // A question is answered from standard input, whoever asked the first command.
            if session.question().is_some() && lines.is_none() && ears.is_none() {
                lines = Some(Lines::of_stdin());
            }
        }
    }

    fn window(&self) -> u64 {
        let usual = if self.speech.is_on() { 3_000 } else { 1_000 };
        self.window.unwrap_or(usual)
    }

    fn prompts(&self) -> bool {
        !self.json && std::io::stdin().is_terminal() && std::io::stdout().is_terminal()
    }
}

fn exit_code(ending: Ending) -> u8 {
    match ending {
        Ending::Done => 0,
        Ending::NotDone => 2,
    }
}
