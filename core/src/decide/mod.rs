//! From likelihoods to one of three outcomes: execute, ask or repeat (the paper, Decision over the
//! actions for interaction mode; METHOD, section 4).

mod doubt;
mod room;

use heapless::Vec;

pub use crate::decision::{CANDIDATES, Decision, FEASIBLE, Kind, Outcome, Question, Reason};

use crate::category::Category;
use crate::profile::Profile;
use crate::scene::Scene;
use crate::trace::Trace;
use crate::vocabulary::Vocabulary;
use doubt::Doubt;
use room::Room;

/// The outcome of a filled trace.
pub fn decide<const N: usize, const C: usize, const F: usize, const E: usize>(
    vocabulary: &Vocabulary<N, C, F>,
    scene: &Scene<E, F>,
    profile: &Profile,
    trace: &Trace<C, N>,
) -> Decision<C> {
    let room = Room {
        vocabulary,
        scene,
        profile,
        trace,
    };
    let Some(action) = room.action().judgement.best else {
        return Decision {
            outcome: without_action(trace),
            best: None,
        };
    };
    let best = room.intent(action);
    // Each made where it stays: an outcome that is moved into its decision costs 400 instructions.
    match room.doubt(&best) {
        Doubt::None => Decision {
            outcome: Outcome::Execute(best.clone()),
            best: Some(best),
        },
        Doubt::Ask(question) => Decision {
            outcome: Outcome::Ask(question),
            best: Some(best),
        },
        Doubt::Everything => Decision {
            outcome: Outcome::Repeat,
            best: Some(best),
        },
    }
}

/// No action word: with parameters the action is asked for, without anything a repetition.
fn without_action<const N: usize, const C: usize>(trace: &Trace<C, N>) -> Outcome<C> {
    if trace
        .categories()
        .iter()
        .all(|word| word.judgement.best.is_none())
    {
        return Outcome::Repeat;
    }
    Outcome::Ask(Question {
        kind: Kind::Which,
        action: None,
        category: Category::ACTION,
        reason: Reason::Missing,
        candidates: Vec::new(),
    })
}
