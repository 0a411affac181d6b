//! Gestures that a unit was taught, beside those it knows.

use heapless::Vec;

use super::loading::in_order;
use crate::gesture::mapping::STROKES;
use crate::gesture::stroke::Templates;
use crate::gesture::template::{Scale, Template};
use crate::protocol::hand::{HandFault, LEARNED, TemplatesPart};
use crate::protocol::message::{Fault, Loaded};

/// Templates that came from the host.
#[derive(Debug)]
pub struct Taught {
    learned: Vec<Template, LEARNED>,
    /// Whether all of them are there.
    complete: bool,
    /// Whether the gestures that a unit knows without being taught are told apart as well.
    known: bool,
    scale: Scale,
}

impl Default for Taught {
    fn default() -> Self {
        Self::new()
    }
}

impl Taught {
    /// Nothing taught.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            learned: Vec::new(),
            complete: false,
            known: true,
            scale: *Templates::KNOWN.scale,
        }
    }

    /// Forgets what was taught, in place.
    pub fn clear(&mut self) {
        self.learned.clear();
        self.complete = false;
        self.known = true;
        self.scale = *Templates::KNOWN.scale;
    }

    /// How many templates were taught.
    #[must_use]
    pub fn count(&self) -> u8 {
        u8::try_from(self.templates().learned.len()).unwrap_or(u8::MAX)
    }

    /// What strokes are compared with.
    #[must_use]
    pub fn templates(&self) -> Templates<'_> {
        if !self.complete {
            return Templates::KNOWN;
        }
        let Templates { known, .. } = Templates::KNOWN;
        Templates {
            known: if self.known { known } else { &[] },
            learned: &self.learned,
            scale: &self.scale,
        }
    }

    /// Takes a part of the templates to be taught; the last one puts them in force.
    ///
    /// # Errors
    /// A [`Fault`]: the part is out of order or a template cannot be. The unit then knows only what
    /// it knows without being taught.
    pub fn take(&mut self, part: &TemplatesPart) -> Result<Option<Loaded>, Fault> {
        let taken = self.push(part);
        if taken.is_err() {
            self.clear();
        }
        taken
    }

    fn push(&mut self, part: &TemplatesPart) -> Result<Option<Loaded>, Fault> {
        if part.first == 0 {
            self.clear();
        }
        in_order(self.learned.len(), part.first)?;
        let refused = |fault| Err(Fault::Hand(fault));
        let Scale {
            shape,
            length,
            seconds,
            reach,
        } = part.scale;
        let scale = [shape, length, seconds, reach];
        if !scale.iter().all(|x| (1e-6..1e6).contains(x)) {
            return refused(HandFault::Scale);
        }
        for template in &part.templates {
            let place = u8::try_from(self.learned.len()).unwrap_or(u8::MAX);
            let finite = template.ln_length.is_finite() && template.ln_seconds.is_finite();
            if !finite || usize::from(template.gesture) >= STROKES {
                return refused(HandFault::Template { template: place });
            }
            if self.learned.push(*template).is_err() {
                return refused(HandFault::TooManyTemplates {
                    capacity: LEARNED as u8,
                });
            }
        }
        if self.learned.len() < usize::from(part.total) {
            return Ok(None);
        }
        if part.total > 0 {
            self.known = part.known;
            self.scale = part.scale;
            self.complete = true;
        }
        Ok(Some(Loaded::Templates(part.total)))
    }
}
