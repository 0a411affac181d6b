//! One direction of a line that does everything to frames that lines do: it loses, damages, cuts, doubles, delays and
//! overtakes them, by a seed.

use deictic_bits::random::Random;
use deictic_core::time::Micros;

/// How often each fault befalls a frame, one in so many; 0 for never.
#[derive(Clone, Copy, Debug)]
pub struct Faults {
    /// It does not arrive.
    pub lost: u32,
    /// One to eight of its bits are flipped.
    pub flipped: u32,
    /// Up to 32 bits in a row are random.
    pub burst: u32,
    /// Only its beginning arrives.
    pub cut: u32,
    /// It arrives twice.
    pub doubled: u32,
    /// It arrives later than the next ones.
    pub delayed: u32,
    /// Noise comes before it.
    pub noise: u32,
}

impl Faults {
    /// A line that does as it should.
    pub const NONE: Self = Self {
        lost: 0,
        flipped: 0,
        burst: 0,
        cut: 0,
        doubled: 0,
        delayed: 0,
        noise: 0,
    };
}

/// How long a frame takes at least.
const FLIGHT: Micros = Micros(3_000);

/// How much longer a delayed one takes at most.
const DELAY: u32 = 400_000;

/// Bytes under way.
struct Flying {
    arrives: Micros,
    bytes: Vec<u8>,
    sound: bool,
}

/// What has arrived.
#[derive(Debug, Default)]
pub struct Arrived {
    /// The bytes.
    pub bytes: Vec<u8>,
    /// Whether a whole frame was among them as it had been sent.
    pub sound: bool,
}

/// One direction of a line.
pub struct Line {
    random: Random,
    /// What befalls its frames.
    pub faults: Faults,
    writing: Vec<u8>,
    /// When the last frame that was not delayed arrives.
    last: Micros,
    flying: Vec<Flying>,
    /// What is left of bytes that arrived and were not fetched.
    held: Vec<u8>,
}

impl Line {
    /// A line whose faults follow from `seed`.
    #[must_use]
    pub fn new(seed: u64, faults: Faults) -> Self {
        Self {
            random: Random::new(seed),
            faults,
            writing: Vec::new(),
            last: Micros(0),
            flying: Vec::new(),
            held: Vec::new(),
        }
    }

    /// Takes bytes of which frames are made.
    pub fn write(&mut self, now: Micros, bytes: &[u8]) {
        for &byte in bytes {
            self.writing.push(byte);
            if byte == 0 {
                let frame = std::mem::take(&mut self.writing);
                self.send(now, frame);
            }
        }
    }

    fn send(&mut self, now: Micros, mut frame: Vec<u8>) {
        let random = &mut self.random;
        let mut hit = |one_in: u32| one_in > 0 && random.one_in(one_in);
        if hit(self.faults.lost) {
            return;
        }
        let (flipped, burst, cut) = (
            hit(self.faults.flipped),
            hit(self.faults.burst),
            hit(self.faults.cut),
        );
        let (doubled, delayed, noise) = (
            hit(self.faults.doubled),
            hit(self.faults.delayed),
            hit(self.faults.noise),
        );
        if flipped {
            flip(&mut frame, random);
        }
        if burst {
            smear(&mut frame, random);
        }
        if cut {
            frame.truncate(random.below(frame.len() as u32) as usize);
        }
        let sound = !(flipped || burst || cut);
        let junk: Vec<u8> = match noise {
            true => (0..1 + random.below(20))
                .map(|_| random.below(256) as u8)
                .collect(),
            false => Vec::new(),
        };
        self.disturb(now, &junk);
        let random = &mut self.random;
        let flight = FLIGHT.after(Micros(u64::from(random.below(500))));
        // Without a fault nothing overtakes anything.
        let mut arrives = now.after(flight).max(self.last);
        if delayed {
            arrives = arrives.after(Micros(u64::from(random.below(DELAY))));
        } else {
            self.last = arrives;
        }
        if doubled {
            let later = Micros(u64::from(random.below(DELAY)));
            self.flying.push(Flying {
                arrives: arrives.after(later),
                bytes: frame.clone(),
                sound: false,
            });
        }
        self.flying.push(Flying {
            arrives,
            bytes: frame,
            sound,
        });
    }

    /// Bytes that nobody sent come out of it, between two frames.
    pub fn disturb(&mut self, now: Micros, bytes: &[u8]) {
        if !bytes.is_empty() {
            self.flying.push(Flying {
                arrives: now.after(FLIGHT).max(self.last),
                bytes: bytes.to_vec(),
                sound: false,
            });
        }
    }

    /// When the next bytes arrive.
    #[must_use]
    pub fn next(&self) -> Option<Micros> {
        if !self.held.is_empty() {
            return Some(Micros(0));
        }
        self.flying.iter().map(|f| f.arrives).min()
    }

    /// What has arrived by now, at most `most` bytes of it.
    pub fn take(&mut self, now: Micros, most: usize) -> Arrived {
        let mut arrived = Arrived::default();
        // Frames do not interleave: whichever arrives first comes whole.
        self.flying.sort_by_key(|f| f.arrives);
        let due = self.flying.iter().take_while(|f| f.arrives <= now).count();
        for flown in self.flying.drain(..due) {
            arrived.sound |= flown.sound;
            self.held.extend(flown.bytes);
        }
        let rest = self.held.split_off(most.min(self.held.len()));
        arrived.bytes = std::mem::replace(&mut self.held, rest);
        arrived
    }

    /// The line breaks, after `more` bytes of what is under way: all else is lost.
    pub fn break_after(&mut self, more: usize) {
        self.flying.sort_by_key(|f| f.arrives);
        let all = self.flying.drain(..).flat_map(|f| f.bytes);
        let first: Vec<u8> = all.take(more).collect();
        self.held.extend(first);
        self.writing.clear();
    }
}

/// Flips one to eight bits.
pub fn flip(frame: &mut [u8], random: &mut Random) {
    for _ in 0..1 + random.below(8) {
        let at = random.below(frame.len() as u32) as usize;
        frame[at] ^= 1 << random.below(8);
    }
}

/// Makes up to 32 bits in a row random.
pub fn smear(frame: &mut [u8], random: &mut Random) {
    let at = random.below(frame.len() as u32) as usize;
    let long = 1 + random.below(4) as usize;
    for byte in frame.iter_mut().skip(at).take(long) {
        *byte = random.below(256) as u8;
    }
}
