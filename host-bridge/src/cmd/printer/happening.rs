//! What a session tells, on the terminal or as JSON lines.

use deictic_core::decide::Outcome;
use serde_json::json;

use super::{Printer, asking};
use crate::cmd::paint;
use crate::explain::{self, Advice};
use crate::report;
use crate::scene::Tabletop;
use crate::session::Happening;
use crate::vocabulary::Lexicon;

impl Printer {
    /// Something that happened.
    pub fn happening(self, happening: &Happening, table: &Tabletop, lexicon: &Lexicon) {
        match happening {
            Happening::Decided {
                number,
                scene,
                decision,
                heard,
            } => {
                let text = match &decision.outcome {
                    Outcome::Execute(intent) => paint::good(explain::intent(intent, lexicon)),
                    Outcome::Ask(_) => paint::ask("to ask"),
                    Outcome::Repeat => paint::bad("nothing was understood; say and show it again"),
                    Outcome::GiveUp => paint::bad(asking::gives_up(decision, lexicon)),
                };
                self.line("decided", text);
                let report = report::decision(decision, heard.as_ref(), table.scene(), lexicon);
                self.object(&json!({
                    "event": "decided", "number": number, "scene": scene, "decision": report,
                }));
            }
            Happening::Shown { text } => {
                self.line("shown", text);
                self.object(&json!({ "event": "shown", "shown": text }));
            }
            Happening::Reasons(reasons) => {
                let lines = if self.full {
                    reasons.to_string().lines().map(str::to_owned).collect()
                } else {
                    reasons.brief()
                };
                for line in lines {
                    self.line("because", paint::dim(line));
                }
                self.object(&json!({ "event": "because", "why": reasons }));
            }
            Happening::Asked {
                id,
                left,
                question,
                text,
            } => {
                self.line("asks", paint::ask(text));
                let names = question.candidates.iter();
                let names: Vec<_> = names
                    .map(|&c| lexicon.option_name(question.category, c))
                    .collect();
                let category = lexicon.category_name(question.category);
                self.object(&json!({
                    "event": "asked", "id": id, "kind": report::kind(question), "category": category,
                    "options": names, "questions_left": left, "text": text,
                }));
            }
            Happening::Distrusted(distrust) => {
                let advice = explain::distrust(distrust);
                self.advice("not done", "distrusted", &advice);
            }
            Happening::Overruled => {
                self.line("not done", "it was stopped or forbidden meanwhile");
                self.object(&json!({ "event": "overruled" }));
            }
            Happening::Withheld { modalities } => self.withheld(*modalities),
            Happening::Accepted(intent) => {
                self.object(&json!({
                    "event": "accepted", "intent": report::intent(intent, lexicon),
                }));
            }
            Happening::Refused { intent, refusal } => {
                let (what, remedy) = (refusal.to_string(), refusal.remedy());
                self.line("robot", paint::bad(format!("refuses: {what}")));
                self.line("", paint::dim(&remedy));
                self.object(&json!({
                    "event": "refused", "intent": report::intent(intent, lexicon),
                    "why": what, "remedy": remedy,
                }));
            }
            Happening::Homing => {
                self.line("robot", "goes home");
                self.object(&json!({ "event": "homing" }));
            }
            Happening::Declined { order, refusal } => self.declined(*order, refusal),
            Happening::Robot(event) => self.robot(event),
            Happening::Hanging(_) => self.advice(
                "robot",
                "hanging",
                &Advice {
                    what: "the robot has got nowhere for a minute; it was told to stop".into(),
                    remedy: "look at the robot, and say it again".into(),
                },
            ),
            Happening::Table(version) => {
                self.object(&json!({ "event": "table", "version": version }));
            }
            Happening::BadTable(error) => {
                self.advice("table", "bad-table", &explain::scene_error(error));
            }
            Happening::Fault(fault) => self.advice("unit", "fault", &explain::fault(fault)),
            Happening::NoDecision => self.advice(
                "unit",
                "no-decision",
                &Advice {
                    what: "the unit did not decide; a frame may have been lost".into(),
                    remedy: "say it again".into(),
                },
            ),
            Happening::Lost(loss) => self.advice("unit", "lost", &explain::loss(loss)),
            Happening::Back(hello) => {
                self.line("unit", paint::good("is back and knows everything again"));
                self.object(&json!({ "event": "back", "boot": hello.boot }));
            }
            Happening::Dropped(count) => {
                self.line(
                    "dropped",
                    format!("{count} commands that were still to come"),
                );
                self.object(&json!({ "event": "dropped", "count": count }));
            }
        }
    }
}
