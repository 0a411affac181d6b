//! Rivals: options that are raised beside the one that was meant, as if they were named themselves.
//!
//! They are scattered (a few anywhere), or all actions of another signature are raised at once, as when someone
//! shows `pick` with a hand that says `put into` as well (the paper's `D_arity`). Those that are raised together
//! because they cannot be done here share one error (`D_prop`): counted one by one it would look like as many
//! errors, and like more noise than there is.

use super::cost::{Bar, Costs};
use super::element::{Element, Seen};

/// How much a rival costs beside an element that is none: 19 to 1 among actions ...
pub const RIVAL_ACTION: Costs = Costs::all(136);
/// ... and 9 to 1 in other words.
pub const RIVAL: Costs = Costs::all(101);
/// What an element of another signature costs that is raised with all of them, beside one without
/// any rivals: 95 to 80 ...
pub const RAISED: Costs = Costs::all(8);
/// ... and one that is not raised for all that: 118 to 1.
pub const NOT_RAISED: Costs = Costs::all(220);

/// What is at least raised. Less is what words of nothing in particular have, typed ones to the digit.
const HIGH: f32 = 0.5;

/// Which elements of an action word do not count, from the lowest bit on: of those that are high, read alike and are not
/// weighed (`live` are, in rising order) all but the first.
#[inline(never)]
pub fn repeated(likelihoods: &[f32], mut live: &[u8]) -> u64 {
    let mut repeated = 0_u64;
    // Half of the readings are high.
    let mut known = [0_u32; 4];
    for (&likelihood, option) in likelihoods.iter().zip(0_u8..) {
        if let [next, rest @ ..] = live
            && *next == option
        {
            live = rest;
        } else if likelihood >= HIGH {
            let (place, reading) = Seen::new(likelihood).place();
            if let Some(known) = known.get_mut(place & 3) {
                if *known & reading != 0 {
                    repeated |= 1_u64.wrapping_shl(u32::from(option));
                }
                *known |= reading;
            }
        }
    }
    repeated
}

/// Leaves these elements out of a sum of what all cost without `rival`: they cost nothing, however they are explained.
#[inline(always)]
pub fn leave_out(mut which: u64, elements: &mut [Element], sum: Costs, rival: Costs) -> Costs {
    let mut sum = sum;
    while which != 0 {
        if let Some(element) = elements.get_mut(which.trailing_zeros() as usize) {
            sum = sum.minus(element.other.costs().minus(rival));
            (element.other, element.raised) = (Bar::ZERO, Bar::ZERO);
        }
        which &= which.wrapping_sub(1);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_raised_alike_and_cannot_be_done_counts_once() {
        let word = [0.8, 0.8, 0.5, 0.8, 1.0, 0.5, 1.0, 0.79];
        assert_eq!(repeated(&word, &[]), 0b0110_1010);
        assert_eq!(repeated(&word, &[1, 3, 6]), 0b0010_0000);
        assert_eq!(repeated(&word, &[0, 1, 2, 3, 4, 5, 6, 7]), 0);
    }

    #[test]
    fn what_is_not_raised_counts_however_alike() {
        assert_eq!(repeated(&[0.3, 0.3, 0.0, 0.3, 0.0, 0.499], &[]), 0);
        assert_eq!(repeated(&[f32::NAN, f32::NAN], &[]), 0);
    }

    #[test]
    fn as_many_as_there_can_be() {
        let mut word = [0.9; 64];
        assert_eq!(repeated(&word, &[]), u64::MAX - 1);
        word[63] = 0.6;
        assert_eq!(repeated(&word, &[62]), (1 << 62) - 2);
    }
}
