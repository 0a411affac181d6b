//! The gesture unit as a state machine: bytes and time in, bytes out. Board, host tests, replays and
//! fuzzers run this very code.
//!
//! A conversation opens with the host's Hello, which empties the unit: whatever the host relied on
//! before is loaded anew. Then come vocabulary, scene and configuration ([`loading`], [`sensing`]), sentences and
//! answers ([`pairing`]), samples of a hand sensor ([`hand`]), and heartbeats both ways. Everything unexpected is answered by a
//! [`Fault`] and changes nothing. A unit that has restarted answers the first thing it hears with its
//! own Hello, by which the host knows to open the conversation again.

pub mod hand;
pub mod loading;
pub mod pairing;
mod seeing;
pub mod sensing;
mod taking;
pub mod taught;
mod trust;
mod view;

pub use crate::protocol::message::Statistics;

use crate::protocol::link::{Counters, Link, Received};
use crate::protocol::message::{Capacities, Configuration, Fault, Heartbeat, ToHost};
use crate::protocol::seal::{Key, Way};
use crate::protocol::stuffing::Outbox;
use crate::time::Micros;
use crate::trace::Trace;
use hand::Hand;
use loading::Loading;
use pairing::Pairing;
use sensing::Sensing;
use trust::Trust;

/// How often the unit shows that it lives.
pub const HEARTBEAT: Micros = Micros::from_millis(500);

/// After how long without a frame the host counts as lost.
pub const HOST_LOST: Micros = Micros::from_millis(2_000);

/// A gesture unit. `N` options, `C` categories, `F` features, `E` things, `W` words, frames of
/// `FRAME` bytes before stuffing, `OUT` bytes waiting to be written, `S` bytes
/// of sensors' tables.
#[derive(Debug)]
pub struct Unit<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
    const FRAME: usize,
    const OUT: usize,
    const S: usize,
> {
    trust: Trust,
    link: Link<FRAME>,
    outbox: Outbox<OUT>,
    /// Whether a host of the same schema has opened the conversation.
    open: bool,
    heard: Micros,
    beat: Micros,
    loading: Loading<N, C, F, E>,
    sensing: Sensing<S>,
    pairing: Pairing<N, C, W>,
    hand: Hand<N, C, W>,
    trace: Trace<C, N>,
    configuration: Configuration,
    /// Whether the robot is carrying out a command.
    moving: bool,
    statistics: Statistics,
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
    /// A unit that has just started; `boot` tells this start from others.
    #[must_use]
    pub const fn new(boot: u32) -> Self {
        Self {
            trust: Trust::new(boot),
            link: Link::new(),
            outbox: Outbox::new(),
            open: false,
            heard: Micros(0),
            beat: Micros(0),
            loading: Loading::new(),
            sensing: Sensing::new(),
            pairing: Pairing::new(),
            hand: Hand::new(),
            trace: Trace::new(),
            configuration: Configuration::DEFAULT,
            moving: false,
            statistics: Statistics {
                link: Counters::ZERO,
                executes: 0,
                asks: 0,
                repeats: 0,
                faults: 0,
            },
        }
    }

    /// Makes a unit as new, in place: one that has run before, or one in a static of zeros. A new one
    /// would be built on the stack first, and in a static's first value it would take its whole size
    /// of flash.
    #[inline(never)]
    pub fn restart(&mut self, boot: u32) {
        self.trust = Trust::new(boot);
        self.link = Link::new();
        self.outbox.abandon();
        self.open = false;
        self.heard = Micros(0);
        self.beat = Micros(0);
        self.loading.clear();
        self.sensing.clear();
        self.pairing.restart();
        self.hand.restart();
        self.trace.clear();
        self.configuration = Configuration::DEFAULT;
        self.moving = false;
        self.statistics = Statistics::default();
    }

    /// From now on only a host that has the key is listened to. It is told after the unit's Hello what to prove it with.
    #[inline(never)]
    pub fn lock(&mut self, key: Key) {
        self.link.lock(key, Way::ToHost);
        self.open = false;
    }

    /// What this build holds.
    #[must_use]
    pub const fn capacities() -> Capacities {
        Capacities {
            options: N as u16,
            categories: C as u16,
            features: F as u16,
            entities: E as u16,
            words: W as u16,
            frame: FRAME as u16,
        }
    }

    /// Takes bytes from the host link, in pieces of any size.
    pub fn receive(&mut self, now: Micros, bytes: &[u8]) {
        for &byte in bytes {
            self.take_byte(now, byte);
            self.settle(now);
        }
    }

    /// A message at a time is on the stack, and only here: what decodes it and what takes it are
    /// functions of their own, which use the same stack in turn.
    #[inline(never)]
    fn take_byte(&mut self, now: Micros, byte: u8) {
        if let Some(Received { message, .. }) = self.link.receive(byte) {
            self.heard = now;
            self.take(now, &message);
        }
    }

    /// Does what is due by now: a decision whose window has closed, a heartbeat, giving up a host
    /// that fell silent.
    pub fn poll(&mut self, now: Micros) {
        if !self.open {
            return;
        }
        if now.since(self.heard) >= HOST_LOST {
            self.open = false;
            self.moving = false;
            self.pairing.forget();
            self.hand.forget();
            self.fault(Fault::HostLost);
            return;
        }
        self.watch_sensor(now);
        self.settle(now);
        self.watch_forbidden(now);
        if now >= self.beat {
            self.beat = now.after(HEARTBEAT);
            self.send(&ToHost::Heartbeat(Heartbeat {
                now,
                vocabulary: self.loading.vocabulary().map_or(0, |v| v.fingerprint()),
                scene: self.loading.scene().map_or(0, |s| s.version()),
            }));
        }
    }

    /// The latest moment at which [`Unit::poll`] is to be called again.
    #[must_use]
    pub fn next_wake(&self) -> Micros {
        if self.open {
            self.beat
                .min(self.pairing.due())
                .min(self.hand.next_wake())
                .min(self.heard.after(HOST_LOST))
        } else {
            Micros::NEVER
        }
    }

    /// Bytes waiting for the host link.
    #[must_use]
    pub fn outgoing(&self) -> &[u8] {
        self.outbox.waiting()
    }

    /// The first `n` waiting bytes have been written.
    pub fn sent(&mut self, n: usize) {
        self.outbox.written(n);
    }

    /// What has been counted so far.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        Statistics {
            link: *self.link.counters(),
            ..self.statistics
        }
    }

    fn send(&mut self, message: &ToHost<N, C>) {
        self.link.send(message, &mut self.outbox);
    }

    fn fault(&mut self, fault: Fault) {
        self.statistics.faults = self.statistics.faults.saturating_add(1);
        self.send(&ToHost::Fault(fault));
    }
}
