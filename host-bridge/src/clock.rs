//! The bridge's clock: the machine's monotonic one, or, on a thread that asked for it, a simulated one that moves only
//! when it is told to or when something would have slept. Sessions run under it many thousand times faster than real
//! time, and alike every time.

use std::cell::Cell;
use std::marker::PhantomData;
use std::time::{Duration, Instant};

thread_local! {
    static SIMULATED: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// The present moment.
#[must_use]
pub fn now() -> Instant {
    SIMULATED.get().unwrap_or_else(Instant::now)
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
    match SIMULATED.get() {
        Some(now) => SIMULATED.set(Some(now + span)),
        None => std::thread::sleep(span),
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
        SIMULATED.set(Some(Instant::now()));
        Self { here: PhantomData }
    }

    /// Moves it forwards.
    pub fn advance(&self, span: Duration) {
        sleep(span);
    }
}

impl Drop for Simulated {
    fn drop(&mut self) {
        SIMULATED.set(None);
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
}
