//! What the unit sees of a hand, for people who want to look over its shoulder.

use heapless::Vec;

use super::hand::Hand;
use crate::math;
use crate::protocol::hand::{Glimpse, Guess, HandView, VIEWED};
use crate::scene::Scene;

impl<const N: usize, const C: usize, const W: usize> Hand<N, C, W> {
    /// What the unit sees of a hand before this scene.
    pub(super) fn view<const E: usize, const F: usize>(
        &self,
        scene: Option<&Scene<E, F>>,
    ) -> HandView {
        let reader = &self.reader;
        let mut view = HandView {
            hand: reader.hand(),
            shapes: *reader.shapes(),
            shown: reader.shown(),
            no_stroke: 1.0,
            nothing: 1.0,
            ..HandView::default()
        };
        if let Some(likely) = reader.likely() {
            view.strokes = likeliest(&likely.gestures);
            view.no_stroke = likely.none;
        }
        if let Some(scene) = scene
            && let Some(meant) = reader.meant(scene, &self.settings.aim)
        {
            view.pointed = likeliest(&meant.points);
            view.nothing = meant.nothing;
        }
        for word in reader.words() {
            let best = math::argmax(word.likelihoods());
            if let (Some(category), Some(best)) = (word.category(), best) {
                // Full: no person says so much with one hand.
                let _ = view.words.push(Glimpse {
                    category,
                    option: u8::try_from(best).unwrap_or(u8::MAX),
                    likelihood: word.likelihoods().get(best).copied().unwrap_or_default(),
                });
            }
        }
        view
    }
}

/// The largest of some probabilities, largest first; those below 1 in 1,000 are left out.
fn likeliest(probabilities: &[f32]) -> Vec<Guess, VIEWED> {
    let mut found = Vec::<Guess, VIEWED>::new();
    while !found.is_full() {
        let mut best = Guess { number: 0, p: 1e-3 };
        for (p, number) in probabilities.iter().zip(0_u8..) {
            if *p > best.p && !found.iter().any(|g| g.number == number) {
                best = Guess { number, p: *p };
            }
        }
        if best.p <= 1e-3 || found.push(best).is_err() {
            break;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_likeliest_come_first_and_the_improbable_not_at_all() {
        let numbers =
            |p: &[f32]| -> std::vec::Vec<u8> { likeliest(p).iter().map(|g| g.number).collect() };
        assert_eq!(numbers(&[0.1, 0.0, 0.5, 0.1, 0.3]), [2, 4, 0, 3]);
        assert_eq!(numbers(&[f32::NAN, 0.0, 1e-4]), [0_u8; 0]);
        assert_eq!(numbers(&[0.05; 20]), [0, 1, 2, 3, 4, 5, 6, 7]);
    }
}
