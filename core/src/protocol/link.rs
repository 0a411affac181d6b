//! One end of a link: frames in and out, sequence numbers, and a counter for every kind of lost
//! frame.

use serde::{Serialize, de::DeserializeOwned};

use super::counters::count;
use super::lock::Lock;
use super::seal::{Key, Nonces, Way};
use super::stuffing::{FrameError, FrameReader, FrameWriter, Outbox};

pub use super::counters::Counters;

/// A message that can open a conversation, whatever was said before.
pub trait Opening {
    /// Whether sequence numbers start anew with this message.
    fn opens(&self) -> bool;

    /// Whether it belongs to the exchange by which both ends show that they have the key, and so is itself not sealed.
    fn proves(&self) -> bool {
        false
    }
}

/// A message that arrived.
#[derive(Clone, Debug, PartialEq)]
pub struct Received<M> {
    /// What was said.
    pub message: M,
    /// How many frames before it were lost; what must not be acted upon after a gap looks here.
    pub missed: u16,
}

/// One end of a link with frames of at most `FRAME` bytes before stuffing.
#[derive(Debug)]
pub struct Link<const FRAME: usize> {
    reader: FrameReader<FRAME>,
    /// Counted on beyond the 16 bits that a frame carries, for the seal.
    expected: u64,
    next: u64,
    counters: Counters,
    lock: Lock,
}

impl<const FRAME: usize> Default for Link<FRAME> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const FRAME: usize> Link<FRAME> {
    /// An end that has neither sent nor received.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            reader: FrameReader::new(),
            expected: 0,
            next: 0,
            counters: Counters::ZERO,
            lock: Lock::None,
        }
    }

    /// From now on nothing is taken but what opens a conversation or proves to have the key; this end's own frames go
    /// `way`.
    pub fn lock(&mut self, key: Key, way: Way) {
        self.lock = Lock::Shut(key, way);
    }

    /// The key, where there is one.
    #[must_use]
    pub fn key(&mut self) -> Option<&mut Key> {
        self.lock.key()
    }

    /// Whether there is a key that the other end has not shown to have.
    #[must_use]
    pub fn is_shut(&self) -> bool {
        matches!(self.lock, Lock::Shut(..))
    }

    /// Ends the conversation with these seals; both ends are to prove anew.
    pub fn shut(&mut self) {
        self.lock.shut();
    }

    /// Both have shown to have the key: every frame is sealed from now on.
    pub fn seal(&mut self, nonces: Nonces) {
        self.lock.seal(nonces);
    }

    /// What has become of frames so far.
    #[must_use]
    pub fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Takes one byte, and gives the message that it completes, if it does and the message is to be
    /// taken. Everything else is counted.
    #[inline(never)]
    pub fn receive<M: DeserializeOwned + Opening>(&mut self, byte: u8) -> Option<Received<M>> {
        let counters = &mut self.counters;
        let contents = match self.reader.push(byte)? {
            Ok(contents) => contents,
            Err(error) => {
                count(match error {
                    FrameError::Malformed => &mut counters.malformed,
                    FrameError::Corrupt => &mut counters.corrupt,
                    FrameError::Oversized => &mut counters.oversized,
                });
                return None;
            }
        };
        let (body, sealed) = self.lock.open(self.expected, contents);
        let decoded = postcard::take_from_bytes::<(u16, M)>(body);
        let may_be_plain = |message: &M| match self.lock {
            Lock::None => true,
            Lock::Shut(..) => message.opens() || message.proves(),
            Lock::Sealed(_) => message.opens(),
        };
        let (sequence, message) = match decoded {
            Ok((whole, [])) if sealed || may_be_plain(&whole.1) => whole,
            _ => {
                let locked = !matches!(self.lock, Lock::None) && !sealed;
                count(if locked {
                    &mut counters.unauthentic
                } else {
                    &mut counters.undecodable
                });
                return None;
            }
        };
        let missed = if message.opens() {
            self.expected = u64::from(sequence);
            0
        } else {
            // The half of all numbers ahead of the expected one is new, the other half is old.
            let ahead = sequence.wrapping_sub(self.expected as u16);
            if ahead == u16::MAX {
                count(&mut counters.duplicated);
                return None;
            }
            if ahead > u16::MAX / 2 {
                count(&mut counters.reordered);
                return None;
            }
            ahead
        };
        let passed = u64::from(missed).saturating_add(1);
        self.expected = self.expected.wrapping_add(passed);
        counters.missed = counters.missed.saturating_add(u32::from(missed));
        count(&mut counters.received);
        Some(Received { message, missed })
    }

    /// Puts a message into the outbox, or counts that there was no room for it and gives `false`.
    pub fn send<M: Serialize + Opening, const OUT: usize>(
        &mut self,
        message: &M,
        out: &mut Outbox<OUT>,
    ) -> bool {
        if message.opens() {
            // The other end counts from the 16 bits that it hears.
            self.next &= u64::from(u16::MAX);
        }
        let tagger = match &mut self.lock {
            Lock::Sealed(seal) if !message.opens() => Some(seal.tagger(self.next)),
            _ => None,
        };
        let framed = FrameWriter::sealed(out, tagger).and_then(|writer| {
            postcard::serialize_with_flavor(&(self.next as u16, message), writer)
        });
        if framed.is_err() {
            count(&mut self.counters.unsent);
            return false;
        }
        self.next = self.next.wrapping_add(1);
        count(&mut self.counters.sent);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    enum Note {
        Open,
        Text(u8),
    }

    impl Opening for Note {
        fn opens(&self) -> bool {
            *self == Self::Open
        }
    }

    /// Something that is not a note.
    #[derive(Serialize)]
    struct Other<T>(T);

    impl<T> Opening for Other<T> {
        fn opens(&self) -> bool {
            false
        }
    }

    fn frame(sender: &mut Link<64>, note: &Note) -> std::vec::Vec<u8> {
        let mut out = Outbox::<64>::new();
        assert!(sender.send(note, &mut out));
        out.waiting().to_vec()
    }

    fn take(receiver: &mut Link<64>, bytes: &[u8]) -> Option<Received<Note>> {
        bytes
            .iter()
            .fold(None, |got, b| receiver.receive(*b).or(got))
    }

    #[test]
    fn duplicates_and_stragglers_are_dropped_and_gaps_are_told() {
        let (mut a, mut b) = (Link::new(), Link::new());
        let frames: std::vec::Vec<_> = (0..6).map(|i| frame(&mut a, &Note::Text(i))).collect();
        assert_eq!(take(&mut b, &frames[0]).unwrap().missed, 0);
        assert_eq!(take(&mut b, &frames[0]), None);
        assert_eq!(
            take(&mut b, &frames[3]),
            Some(Received {
                message: Note::Text(3),
                missed: 2
            })
        );
        assert_eq!(take(&mut b, &frames[1]), None);
        assert_eq!(take(&mut b, &frames[4]).unwrap().missed, 0);
        let c = b.counters();
        assert_eq!(
            (c.received, c.duplicated, c.reordered, c.missed),
            (3, 1, 1, 2)
        );
        assert_eq!(c.dropped(), 2);
    }

    #[test]
    fn an_opening_starts_the_numbers_anew() {
        let (mut a, mut b) = (Link::new(), Link::new());
        for i in 0..5 {
            let f = frame(&mut a, &Note::Text(i));
            take(&mut b, &f);
        }
        let mut reborn = Link::new();
        let first = frame(&mut reborn, &Note::Text(9));
        assert_eq!(take(&mut b, &first), None);
        let open = frame(&mut reborn, &Note::Open);
        assert_eq!(take(&mut b, &open).unwrap().missed, 0);
        let next = frame(&mut reborn, &Note::Text(1));
        assert_eq!(take(&mut b, &next).unwrap().missed, 0);
    }

    #[test]
    fn numbers_wrap() {
        let (mut a, mut b) = (Link::new(), Link::new());
        a.next = u64::from(u16::MAX);
        b.expected = u64::from(u16::MAX);
        for i in 0..3 {
            let f = frame(&mut a, &Note::Text(i));
            assert_eq!(take(&mut b, &f).unwrap().missed, 0);
        }
    }

    #[test]
    fn sound_frames_with_other_contents_are_counted() {
        let (mut a, mut b) = (Link::<64>::new(), Link::<64>::new());
        let mut out = Outbox::<64>::new();
        a.send(&Other((7_u8, 8_u64)), &mut out);
        let bytes = out.waiting().to_vec();
        assert_eq!(take(&mut b, &bytes), None);
        // The same message with something behind it is not that message.
        let mut out = Outbox::<64>::new();
        a.send(&Other((Note::Text(1), 5_u8)), &mut out);
        let bytes = out.waiting().to_vec();
        assert_eq!(take(&mut b, &bytes), None);
        assert_eq!(b.counters().undecodable, 2);
    }

    #[test]
    fn what_does_not_fit_is_counted() {
        let mut a = Link::<64>::new();
        let mut out = Outbox::<8>::new();
        assert!(!a.send(&Note::Text(1), &mut out) || out.waiting().len() <= 8);
        assert!(!a.send(&Other([1_u64; 8]), &mut out));
        assert!(a.counters().unsent >= 1);
    }
}
