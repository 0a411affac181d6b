//! The bridge's clock: the machine's monotonic one, or, on a thread that asked for it, one that goes many times as fast,
//! or a simulated one that moves only when it is told to or when something would have slept. Sessions run under it many thousand times faster than real
//! time, and alike every time.

use std::cell::Cell;
use std::marker::PhantomData;
use std::time::{Duration, Instant};

/// How time passes on a thread.
#[derive(Clone, Copy)]
enum Time {
    Real,
    Simulated(Instant),
    /// So many times as fast as the machine's clock since `began`, and a jump ahead of that.
    Hasty {
        began: Instant,
        haste: u32,
        ahead: Duration,
    },
}

thread_local! {
    static TIME: Cell<Time> = const { Cell::new(Time::Real) };
}

/// The present moment.
#[must_use]
pub fn now() -> Instant {
    match TIME.get() {
        Time::Real => Instant::now(),
        Time::Simulated(now) => now,
        Time::Hasty {
            began,
            haste,
            ahead,
        } => began + began.elapsed() * haste + ahead,
    }
}

/// How long ago `earlier` was.
#[must_use]
pub fn since(earlier: Instant) -> Duration {
    now().saturating_duration_since(earlier)
}

/// How long it is until `later`; `None` from that very moment on.
#[must_use]
pub fn until(later: Instant) -> Option<Duration> {
    later
        .checked_duration_since(now())
        .filter(|left| !left.is_zero())
}

/// Waits.
pub fn sleep(span: Duration) {
    match TIME.get() {
        Time::Real => std::thread::sleep(span),
        Time::Simulated(now) => TIME.set(Time::Simulated(now + span)),
        Time::Hasty { haste, .. } => std::thread::sleep(span / haste),
    }
}

/// Lets a clock that is not the machine's jump ahead.
pub fn jump(span: Duration) {
    match TIME.get() {
        Time::Real => {}
        Time::Simulated(now) => TIME.set(Time::Simulated(now + span)),
        Time::Hasty {
            began,
            haste,
            ahead,
        } => TIME.set(Time::Hasty {
            began,
            haste,
            ahead: ahead + span,
        }),
    }
}

/// While it lives, this thread's clock goes many times as fast as the machine's.
#[derive(Debug)]
pub struct Hasty {
    /// It belongs to the thread that made it.
    here: PhantomData<*const ()>,
}

impl Hasty {
    /// Makes it go `haste` times as fast from now on, at least once.
    #[must_use]
    pub fn start(haste: u32) -> Self {
        TIME.set(Time::Hasty {
            began: Instant::now(),
            haste: haste.max(1),
            ahead: Duration::ZERO,
        });
        Self { here: PhantomData }
    }
}

impl Drop for Hasty {
    fn drop(&mut self) {
        TIME.set(Time::Real);
    }
}

/// While it lives, this thread's clock is simulated.
#[derive(Debug)]
pub struct Simulated {
    /// It belongs to the thread that made it.
    here: PhantomData<*const ()>,
}

impl Simulated {
    /// Stops this thread's clock at the present moment.
    #[must_use]
    pub fn start() -> Self {
        TIME.set(Time::Simulated(Instant::now()));
        Self { here: PhantomData }
    }

    /// Moves it forwards.
    pub fn advance(&self, span: Duration) {
        sleep(span);
    }
}

impl Drop for Simulated {
    fn drop(&mut self) {
        TIME.set(Time::Real);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_simulated_clock_stands_still_until_something_sleeps() {
        let clock = Simulated::start();
        let began = now();
        assert_eq!(since(began), Duration::ZERO);
        sleep(Duration::from_secs(3_600));
        clock.advance(Duration::from_secs(1));
        assert_eq!(since(began), Duration::from_secs(3_601));
        assert_eq!(until(now()), None);
        drop(clock);
        assert!(since(began) < Duration::from_secs(3_600));
    }

    #[test]
    fn a_hasty_clock_goes_as_many_times_as_fast_and_jumps() {
        let clock = Hasty::start(1_000);
        let (began, real) = (now(), Instant::now());
        sleep(Duration::from_secs(5));
        assert!(since(began) >= Duration::from_secs(5));
        assert!(real.elapsed() >= Duration::from_millis(5));
        jump(Duration::from_secs(100_000));
        assert!(since(began) >= Duration::from_secs(100_005));
        drop(clock);
        assert!(now() < began + Duration::from_secs(100_000));
    }
}
