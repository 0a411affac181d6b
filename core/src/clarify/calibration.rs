//! Made by `deictic-eval calibrate --asking`: do not edit.

use crate::joint::{LEVELS, Levels};

/// How probable it is, in thousandths, that a word of 2, 3, ... options is heard right, per noise level.
#[rustfmt::skip]
pub const RELIABILITY: [[u16; LEVELS]; 15] = [
    [992, 993, 887, 784],
    [985, 988, 812, 664],
    [979, 982, 757, 581],
    [973, 978, 711, 518],
    [967, 973, 672, 467],
    [962, 969, 639, 426],
    [957, 965, 611, 393],
    [952, 961, 584, 365],
    [948, 957, 562, 340],
    [943, 953, 541, 318],
    [939, 950, 523, 299],
    [935, 947, 505, 281],
    [932, 944, 490, 266],
    [928, 941, 475, 252],
    [925, 939, 461, 239],
];

/// The logit of the confidence from which on an intent is executed while more questions can be asked, for each of
/// [`crate::joint::calibration::RISKS`].
#[rustfmt::skip]
pub const EARLY: [Levels; 4] = [
    [5.792388, 4.908486, 5.386138, 4.264591],
    [3.164439, 3.164439, 4.354141, 3.768774],
    [2.005851, 1.974601, 3.591099, 2.64707],
    [0.833321, 1.34097, 1.228064, 0.856518],
];

/// The logit of the confidence from which on an intent is executed when none can be asked any more, for each of
/// [`crate::joint::calibration::RISKS`].
#[rustfmt::skip]
pub const LAST: [Levels; 4] = [
    [2.369781, 0.996787, 4.063091, 3.179589],
    [1.992862, 0.236574, 2.410063, 2.465529],
    [1.820621, 0.24, 0.789794, 1.477978],
    [2.07489, 0.061167, 0.065859, 0.06],
];
