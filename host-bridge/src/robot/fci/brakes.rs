//! How an arm on its way comes to rest and goes on: the clock of its motion runs slower and slower, so that it stays on
//! its path, and faster again.

use std::sync::atomic::{AtomicBool, Ordering};

/// How long the arm takes to come to rest, and to go on as fast as before, in seconds.
const BRAKING: f64 = 0.25;

/// What makes an arm come to rest, and who is told.
pub(super) struct Brakes<'a> {
    /// Set to come to rest and end the motion there.
    pub stop: &'a AtomicBool,
    /// Set to come to rest and wait.
    pub hold: &'a AtomicBool,
    /// Hears that the arm stands and waits, and that it goes on.
    pub held: &'a dyn Fn(bool),
}

/// How far the brakes are on, in one motion.
#[derive(Debug, Default)]
pub(super) struct Braking {
    /// From 0, running freely, to 1, at rest.
    on: f64,
    waits: bool,
}

impl Braking {
    /// How much of `period`, in seconds, passes on the motion's clock.
    pub fn passed(&mut self, brakes: &Brakes<'_>, period: f64) -> f64 {
        let stop = brakes.stop.load(Ordering::Relaxed);
        let hold = brakes.hold.load(Ordering::Relaxed) && !stop;
        let by = period / BRAKING;
        self.on = (self.on + if stop || hold { by } else { -by }).clamp(0.0, 1.0);
        let waits = hold && self.on >= 1.0;
        // One that begins to move is told as going on; one that is stopped as stopped.
        if waits != self.waits && (waits || !stop) {
            self.waits = waits;
            (brakes.held)(waits);
        }
        period * (1.0 - self.on * self.on * (3.0 - 2.0 * self.on))
    }

    /// Whether the arm is at rest for good.
    pub fn stopped(&self, brakes: &Brakes<'_>) -> bool {
        self.on >= 1.0 && brakes.stop.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;

    #[test]
    fn a_held_clock_stands_and_goes_on_and_a_stopped_one_is_stopped_for_good() {
        let (stop, hold) = (AtomicBool::new(false), AtomicBool::new(false));
        let told = RefCell::new(Vec::new());
        let held = |held| told.borrow_mut().push(held);
        let brakes = Brakes {
            stop: &stop,
            hold: &hold,
            held: &held,
        };
        let mut braking = Braking::default();
        let mut half = || (0..500).map(|_| braking.passed(&brakes, 1e-3)).sum::<f64>();
        assert!((half() - 0.5).abs() < 1e-9);
        hold.store(true, Ordering::Relaxed);
        let way = half();
        assert!((way - BRAKING / 2.0).abs() < 2e-3, "{way}");
        assert_eq!(half(), 0.0);
        hold.store(false, Ordering::Relaxed);
        assert!((half() - (0.5 - BRAKING / 2.0)).abs() < 2e-3);
        assert_eq!(*told.borrow(), [true, false]);
        hold.store(true, Ordering::Relaxed);
        half();
        stop.store(true, Ordering::Relaxed);
        half();
        assert!(braking.stopped(&brakes));
        assert_eq!(*told.borrow(), [true, false, true]);
    }
}
