//! What each message of a host does to a unit.

use super::HEARTBEAT;
use super::Unit;
use crate::protocol::message::{
    Configuration, Fault, Hello, Loaded, Proof, RobotState, SensorPart, ToHost, ToUnit,
};
use crate::protocol::{SCHEMA, VERSION};
use crate::time::Micros;

impl<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
    const FRAME: usize,
    const OUT: usize,
    const S: usize,
> Unit<N, C, F, E, W, FRAME, OUT, S>
{
    #[inline(never)]
    pub(super) fn take(&mut self, now: Micros, message: &ToUnit<N, C, F>) {
        if let ToUnit::Hello(host) = message {
            self.greet(now, host);
            return;
        }
        if let ToUnit::Prove(proof) = message {
            self.take_proof(now, proof);
            return;
        }
        if !self.open {
            // Only a Hello is sure to be taken by a host that goes by an earlier start's numbers.
            self.introduce();
            self.fault(Fault::NoHello);
            return;
        }
        let result = match message {
            ToUnit::Hello(_) | ToUnit::Heartbeat(_) | ToUnit::Prove(_) => Ok(()),
            ToUnit::Vocabulary(part) => self.loading.take_vocabulary(part).map(|done| {
                self.pairing.clear();
                self.sensing.clear();
                self.hand.unlearn_meanings();
                self.loaded(done);
            }),
            ToUnit::Scene(part) => self.loading.take_scene(part).map(|done| self.loaded(done)),
            ToUnit::Configure(configuration) => self.configure(configuration),
            ToUnit::Sentence(part) => self.pairing.take(part),
            ToUnit::Robot(status) => {
                self.moving = matches!(status.state, RobotState::Running(_));
                Ok(())
            }
            ToUnit::Answer(answer) => self.take_answer(now, answer),
            ToUnit::AskStatistics => {
                self.send(&ToHost::Statistics(self.statistics()));
                Ok(())
            }
            ToUnit::Sample(bytes) => {
                self.hand.keep_sample(bytes);
                Ok(())
            }
            ToUnit::Meanings(meanings) => self.take_meanings(meanings),
            ToUnit::Hand(settings) => self.take_hand_settings(settings),
            ToUnit::Sensor(part) => self.take_sensor(part),
            ToUnit::Templates(part) => self.hand.take_templates(part).map(|done| self.loaded(done)),
            ToUnit::AskHand => {
                self.tell_hand();
                Ok(())
            }
            ToUnit::Relay(relays) => {
                self.hand.relays = *relays;
                Ok(())
            }
            ToUnit::Forbid(modality) => self.forbid(now, *modality),
        };
        if let Err(fault) = result {
            self.fault(fault);
        }
    }

    /// Opens a conversation: everything of an earlier one is forgotten.
    fn greet(&mut self, now: Micros, host: &Hello) {
        self.outbox.abandon();
        self.loading.clear();
        self.sensing.clear();
        self.pairing.forget();
        self.hand.clear();
        self.configuration = Configuration::DEFAULT;
        self.moving = false;
        self.open = (host.version, host.schema) == (VERSION, SCHEMA);
        self.beat = now.after(HEARTBEAT);
        self.link.shut();
        self.introduce();
        if self.open {
            if let Some(nonce) = self.trust.challenge(&self.link) {
                // Nothing else is taken until the proof has come.
                self.open = false;
                self.send(&ToHost::Challenge(nonce));
            }
        } else {
            self.fault(Fault::Schema {
                unit: (VERSION, SCHEMA),
                host: (host.version, host.schema),
            });
        }
    }

    #[inline(never)]
    fn take_proof(&mut self, now: Micros, proof: &Proof) {
        if !self.trust.accepts(&mut self.link, proof) {
            self.fault(Fault::NotProven);
            return;
        }
        self.open = true;
        self.heard = now;
        self.send(&ToHost::Proven);
    }

    fn introduce(&mut self) {
        self.send(&ToHost::Hello(Hello {
            version: VERSION,
            schema: SCHEMA,
            boot: self.trust.boot,
            capacities: Self::capacities(),
        }));
    }

    fn configure(&mut self, configuration: &Configuration) -> Result<(), Fault> {
        configuration
            .profile
            .check()
            .map_err(Fault::Configuration)?;
        self.configuration = *configuration;
        self.loaded(Some(Loaded::Configuration));
        Ok(())
    }

    fn take_sensor(&mut self, part: &SensorPart<N>) -> Result<(), Fault> {
        let vocabulary = self.loading.vocabulary().ok_or(Fault::NoVocabulary)?;
        let done = self.sensing.take(part, vocabulary)?;
        self.loaded(done);
        Ok(())
    }

    pub(super) fn loaded(&mut self, what: Option<Loaded>) {
        if let Some(what) = what {
            self.send(&ToHost::Loaded(what));
        }
    }
}
