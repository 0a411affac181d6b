//! Where samples of a hand come from when the sensor hangs on this machine: the service of a Leap
//! Motion, MediaPipe's landmarks, a recording, or a made-up person. A thread of its own reads them, as
//! they come or as they came; [`Source::next`] never waits.

mod address;
mod error;
pub mod leap;
pub mod mediapipe;
pub mod recording;

use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::time::{Duration, Instant};

use deictic_core::gesture::wire::Sample;

pub use address::{Address, AddressError};
pub use error::SourceError;

use super::acting::acts;
use super::session::made_up;
use crate::scene::Tabletop;
use crate::vocabulary::Lexicon;

/// Frames per second of made-up people, those of a Leap Motion.
pub const RATE: f64 = 110.0;

/// How well made-up people aim, rad: two degrees.
const AIM: f64 = 0.035;

/// What a source has given.
#[derive(Debug)]
pub enum Seen {
    /// A sample.
    Sample(Box<Sample>),
    /// Something that gave no sample; more may come.
    Bad(SourceError),
    /// Nothing yet.
    Nothing,
    /// There will be no more.
    End,
}

/// A running source.
pub struct Source(Receiver<Result<Sample, SourceError>>);

type Out = Sender<Result<Sample, SourceError>>;

impl Source {
    /// Opens what an address names. Made-up people point at what is on this table.
    ///
    /// # Errors
    /// [`SourceError`] with what to do about it.
    pub fn open(
        address: &Address,
        table: &Tabletop,
        lexicon: &Lexicon,
    ) -> Result<Self, SourceError> {
        match address {
            Address::Leap(url) => leap::open(url),
            Address::MediaPipe(input) => mediapipe::open(input),
            Address::File(path) => Ok(Self::played(recording::read(path)?)),
            Address::MadeUp { seed, acts: text } => {
                let acts = acts(text, table, lexicon).map_err(SourceError::Acting)?;
                let mount = table.hand().mount;
                Ok(Self::played(made_up(*seed, mount, AIM, &acts, RATE)))
            }
        }
    }

    /// Samples that come at the pace of their own clock.
    #[must_use]
    pub fn played(samples: Vec<Sample>) -> Self {
        Self::running(move |out| {
            let began = Instant::now();
            let time = |sample: &Sample| match sample {
                Sample::Hand(frame) => frame.time,
                Sample::Nothing(time) => *time,
            };
            let first = samples.first().map_or(0, time);
            for sample in samples {
                let since = time(&sample).wrapping_sub(first);
                // A clock that jumps back or far ahead is the unit's to judge, not to wait for.
                let due = Duration::from_micros(u64::from(since)).min(Duration::from_secs(600));
                std::thread::sleep(due.saturating_sub(began.elapsed()));
                if out.send(Ok(sample)).is_err() {
                    return;
                }
            }
        })
    }

    /// What `read` sends until it returns.
    fn running(read: impl FnOnce(&Out) + Send + 'static) -> Self {
        let (to, from) = channel();
        std::thread::spawn(move || read(&to));
        Self(from)
    }

    /// What has come, without waiting.
    pub fn next(&self) -> Seen {
        match self.0.try_recv() {
            Ok(Ok(sample)) => Seen::Sample(Box::new(sample)),
            Ok(Err(error)) => Seen::Bad(error),
            Err(TryRecvError::Empty) => Seen::Nothing,
            Err(TryRecvError::Disconnected) => Seen::End,
        }
    }
}
