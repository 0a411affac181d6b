//! How a conversation with a unit is opened: it is greeted, shown the key, and told the vocabulary, the scene and the
//! configuration.

use std::io;
use std::time::Duration;

use deictic_core::large::{self, Scene, ToHost, ToUnit, Vocabulary};
use deictic_core::protocol::message::{
    ACTIONS_PART, Capacities, Configuration, Fault, Hello, Loaded, Proof, VocabularyPart,
};
use deictic_core::protocol::seal::Nonces;
use deictic_core::protocol::{SCHEMA, VERSION};

use super::conversation::{Conversation, small};
use super::{PATIENCE, UnitError};
use crate::clock;

/// How often an unanswered Hello is said again: a board may be in the middle of starting.
const AGAIN: Duration = Duration::from_millis(500);

/// How often loading begins anew at most.
const ATTEMPTS: usize = 3;

impl Conversation {
    /// Opens the conversation and loads everything.
    pub fn load(
        &mut self,
        vocabulary: &Vocabulary,
        scene: &Scene,
        configuration: &Configuration,
    ) -> Result<Hello, UnitError> {
        // A unit that was still starting answers every Hello that was said meanwhile, and each of
        // them empties it.
        for _ in 0..ATTEMPTS {
            self.pending.clear();
            let hello = self.greet()?;
            if !self.prove()? {
                continue;
            }
            check_capacities(&hello.capacities, vocabulary, scene)?;
            self.say_vocabulary(vocabulary)?;
            if !self.is_loaded(Loaded::Vocabulary(vocabulary.fingerprint()))? {
                continue;
            }
            self.say_scene(scene)?;
            if !self.is_loaded(Loaded::Scene(scene.version()))? {
                continue;
            }
            self.say(&ToUnit::Configure(*configuration))?;
            if self.is_loaded(Loaded::Configuration)? {
                return Ok(hello);
            }
        }
        Err(UnitError::NoAnswer)
    }

    fn greet(&mut self) -> Result<Hello, UnitError> {
        let ours = Hello {
            version: VERSION,
            schema: SCHEMA,
            boot: std::process::id(),
            capacities: large::Unit::capacities(),
        };
        self.link.shut();
        // Ends whatever half a frame the unit may have heard of an earlier host.
        self.wire.write(&[0]).map_err(UnitError::Broken)?;
        let until = clock::now() + PATIENCE;
        while clock::now() < until {
            self.say(&ToUnit::Hello(ours))?;
            let again = clock::now() + AGAIN;
            while let Some(left) = clock::until(again) {
                let mut heard = self.hear(left)?.into_iter();
                while let Some((message, _)) = heard.next() {
                    if let ToHost::Hello(theirs) = message {
                        let (unit, host) = ((theirs.version, theirs.schema), (VERSION, SCHEMA));
                        if unit != host {
                            return Err(UnitError::Schema { unit, host });
                        }
                        // A unit that was late answers all that was asked at once: nothing was loaded in between.
                        let further = heard.filter(|(m, _)| !matches!(m, ToHost::Hello(_)));
                        self.pending = further.collect();
                        return Ok(theirs);
                    }
                }
            }
        }
        Err(UnitError::NoAnswer)
    }

    /// Shows the unit that this end has the key, and has it show the same; nothing to do without one. `false` when it
    /// began anew instead.
    fn prove(&mut self) -> Result<bool, UnitError> {
        let Some(mut key) = self.link.key().cloned() else {
            let is_challenge = |(m, _): &(ToHost, u16)| matches!(m, ToHost::Challenge(_));
            return match self.pending.iter().any(is_challenge) {
                true => Err(UnitError::WantsKey),
                false => Ok(true),
            };
        };
        let until = clock::now() + PATIENCE;
        let mut asked = false;
        while let Some(left) = clock::until(until) {
            for (message, _) in self.hear(left.min(AGAIN))? {
                match message {
                    ToHost::Hello(_) => return Ok(false),
                    ToHost::Challenge(unit) if !asked => {
                        asked = true;
                        let host = getrandom::u64().map_err(|e| {
                            UnitError::Broken(io::Error::other(format!("no random numbers: {e}")))
                        })?;
                        let nonces = Nonces { unit, host };
                        let proof = key.proof(nonces);
                        self.say(&ToUnit::Prove(Proof { nonce: host, proof }))?;
                        self.link.seal(nonces);
                    }
                    ToHost::Proven => return Ok(true),
                    _ => {}
                }
            }
        }
        Err(if asked {
            UnitError::OtherKey
        } else {
            UnitError::NoKey
        })
    }

    fn say_vocabulary(&mut self, vocabulary: &Vocabulary) -> Result<(), UnitError> {
        let actions = vocabulary.actions();
        for (i, part) in actions.chunks(ACTIONS_PART).enumerate() {
            self.say(&ToUnit::Vocabulary(VocabularyPart {
                fingerprint: vocabulary.fingerprint(),
                parameters: vocabulary.options().iter().skip(1).copied().collect(),
                features: small(vocabulary.features()),
                stop: vocabulary.stop(),
                total: small(actions.len()),
                first: small(i * ACTIONS_PART),
                actions: part.iter().copied().collect(),
            }))?;
        }
        Ok(())
    }

    /// Waits for the unit to have taken something over; keeps what else it says for later. `false`
    /// when it opened the conversation anew instead, or did not answer.
    fn is_loaded(&mut self, what: Loaded) -> Result<bool, UnitError> {
        let until = clock::now() + PATIENCE;
        let mut others = std::mem::take(&mut self.pending);
        while let Some(left) = clock::until(until) {
            let mut heard = self.hear(left.min(AGAIN))?.into_iter();
            while let Some((message, missed)) = heard.next() {
                match message {
                    ToHost::Loaded(loaded) if loaded == what => {
                        others.extend(heard);
                        self.pending = others;
                        return Ok(true);
                    }
                    ToHost::Fault(fault) if refuses(&fault, what) => {
                        return Err(UnitError::Refused(fault));
                    }
                    ToHost::Hello(_) => return Ok(false),
                    ToHost::Challenge(_) => return Err(UnitError::WantsKey),
                    other => others.push((other, missed)),
                }
            }
        }
        Ok(false)
    }
}

/// Whether a fault is about what is being loaded, and not about a sentence said before.
fn refuses(fault: &Fault, what: Loaded) -> bool {
    match fault {
        Fault::Vocabulary(_) => matches!(what, Loaded::Vocabulary(_)),
        Fault::Scene(_) | Fault::OldScene { .. } => matches!(what, Loaded::Scene(_)),
        Fault::Configuration(_) => what == Loaded::Configuration,
        Fault::PartOutOfOrder { .. } => what != Loaded::Configuration,
        Fault::NoHello | Fault::NoVocabulary | Fault::HostLost => true,
        _ => false,
    }
}

fn check_capacities(
    unit: &Capacities,
    vocabulary: &Vocabulary,
    scene: &Scene,
) -> Result<(), UnitError> {
    let most = vocabulary.options().iter().copied().max().unwrap_or(0);
    for (what, capacity, wanted) in [
        ("options in a category", unit.options, usize::from(most)),
        ("categories", unit.categories, vocabulary.options().len()),
        ("features", unit.features, vocabulary.features()),
        ("things in a scene", unit.entities, scene.entities().len()),
    ] {
        if wanted > usize::from(capacity) {
            return Err(UnitError::TooLarge {
                what,
                capacity,
                wanted,
            });
        }
    }
    Ok(())
}
