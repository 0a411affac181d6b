//! The same decision made here and by a unit.

use std::time::{Duration, Instant};

use deictic_core::fuse::{Situation, fuse};
use deictic_core::joint::Tables;
use deictic_core::large::{Decision, Observations, Sentence, Trace};
use deictic_core::protocol::message::Configuration;
use miette::Result;

use crate::cmd::advice;
use crate::explain::{self, Advice};
use crate::scene::Tabletop;
use crate::unit::{Event, GestureUnit};
use crate::vocabulary::Lexicon;

/// What this host decides.
pub fn decide_here(
    lexicon: &Lexicon,
    table: &Tabletop,
    sentences: &[Sentence],
    configuration: &Configuration,
    sensors: Tables<'_>,
) -> Result<Decision> {
    let refused = |what: Advice| advice(what.what, what.remedy);
    let mut observations = Observations::new();
    for sentence in sentences {
        let inserted = observations.insert(sentence.clone(), lexicon.vocabulary());
        inserted.map_err(|e| refused(explain::sentence_error(&e)))?;
    }
    let situation = Situation {
        vocabulary: lexicon.vocabulary(),
        scene: table.scene(),
        observations: &observations,
        sensors,
    };
    fuse(
        situation,
        &configuration.profile,
        &mut Box::new(Trace::new()),
    )
    .map_err(|e| refused(explain::profile_error(&e)))
}

/// What a unit decides.
pub fn decide_there(unit: &mut GestureUnit, sentences: [Sentence; 2]) -> Result<Decision> {
    unit.observe(&sentences)?;
    let patience = Instant::now() + Duration::from_secs(20);
    while Instant::now() < patience {
        for event in unit.poll(Duration::from_millis(200)) {
            match event {
                Event::Decision {
                    decided,
                    trust: Ok(()),
                } => return Ok(decided.decision),
                Event::Decision {
                    trust: Err(distrust),
                    ..
                } => {
                    let Advice { what, remedy } = explain::distrust(&distrust);
                    return Err(advice(
                        format!("a decision cannot be trusted: {what}"),
                        remedy,
                    ));
                }
                Event::Fault(fault) => {
                    let Advice { what, remedy } = explain::fault(&fault);
                    return Err(advice(what, remedy));
                }
                Event::Lost(loss) => {
                    let Advice { what, remedy } = explain::loss(&loss);
                    return Err(advice(what, remedy));
                }
                _ => {}
            }
        }
    }
    Err(advice(
        "the unit did not decide in time",
        "look at its log with `cargo xtask qemu`",
    ))
}
