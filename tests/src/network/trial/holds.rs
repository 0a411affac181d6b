//! What must hold of a session whatever goes wrong.

use std::time::Duration;

use deictic::link::Wire;
use deictic::robot::Event;
use deictic::session::Happening;
use deictic::unit::UNIT_LOST;
use deictic_core::decide::Outcome;
use deictic_core::time::Micros;

use super::{End, Trial};
use crate::network::around::Around;

impl<A: Around + Wire + Clone + Send + 'static> Trial<'_, A> {
    /// The robot's time is the session's, which began after the world's.
    pub(super) fn robot_now(&self) -> Micros {
        Micros(self.world.now().since(self.began).0)
    }

    /// A stop stops at once.
    pub(super) fn check_still(&self) {
        let moment = self.robot_now();
        assert!(
            !self.robot.seen().is_moving(moment),
            "it moves after a stop"
        );
    }

    /// Nothing moves for longer than the bound after the unit was heard last.
    pub(super) fn check_motion(&mut self) {
        let moment = self.robot_now();
        if !self.robot.seen().is_moving(moment) {
            return;
        }
        let alone = self.world.now().since(self.world.heard());
        self.account.alone = self.account.alone.max(alone);
        // The bridge finds the silence out in the turn in which it becomes too long.
        let bound = UNIT_LOST + self.late;
        assert!(
            Duration::from_micros(alone.0) <= bound,
            "it moves {} ms after the unit was heard last",
            alone.0 / 1000
        );
    }

    /// Everything the robot began is something the unit told, on the scene that was there, and each of them once.
    pub(super) fn check_robot(&mut self) {
        let seen = self.robot.seen();
        assert!(
            seen.nothing_twice(),
            "something was begun twice: {:#?}",
            seen.begun
        );
        for (command, _) in &seen.begun[self.watched..] {
            // Each decision can be carried out once.
            assert!(
                self.world.redeem(command.scene, &command.intent),
                "nobody told it to: {command:#?}"
            );
        }
        self.watched = seen.begun.len();
    }

    /// How the command ended, by all that happened since it was given.
    pub(super) fn end(&self, given: bool, stopped: bool) -> End {
        let count = |is: fn(&Happening) -> bool| self.happened.iter().filter(|h| is(h)).count();
        let begun = count(|h| matches!(h, Happening::Accepted(_)));
        let done = count(|h| matches!(h, Happening::Robot(Event::Done(_))));
        let halted = count(|h| matches!(h, Happening::Robot(Event::Stopped { .. })));
        let failed = count(|h| matches!(h, Happening::Robot(Event::Failed { .. })));
        let refused = count(|h| matches!(h, Happening::Refused { .. } | Happening::Fault(_)));
        let distrusted = count(|h| matches!(h, Happening::Distrusted(_)));
        let asked = count(|h| match h {
            Happening::Decided { decision, .. } => !matches!(decision.outcome, Outcome::Execute(_)),
            _ => false,
        });
        let overruled = count(|h| matches!(h, Happening::Overruled));
        let lost = count(|h| matches!(h, Happening::Lost(_) | Happening::NoDecision));
        assert_eq!(
            begun,
            done + halted + failed,
            "what is begun ends once: {:#?}",
            self.happened
        );
        match () {
            () if halted > 0 => End::Stopped,
            () if failed > 0 => End::Lost,
            () if done > 0 && (!stopped || begun > 1) => End::Done,
            () if stopped || overruled > 0 => End::Stopped,
            () if asked > 0 => End::Asked,
            () if refused > 0 || distrusted > 0 => End::Refused,
            () if lost > 0 || !given => End::Lost,
            () => panic!("a command has come to nothing: {:#?}", self.happened),
        }
    }
}
