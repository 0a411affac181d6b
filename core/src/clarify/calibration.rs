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
    [5.112614, 6.224486, 5.2252, 4.736358],
    [3.523635, 3.864159, 4.628628, 3.7777],
    [0.825398, 1.903104, 2.499202, 2.813814],
    [0.858931, 1.151634, 0.898587, 0.997887],
];

/// The logit of the confidence from which on an intent is executed when none can be asked any more, for each of
/// [`crate::joint::calibration::RISKS`].
#[rustfmt::skip]
pub const LAST: [Levels; 4] = [
    [2.711193, 3.834618, 5.234038, 3.500961],
    [2.778674, 2.61366, 2.869216, 2.31876],
    [0.199001, 0.152037, 1.256235, 1.578453],
    [0.16063, 0.02, 0.02, 0.02],
];
