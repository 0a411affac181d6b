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
    [5.047237, 6.166138, 5.550356, 4.964709],
    [4.61012, 4.052975, 4.61012, 4.73512],
    [1.24453, 1.830817, 3.080967, 2.627013],
    [1.233518, 1.400984, 1.550732, 1.056864],
];

/// The logit of the confidence from which on an intent is executed when none can be asked any more, for each of
/// [`crate::joint::calibration::RISKS`].
#[rustfmt::skip]
pub const LAST: [Levels; 4] = [
    [1.077434, 3.865179, 4.013369, 5.044388],
    [2.945105, 3.933976, 2.81557, 2.590171],
    [0.770171, 0.14, 1.164617, 1.880456],
    [0.194517, 0.114085, 0.1, 0.1],
];
