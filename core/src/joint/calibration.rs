//! Made by `deictic-eval calibrate`: do not edit.

use super::{KINDS, Levels};

/// What the posterior's logit is multiplied by, by kinds of words and noise level.
#[rustfmt::skip]
pub const SLOPE: [Levels; KINDS] = [
    [1.026606, 1.566163, 2.515422, 1.879762],
    [0.816194, 0.749657, 1.678389, 3.255568],
    [0.951573, 0.936004, 1.006401, 1.087893],
];

/// What its action's logit is multiplied by, by kinds of words and noise level.
#[rustfmt::skip]
pub const ACTION: [Levels; KINDS] = [
    [0.026445, -0.652782, -1.649311, -1.046427],
    [0.150935, 0.138914, -0.688035, -2.497183],
    [0.075071, 0.031799, -0.01317, 0.053045],
];

/// What is added to both, by kinds of words and noise level.
#[rustfmt::skip]
pub const OFFSET: [Levels; KINDS] = [
    [-0.541342, 0.127584, -0.04084, -0.008241],
    [-0.673333, -0.173923, 0.130196, 1.184656],
    [-0.352312, -0.25114, -0.186544, -0.035132],
];

/// The risks that there are cuts for, smallest first: the share of all commands that are executed
/// wrongly.
pub const RISKS: [f32; 4] = [0.003, 0.01, 0.03, 0.1];

/// For each of them the logit of the confidence from which on an intent is executed.
#[rustfmt::skip]
pub const CUTS: [Levels; 4] = [
    [2.628732, 2.970078, 3.130821, 2.947129],
    [0.18, 0.18, 2.8585, 2.419012],
    [0.12, 0.12, 0.717603, 3.061062],
    [-0.06, -0.06, -0.06, 0.561336],
];
