//! Which hand is followed, and what time its frames say it is: everything odd about a stream of
//! samples is noticed here, and counted.

use super::counters::{SampleCounters, count};
use super::frame::{HandFrame, Side};
use super::wire::Sample;
use crate::time::Micros;

/// Frames that follow each other faster than this are left out: 250 frames/s are plenty, and a
/// faster sensor must not take more of the processor.
pub const FASTEST: Micros = Micros(4_000);

/// A hand that is not seen for this long has left. Sensors lose a hand for shorter than this.
pub const LEFT: Micros = Micros::from_millis(350);

/// A sensor that sends nothing for this long, neither hand nor its absence, has stopped.
pub const SILENT: Micros = Micros::from_millis(700);

/// What a sample means for the hand that is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// It is there, this many seconds after the frame before; 0 when it has just come.
    There(f32),
    /// It has left.
    Left,
    /// Nothing: no hand yet, another hand, a sample left out, a hand lost for a moment.
    Nothing,
}

/// Follows the first hand that comes until it leaves.
#[derive(Clone, Debug)]
pub struct Tracking {
    hand: Option<Side>,
    /// The sensor's clock at the last sample used, and the same without wrapping.
    sensor: u32,
    clock: Micros,
    /// When the hand was seen last, by [`Tracking::clock`].
    seen: Micros,
    /// When anything came last, by the caller's clock.
    heard: Micros,
    /// Whether anything has come since the start or the last silence.
    running: bool,
}

impl Default for Tracking {
    fn default() -> Self {
        Self::new()
    }
}

impl Tracking {
    /// No hand yet.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            hand: None,
            sensor: 0,
            clock: Micros(0),
            seen: Micros(0),
            heard: Micros(0),
            running: false,
        }
    }

    /// The sensor's time, without wrapping, since its first sample.
    #[must_use]
    pub fn clock(&self) -> Micros {
        self.clock
    }

    /// The hand that is followed.
    #[must_use]
    pub fn hand(&self) -> Option<Side> {
        self.hand
    }

    /// Takes a sample that came `now`.
    pub fn take(&mut self, now: Micros, sample: &Sample, counters: &mut SampleCounters) -> Step {
        let (time, frame) = match sample {
            Sample::Hand(frame) => (frame.time, Some(frame)),
            Sample::Nothing(time) => (*time, None),
        };
        if let Some(frame) = frame {
            if frame.check().is_err() {
                count(&mut counters.unsound);
                return Step::Nothing;
            }
            if self.hand.is_some_and(|side| side != frame.side) {
                count(&mut counters.other_hand);
                return self.absent(now, time, counters);
            }
        }
        match frame {
            Some(frame) => self.present(now, frame, counters),
            None => self.absent(now, time, counters),
        }
    }

    /// How far the sensor's clock has come; `None` for a sample to be left out. Half of all
    /// differences of a clock that wraps are ahead, the other half behind.
    fn advance(&mut self, now: Micros, time: u32, counters: &mut SampleCounters) -> Option<Micros> {
        self.heard = now;
        if !self.running {
            self.running = true;
            self.sensor = time;
            return Some(Micros(0));
        }
        let ahead = time.wrapping_sub(self.sensor);
        if ahead > u32::MAX / 2 {
            count(&mut counters.backwards);
            return None;
        }
        Some(Micros(u64::from(ahead)))
    }

    fn present(&mut self, now: Micros, frame: &HandFrame, counters: &mut SampleCounters) -> Step {
        let Some(ahead) = self.advance(now, frame.time, counters) else {
            return Step::Nothing;
        };
        if self.hand.is_some() && ahead < FASTEST {
            count(&mut counters.hurried);
            return Step::Nothing;
        }
        self.sensor = frame.time;
        self.clock = self.clock.after(ahead);
        let since = self.clock.since(self.seen);
        self.seen = self.clock;
        if self.hand.is_some() && since >= LEFT {
            // Nothing came in between. The hand that comes now is another story.
            self.hand = None;
            return Step::Left;
        }
        count(&mut counters.used);
        if self.hand.replace(frame.side).is_none() {
            return Step::There(0.0);
        }
        Step::There(since.0 as f32 * 1e-6)
    }

    fn absent(&mut self, now: Micros, time: u32, counters: &mut SampleCounters) -> Step {
        let Some(ahead) = self.advance(now, time, counters) else {
            return Step::Nothing;
        };
        if self.hand.is_none() {
            self.sensor = time;
            self.clock = self.clock.after(ahead);
            return Step::Nothing;
        }
        if self.clock.after(ahead).since(self.seen) < LEFT {
            return Step::Nothing;
        }
        self.hand = None;
        Step::Left
    }

    /// Whether the sensor has stopped in the middle of a hand. Says so once; the hand is not
    /// followed any more.
    pub fn is_silent(&mut self, now: Micros, counters: &mut SampleCounters) -> bool {
        if self.hand.is_none() || now.since(self.heard) < SILENT {
            return false;
        }
        count(&mut counters.silences);
        self.forget();
        true
    }

    /// Follows no hand any more, and takes the next sample for the sensor's first.
    pub fn forget(&mut self) {
        self.hand = None;
        self.running = false;
    }

    /// When [`Tracking::is_silent`] must be asked next.
    #[must_use]
    pub fn next_wake(&self) -> Micros {
        match self.hand {
            Some(_) => self.heard.after(SILENT),
            None => Micros::NEVER,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hand(time: u32) -> Sample {
        Sample::Hand(HandFrame {
            time,
            normal: [0.0, -1.0, 0.0],
            direction: [0.0, 0.0, -1.0],
            ..HandFrame::default()
        })
    }

    fn other(time: u32) -> Sample {
        let Sample::Hand(mut frame) = hand(time) else {
            return Sample::Nothing(time);
        };
        frame.side = Side::Left;
        Sample::Hand(frame)
    }

    fn run(samples: &[Sample]) -> (std::vec::Vec<Step>, SampleCounters) {
        let (mut tracking, mut counters) = (Tracking::new(), SampleCounters::ZERO);
        let steps = samples
            .iter()
            .map(|s| tracking.take(Micros(0), s, &mut counters))
            .collect();
        (steps, counters)
    }

    #[test]
    fn the_clock_wraps_without_notice() {
        let (steps, counters) = run(&[hand(u32::MAX - 4_999), hand(5_000)]);
        assert_eq!(steps, [Step::There(0.0), Step::There(0.01)]);
        assert_eq!(counters.backwards, 0);
    }

    #[test]
    fn time_that_runs_backwards_and_frames_that_hurry_are_left_out() {
        let (steps, counters) = run(&[hand(90_000), hand(50_000), hand(90_500), hand(100_000)]);
        let expected = [
            Step::There(0.0),
            Step::Nothing,
            Step::Nothing,
            Step::There(0.01),
        ];
        assert_eq!(steps, expected);
        assert_eq!(
            (counters.backwards, counters.hurried, counters.used),
            (1, 1, 2)
        );
    }

    #[test]
    fn two_thousand_frames_a_second_are_used_as_two_hundred_and_fifty() {
        let samples: std::vec::Vec<Sample> = (0..2_000).map(|i| hand(i * 500)).collect();
        let (_, counters) = run(&samples);
        assert_eq!(counters.used, 250);
    }

    #[test]
    fn a_second_hand_is_not_followed_and_does_not_keep_the_first_alive() {
        let (steps, counters) = run(&[hand(0), other(10_000), hand(20_000), other(500_000)]);
        let expected = [
            Step::There(0.0),
            Step::Nothing,
            Step::There(0.02),
            Step::Left,
        ];
        assert_eq!(steps, expected);
        assert_eq!(counters.other_hand, 2);
    }

    #[test]
    fn a_hand_that_is_lost_for_a_moment_has_not_left() {
        let nothing = Sample::Nothing;
        let (steps, _) = run(&[hand(0), nothing(100_000), hand(200_000), nothing(560_000)]);
        let expected = [
            Step::There(0.0),
            Step::Nothing,
            Step::There(0.2),
            Step::Left,
        ];
        assert_eq!(steps, expected);
    }

    #[test]
    fn numbers_that_cannot_be_are_counted_and_ignored() {
        let Sample::Hand(mut bad) = hand(0) else {
            return;
        };
        bad.palm[1] = f32::NAN;
        let (steps, counters) = run(&[Sample::Hand(bad)]);
        assert_eq!(
            (steps.as_slice(), counters.unsound),
            ([Step::Nothing].as_slice(), 1)
        );
    }

    #[test]
    fn silence_is_noticed_once() {
        let (mut tracking, mut counters) = (Tracking::new(), SampleCounters::ZERO);
        assert_eq!(tracking.next_wake(), Micros::NEVER);
        tracking.take(Micros(7), &hand(0), &mut counters);
        let wake = tracking.next_wake();
        assert!(!tracking.is_silent(Micros(wake.0 - 1), &mut counters));
        assert!(tracking.is_silent(wake, &mut counters));
        assert!(!tracking.is_silent(wake, &mut counters));
        assert_eq!(counters.silences, 1);
    }
}
