//! What a robot tells, on the terminal or as JSON lines.

use serde_json::json;

use super::Printer;
use crate::cmd::paint;
use crate::robot::{Event, Refusal};
use crate::session::Order;

impl Printer {
    /// What the robot was told directly; what it does follows.
    pub fn ordered(self, order: Order) {
        self.line("told", format!("the robot to {order}"));
        self.object(&json!({ "event": "ordered", "order": order.to_string() }));
    }

    /// What the robot was told directly and does not do.
    pub fn declined(self, order: Order, refusal: &Refusal) {
        let (what, remedy) = (refusal.to_string(), refusal.remedy());
        self.line("robot", paint::bad(format!("does not {order}: {what}")));
        self.line("", paint::dim(&remedy));
        let order = order.to_string();
        self.object(&json!({ "event": "declined", "order": order, "why": what, "remedy": remedy }));
    }

    pub(super) fn robot(self, event: &Event) {
        match event {
            Event::Begun {
                step, number, of, ..
            } => {
                self.line("robot", format!("{number}/{of} {step}"));
                self.object(&json!({
                    "event": "step", "step": step, "number": number, "of": of,
                }));
            }
            Event::Changed { .. } | Event::Accepted(_) | Event::Refused { .. } => {}
            Event::Held(_) => {
                self.line("robot", paint::ask("is held: resume or stop"));
                self.object(&json!({ "event": "held" }));
            }
            Event::Resumed(_) => {
                self.line("robot", "goes on");
                self.object(&json!({ "event": "resumed" }));
            }
            Event::Done(_) => {
                self.line("robot", paint::good("done"));
                self.object(&json!({ "event": "done" }));
            }
            Event::Stopped { step, .. } => {
                self.line("robot", paint::ask(format!("stopped at: {step}")));
                self.object(&json!({ "event": "stopped", "step": step }));
            }
            Event::Failed { fault, why, .. } => {
                self.line("robot", paint::bad(format!("failed: {why}")));
                let fault = format!("{fault:?}");
                self.object(&json!({ "event": "failed", "fault": fault, "why": why }));
            }
        }
    }
}
