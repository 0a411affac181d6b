//! The unit's own eyes: samples of a hand sensor, from its serial line or through the host, become
//! the gesture sentence, which is then treated as one that the host says.

use heapless::Vec;

use super::Unit;
use super::pairing::Source;
use super::taught::Taught;
use crate::category::Category;
use crate::gesture::context::{Context, Event};
use crate::gesture::line::SensorLine;
use crate::gesture::mapping::{Mapping, STROKES};
use crate::gesture::reader::HandReader;
use crate::gesture::stroke::Likely;
use crate::gesture::wire::{Sample, WireError, decode};
use crate::protocol::hand::{HandFault, HandSettings, Meanings, SampleBytes, TemplatesPart};
use crate::protocol::message::{Fault, Loaded, SentencePart, ToHost, WORDS_PART};
use crate::sentence::{GESTURE, Sentence};
use crate::time::Micros;

/// What a hand has said that nobody has looked at yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spoken {
    /// A sentence.
    Sentence,
    /// The stop gesture.
    Stop,
}

/// The hand reader with all it goes by.
#[derive(Debug)]
pub struct Hand<const N: usize, const C: usize, const W: usize> {
    line: SensorLine,
    pub(super) reader: HandReader<N, C, W>,
    mapping: Mapping,
    pub(super) settings: HandSettings,
    pub(super) taught: Taught,
    /// Whether the host is told of samples that come from the unit's own sensor.
    pub(super) relays: bool,
    /// A sample that was not read yet; empty when there is none.
    pub(super) pending: SampleBytes,
    spoken: Option<Spoken>,
    /// Whether the host was told that the hand is in the middle of a sentence.
    told: bool,
}

impl<const N: usize, const C: usize, const W: usize> Default for Hand<N, C, W> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, const C: usize, const W: usize> Hand<N, C, W> {
    /// No hand, and no gesture that stands for anything.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            line: SensorLine::new(),
            reader: HandReader::new(),
            mapping: Mapping::new(),
            settings: HandSettings::DEFAULT,
            taught: Taught::new(),
            relays: false,
            pending: SampleBytes::new(),
            spoken: None,
            told: false,
        }
    }

    /// As new, in place.
    #[inline(never)]
    pub fn restart(&mut self) {
        self.line = SensorLine::new();
        self.reader.restart();
        self.clear();
    }

    /// As new, in place; what was counted stays.
    pub fn clear(&mut self) {
        self.forget();
        self.mapping.clear();
        self.settings = HandSettings::DEFAULT;
        self.taught.clear();
        self.relays = false;
    }

    /// Forgets the hand and what it was saying.
    pub fn forget(&mut self) {
        self.reader.forget();
        self.pending.clear();
        self.spoken = None;
        self.told = false;
    }

    /// The actions that gestures stood for are no more.
    pub fn unlearn_meanings(&mut self) {
        self.forget();
        self.mapping.clear();
    }

    /// What the hand said last.
    #[must_use]
    pub fn said(&self) -> &Sentence<W, C, N> {
        self.reader.said()
    }

    /// Whether the hand is in the middle of a sentence.
    #[must_use]
    pub fn is_showing(&self) -> bool {
        self.reader.is_showing()
    }

    /// When the sensor's silence is to be noticed.
    #[must_use]
    pub fn next_wake(&self) -> Micros {
        self.reader.next_wake()
    }

    /// Takes a part of the templates to be taught.
    ///
    /// # Errors
    /// Those of [`Taught::take`].
    pub fn take_templates(&mut self, part: &TemplatesPart) -> Result<Option<Loaded>, Fault> {
        self.taught.take(part)
    }

    /// Keeps a sample, to be read next.
    pub(super) fn keep_sample(&mut self, bytes: &[u8]) {
        self.pending.clear();
        if bytes.is_empty() || self.pending.extend_from_slice(bytes).is_err() {
            self.reader.count_error(WireError::Length(0));
        }
    }

    pub(super) fn take_spoken(&mut self) -> Option<Spoken> {
        self.spoken.take()
    }
}

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
