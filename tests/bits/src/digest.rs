//! FNV-1a, 64 bits, fed 32 bits at a time.

use deictic_core::board;
use deictic_core::decide::Outcome;
use deictic_core::profile::ProfileError;

const PRIME: u64 = 0x0000_0100_0000_01b3;

pub struct Digest(pub u64);

impl Digest {
    fn word(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(PRIME);
    }

    fn float(&mut self, x: f32) {
        self.word(x.to_bits());
    }

    fn floats(&mut self, xs: &[f32]) {
        xs.iter().for_each(|&x| self.float(x));
    }

    fn option(&mut self, option: Option<u8>) {
        self.word(option.map_or(u32::MAX, u32::from));
    }

    fn quantity(&mut self, quantity: Option<f32>) {
        self.word(u32::from(quantity.is_some()));
        self.float(quantity.unwrap_or(0.0));
    }

    fn set(&mut self, set: u64) {
        self.word(set as u32);
        self.word((set >> 32) as u32);
    }

    /// Every figure of a trace.
    pub fn trace(&mut self, trace: &board::Trace) {
        for word in trace.categories() {
            self.float(word.present);
            self.word(u32::from(word.options));
            self.floats(&word.merged);
            self.floats(&word.h);
            self.float(word.entropy);
            self.float(word.threshold);
            self.quantity(word.quantity);
            self.option(word.judgement.best);
            self.float(word.judgement.lead);
            self.set(word.judgement.clear);
            self.set(word.judgement.unclear);
        }
        self.floats(&trace.heard);
        self.floats(&trace.alpha);
        self.floats(&trace.beta);
        self.float(trace.belief.posterior);
        self.float(trace.belief.noise);
        self.float(trace.belief.logit());
    }

    /// All of a decision.
    pub fn decision(&mut self, decision: &Result<board::Decision, ProfileError>) {
        let Ok(decision) = decision else {
            self.word(0xdead);
            return;
        };
        match &decision.outcome {
            Outcome::Execute(intent) => {
                self.word(1);
                self.intent(intent);
            }
            Outcome::Ask(question) => {
                self.word(2);
                self.word(question.kind as u32);
                self.word(question.action.map_or(u32::MAX, u32::from));
                self.word(question.category.index() as u32);
                self.word(question.reason as u32);
                for &candidate in &question.candidates {
                    self.word(u32::from(candidate));
                }
            }
            Outcome::Repeat => self.word(3),
            Outcome::GiveUp => self.word(4),
        }
        match &decision.best {
            Some(intent) => self.intent(intent),
            None => self.word(u32::MAX),
        }
    }

    fn intent(&mut self, intent: &board::Intent) {
        self.word(u32::from(intent.action));
        for parameter in &intent.parameters {
            self.word(parameter.category.index() as u32);
            self.word(u32::from(parameter.option));
            self.quantity(parameter.quantity);
        }
    }
}
