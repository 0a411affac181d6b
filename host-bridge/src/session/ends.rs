//! How a session takes it that a command has ended, or never does.

use deictic_core::protocol::message::{RobotState, RobotStatus};

use super::{HANGING, Happening, Session};
use crate::clock;
use crate::robot::CommandId;

impl Session<'_> {
    /// Stops a robot that has got nowhere for too long; its command has failed.
    pub(super) fn give_up_on_hanging(&mut self) {
        let now = self.now();
        let percent = self.robot.progress(now).map(|(_, percent)| percent);
        let Some(doing) = &mut self.doing else {
            return;
        };
        if percent.is_some_and(|percent| percent != doing.percent) {
            doing.percent = percent.unwrap_or_default();
            doing.heard = clock::now();
        }
        if doing.held {
            doing.heard = clock::now();
        }
        if clock::since(doing.heard) < HANGING {
            return;
        }
        let id = doing.id;
        self.overtaken.clear();
        self.robot.stop(now);
        self.happened.push(Happening::Hanging(id));
        self.over(id, RobotState::Failed);
    }

    pub(super) fn over(&mut self, id: CommandId, state: RobotState) {
        let overtaken = self.overtaken.iter().position(|d| d.id == id);
        let overtaken = overtaken.map(|at| self.overtaken.remove(at));
        if let Some(doing) = overtaken.or_else(|| self.doing.take_if(|d| d.id == id)) {
            if state != RobotState::Done {
                self.drop_queue();
            }
            if let Some(source) = doing.source {
                self.report(source.decision, state);
            }
        }
    }

    pub(super) fn report(&mut self, decision: u32, state: RobotState) {
        // A unit that is not there has nothing to do with this command any more.
        let _ = self.unit.report(RobotStatus { decision, state });
    }
}
