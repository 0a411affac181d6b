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
    [5.069512, 6.125087, 6.423428, 6.478222],
    [4.531505, 4.106431, 7.303934, 3.414665],
    [1.7539, 1.469906, 4.130915, 3.337387],
    [1.233726, 1.405144, 1.541941, 1.063435],
];

/// The logit of the confidence from which on an intent is executed when none can be asked any more, for each of
/// [`crate::joint::calibration::RISKS`].
#[rustfmt::skip]
pub const LAST: [Levels; 4] = [
    [2.915602, 3.438495, 4.25249, 4.74662],
    [3.049728, 3.746848, 2.91268, 2.488796],
    [1.3954, 0.22, 1.562236, 1.478035],
    [0.288363, 0.130264, 0.1, 0.1],
];
