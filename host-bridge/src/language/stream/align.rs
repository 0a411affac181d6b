//! Alignment of the voice's tokens with the slots of a sentence: Needleman and Wunsch's dynamic
//! programme, with one cost for the first slot that was cut off at the end and less for the rest.

/// ln of the probability that a word says nothing: a hesitation that covers no word is as rare.
const EXTRA: f64 = -4.2;
/// ln of the probability that a slot in the middle has no word.
const SKIPPED: f64 = -4.6;
/// ln of the probability that the voice was cut off before a slot.
const CUT: f64 = -3.0;
/// The same for every further slot behind it.
const CUT_ON: f64 = -0.7;

/// Where each slot's word is, and how good the alignment is (ln of its probability).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Alignment {
    pub score: f64,
    pub tokens: Vec<Option<usize>>,
}

/// Aligns in order. `fit(slot, token)` is ln of the probability of a slot with that token, or with
/// none.
pub(super) fn align(
    slots: usize,
    tokens: usize,
    fit: impl Fn(usize, Option<usize>) -> f64,
) -> Alignment {
    let width = tokens + 1;
    let mut best = vec![f64::NEG_INFINITY; (slots + 1) * width];
    let mut step = vec![Step::Extra; (slots + 1) * width];
    for s in 0..=slots {
        for t in 0..=tokens {
            let mut top = if s + t == 0 { 0.0 } else { f64::NEG_INFINITY };
            let mut from = Step::Extra;
            let mut offer = |score: f64, way: Step| {
                if score > top {
                    (top, from) = (score, way);
                }
            };
            if t > 0 {
                offer(best[s * width + t - 1] + EXTRA, Step::Extra);
            }
            if s > 0 {
                let cost = match (t == tokens, step[(s - 1) * width + t]) {
                    (true, Step::Skip) if s > 1 => CUT_ON,
                    (true, _) => CUT,
                    _ => SKIPPED,
                };
                offer(
                    best[(s - 1) * width + t] + cost + fit(s - 1, None),
                    Step::Skip,
                );
            }
            if s > 0 && t > 0 {
                offer(
                    best[(s - 1) * width + t - 1] + fit(s - 1, Some(t - 1)),
                    Step::Match,
                );
            }
            best[s * width + t] = top;
            step[s * width + t] = from;
        }
    }
    let mut places = vec![None; slots];
    let (mut s, mut t) = (slots, tokens);
    while s + t > 0 {
        match step[s * width + t] {
            Step::Extra => t -= 1,
            Step::Skip => s -= 1,
            Step::Match => {
                (s, t) = (s - 1, t - 1);
                places[s] = Some(t);
            }
        }
    }
    Alignment {
        score: best[slots * width + tokens],
        tokens: places,
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Step {
    Extra,
    Skip,
    Match,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_find_their_slots_in_order() {
        let fit = |slot: usize, token: Option<usize>| match token {
            Some(t) if [0, 2].get(slot) == Some(&t) => 0.0,
            Some(_) => -10.0,
            None => 0.0,
        };
        let aligned = align(2, 3, fit);
        assert_eq!(aligned.tokens, [Some(0), Some(2)]);
        assert_eq!(aligned.score, EXTRA);
    }

    #[test]
    fn what_is_cut_off_costs_once_more_than_the_rest() {
        let fit = |slot: usize, token: Option<usize>| match token {
            Some(t) if t == slot => 0.0,
            Some(_) => -10.0,
            None => 0.0,
        };
        assert_eq!(align(3, 1, fit).score, CUT + CUT_ON);
        assert_eq!(align(0, 0, fit).score, 0.0);
        assert_eq!(align(2, 0, fit).tokens, [None, None]);
    }

    #[test]
    fn every_slot_gets_another_token() {
        for slots in 0..5 {
            for tokens in 0..5 {
                let aligned = align(slots, tokens, |s, t| -((s + t.unwrap_or(9)) as f64));
                let used: Vec<_> = aligned.tokens.iter().flatten().collect();
                assert!(used.windows(2).all(|w| w[0] < w[1]));
            }
        }
    }
}
