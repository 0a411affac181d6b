//! What has become of a sensor's samples.

use serde::{Deserialize, Serialize};

/// What has become of samples since the start. Every counter stops at its largest value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SampleCounters {
    /// Frames of the followed hand that were used.
    pub used: u32,
    /// Left out: came sooner after the one before than 4 ms.
    pub hurried: u32,
    /// Left out: earlier than the one before.
    pub backwards: u32,
    /// Left out: another hand than the one that is followed.
    pub other_hand: u32,
    /// Used for what they tell, but some finger was not followed, or made no shape.
    pub shapeless: u32,
    /// Left out: a number in it cannot be.
    pub unsound: u32,
    /// Left out: damaged on the way, or cut short.
    pub damaged: u32,
    /// Left out: of another version of the wire form.
    pub foreign: u32,
    /// Left out: came before a host had loaded vocabulary and scene.
    pub unready: u32,
    /// Times that the sensor fell silent while a hand was there.
    pub silences: u32,
}

impl SampleCounters {
    /// Nothing has happened yet.
    pub const ZERO: Self = Self {
        used: 0,
        hurried: 0,
        backwards: 0,
        other_hand: 0,
        shapeless: 0,
        unsound: 0,
        damaged: 0,
        foreign: 0,
        unready: 0,
        silences: 0,
    };
}

/// Adds one, as far as there is room.
pub(crate) fn count(counter: &mut u32) {
    *counter = counter.saturating_add(1);
}
