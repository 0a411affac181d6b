//! The unit's own eyes: samples of a hand sensor, from its serial line or through the host, become
//! the gesture sentence, which is then treated as one that the host says.

use heapless::Vec;

use super::Unit;
use super::hand::{Hand, Spoken};
use super::pairing::Source;
use crate::category::Category;
use crate::gesture::context::{Context, Event};
use crate::gesture::mapping::{Mapping, STROKES};
use crate::gesture::reader::HandReader;
use crate::gesture::stroke::Likely;
use crate::gesture::wire::{Sample, WireError, decode};
use crate::protocol::hand::{HandFault, HandSettings, HandStatistics, HandView, Meanings};
use crate::protocol::message::{Fault, Loaded, SentencePart, ToHost, WORDS_PART};
use crate::sentence::GESTURE;
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
    /// Takes bytes from the hand sensor's serial line, in pieces of any size.
    pub fn sense(&mut self, now: Micros, bytes: &[u8]) {
        for &byte in bytes {
            self.sense_byte(byte);
            self.settle(now);
        }
    }

    /// Takes a byte of the sensor's, and passes the sample on that it completes, if it is to be.
    #[inline(never)]
    fn sense_byte(&mut self, byte: u8) {
        let Hand {
            line,
            pending,
            reader,
            ..
        } = &mut self.hand;
        match line.take(byte) {
            None => return,
            Some(Err(error)) => return reader.count_error(error),
            Some(Ok(bytes)) => {
                pending.clear();
                // As long as the line's own buffer, in which these were.
                if bytes.is_empty() || pending.extend_from_slice(bytes).is_err() {
                    return reader.count_error(WireError::Length(0));
                }
            }
        }
        if self.hand.relays && self.open {
            self.send(&ToHost::Sample(self.hand.pending.clone()));
        }
    }

    /// Reads the sample that has come, when the message that held it is out of the way: the stack holds one of the two.
    #[inline(never)]
    pub(super) fn take_sample(&mut self, now: Micros) {
        let sample = decode(&self.hand.pending);
        self.hand.pending.clear();
        self.read_hand(now, &sample);
    }

    #[inline(never)]
    fn read_hand(&mut self, now: Micros, sample: &Result<Sample, WireError>) {
        let sample = match sample {
            Ok(sample) => sample,
            Err(error) => return self.hand.reader.count_error(*error),
        };
        self.show(|reader, context| reader.take(now, sample, context));
    }

    /// Takes a movement that a sensor has recognised by itself. What comes of it comes with the next [`Unit::poll`].
    #[inline(never)]
    pub fn recognise(&mut self, likely: &Likely<STROKES>) {
        self.show(|reader, context| reader.recognised(likely, context));
    }

    /// Lets the reader look at something.
    fn show(
        &mut self,
        look: impl FnOnce(&mut HandReader<N, C, W>, &Context<'_, N, C, F, E>) -> Option<Event>,
    ) {
        let (Some(vocabulary), Some(scene), true) =
            (self.loading.vocabulary(), self.loading.scene(), self.open)
        else {
            return self.hand.reader.count_unready();
        };
        let context = Context {
            vocabulary,
            scene,
            mapping: &self.hand.mapping,
            templates: self.hand.taught.templates(),
            mount: &self.hand.settings.mount,
            aim: &self.hand.settings.aim,
        };
        match look(&mut self.hand.reader, &context) {
            Some(Event::Said) => self.hand.spoken = Some(Spoken::Sentence),
            Some(Event::Stop) => self.hand.spoken = Some(Spoken::Stop),
            _ => {}
        }
        self.tell_showing();
    }

    fn tell_showing(&mut self) {
        let showing = self.hand.is_showing();
        if showing != self.hand.told {
            self.hand.told = showing;
            self.send(&ToHost::Showing(showing));
        }
    }

    /// Notices a sensor that has stopped in the middle of a hand.
    pub(super) fn watch_sensor(&mut self, now: Micros) {
        if self.hand.reader.poll(now).is_some() {
            self.fault(Fault::Hand(HandFault::SensorLost));
            self.tell_showing();
        }
    }

    /// Looks at what the hand said: the stop gesture stops, whatever the profile makes of its
    /// likelihoods; what is no command of its own answers the question that is open.
    #[inline(never)]
    pub(super) fn look_at_hand(&mut self, now: Micros, spoken: Spoken) {
        let mut words = self.hand.said().words().iter();
        let commands = words.any(|w| w.category() == Some(Category::ACTION) && w.is_present());
        let answers = if commands { None } else { self.question(now) };
        self.tell_shown(answers);
        let stop = self.loading.vocabulary().and_then(|v| v.stop());
        match (spoken, stop) {
            (Spoken::Stop, Some(stop)) => self.stop(stop, GESTURE),
            _ => self.look_at(now, Source::Hand, answers),
        }
    }

    /// Tells the host what the hand said.
    #[inline(never)]
    fn tell_shown(&mut self, answers: Option<u32>) {
        let Self {
            hand, link, outbox, ..
        } = self;
        let words = hand.said().words();
        let total = u8::try_from(words.len()).unwrap_or(u8::MAX);
        for (part, first) in words.chunks(WORDS_PART).zip((0..).step_by(WORDS_PART)) {
            let part = SentencePart {
                modality: GESTURE,
                answers,
                total,
                first,
                words: Vec::from_slice(part).unwrap_or_default(),
            };
            link.send(&ToHost::Shown(part), outbox);
        }
    }

    /// Tells the host what the unit sees, and what it has counted.
    #[inline(never)]
    pub(super) fn tell_hand(&mut self) {
        let view = self.hand_view();
        self.send(&ToHost::Hand(view));
        self.send(&ToHost::HandStatistics(HandStatistics {
            samples: *self.hand.reader.counters(),
            learned: self.hand.taught.count(),
        }));
    }

    /// What the unit sees of a hand.
    #[must_use]
    pub fn hand_view(&self) -> HandView {
        self.hand.view(self.loading.scene())
    }

    pub(super) fn take_meanings(&mut self, meanings: &Meanings) -> Result<(), Fault> {
        let vocabulary = self.loading.vocabulary().ok_or(Fault::NoVocabulary)?;
        let actions = vocabulary.actions().len();
        let mut mapping = Mapping::new();
        for meaning in meanings {
            mapping
                .set(meaning.gesture, meaning.action, actions)
                .map_err(|error| Fault::Hand(HandFault::Meaning(error)))?;
        }
        self.hand.mapping = mapping;
        self.loaded(Some(Loaded::Meanings));
        Ok(())
    }

    pub(super) fn take_hand_settings(&mut self, settings: &HandSettings) -> Result<(), Fault> {
        let mount = settings.mount.check();
        mount.map_err(|error| Fault::Hand(HandFault::Mount(error)))?;
        if !settings.aim.is_sound() {
            return Err(Fault::Hand(HandFault::Aim));
        }
        self.hand.settings = *settings;
        self.loaded(Some(Loaded::Hand));
        Ok(())
    }
}
