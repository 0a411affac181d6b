//! The word that a hand is in the middle of: what has been shown of it so far, and what it comes to.
//!
//! A hand that lets go of a gesture, or leaves, spoils what it showed last. So a word gathers in two
//! places, the settled and the recent, and only what was shown at least [`SPOILT`] before its end
//! counts, unless there was nothing else.

use heapless::Vec;

use super::pointing::{self, Aim, Meant, Ray};
use super::vector::{self, Vector};
use crate::category::Category;
use crate::math;
use crate::scene::Scene;
use crate::sentence::Word;
use crate::time::Micros;
use crate::vocabulary::Vocabulary;

/// How long before its end a hand may already be letting go.
pub const SPOILT: Micros = Micros::from_millis(150);

/// A weighted sum of `K` numbers over time, apart by age.
#[derive(Clone, Debug)]
struct Sums<const K: usize> {
    settled: [f32; K],
    settled_weight: f32,
    recent: [f32; K],
    recent_weight: f32,
    /// Moves from the recent to the settled when the recent begins to be older than [`SPOILT`].
    middle: [f32; K],
    middle_weight: f32,
    since: Micros,
}

impl<const K: usize> Sums<K> {
    const fn new(now: Micros) -> Self {
        Self {
            settled: [0.0; K],
            settled_weight: 0.0,
            recent: [0.0; K],
            recent_weight: 0.0,
            middle: [0.0; K],
            middle_weight: 0.0,
            since: now,
        }
    }

    fn add(&mut self, now: Micros, values: &[f32; K], weight: f32) {
        if now.since(self.since) >= SPOILT {
            for (settled, middle) in self.settled.iter_mut().zip(self.middle) {
                *settled += middle;
            }
            self.settled_weight += self.middle_weight;
            (self.middle, self.middle_weight) = (self.recent, self.recent_weight);
            (self.recent, self.recent_weight) = ([0.0; K], 0.0);
            self.since = now;
        }
        for (sum, value) in self.recent.iter_mut().zip(values) {
            *sum += weight * value;
        }
        self.recent_weight += weight;
    }

    /// The mean of what is settled, else of everything.
    fn mean(&self) -> Option<[f32; K]> {
        let (mut sum, mut weight) = (self.settled, self.settled_weight);
        if weight <= 0.0 {
            weight = self.middle_weight + self.recent_weight;
            for (sum, (middle, recent)) in sum.iter_mut().zip(self.middle.iter().zip(self.recent)) {
                *sum = middle + recent;
            }
        }
        (weight > 0.0).then(|| sum.map(|x| x / weight))
    }
}

/// A word that is being shown.
#[derive(Clone, Debug)]
pub enum Open<const N: usize> {
    /// The hand points.
    Target(Target),
    /// The hand shows a shape that stands for an action.
    Action(Deed<N>),
}

/// What has been pointed at.
#[derive(Clone, Debug)]
pub struct Target {
    /// Origin and direction of the ray.
    ray: Sums<6>,
}

impl Target {
    /// A hand that begins to point.
    #[must_use]
    pub const fn new(now: Micros) -> Self {
        Self {
            ray: Sums::new(now),
        }
    }

    /// It pointed there, while its palm moved at this many mm/s. A hand on its way counts little.
    pub fn add(&mut self, now: Micros, ray: &Ray, speed: f32) {
        let [ox, oy, oz] = ray.origin;
        let [dx, dy, dz] = ray.direction;
        let slow = speed / 100.0;
        let weight = 1.0 / (1.0 + slow * slow);
        self.ray.add(now, &[ox, oy, oz, dx, dy, dz], weight);
    }

    /// Where it pointed on average.
    #[must_use]
    pub fn ray(&self) -> Option<Ray> {
        let [ox, oy, oz, dx, dy, dz] = self.ray.mean()?;
        Some(Ray {
            origin: [ox, oy, oz],
            direction: vector::unit([dx, dy, dz])?,
        })
    }
}

/// What has been shown of an action.
#[derive(Clone, Debug)]
pub struct Deed<const N: usize> {
    /// The action that opened the word.
    action: u8,
    likelihoods: Sums<N>,
}

impl<const N: usize> Deed<N> {
    /// A hand that begins to show `action`.
    #[must_use]
    pub const fn new(now: Micros, action: u8) -> Self {
        Self {
            action,
            likelihoods: Sums::new(now),
        }
    }

    /// The action that opened the word.
    #[must_use]
    pub const fn action(&self) -> u8 {
        self.action
    }

    /// Its gestures had these probabilities, added up by action.
    pub fn add(&mut self, now: Micros, likelihoods: &[f32; N]) {
        self.likelihoods.add(now, likelihoods, 1.0);
    }

    /// The word, for a vocabulary with this many actions.
    #[must_use]
    pub fn word<const C: usize>(&self, actions: usize) -> Option<Word<C, N>> {
        action_word(&self.likelihoods.mean()?, actions)
    }
}

/// An action word with these likelihoods; `None` when there is nothing to it.
#[must_use]
pub fn action_word<const C: usize, const N: usize>(
    likelihoods: &[f32; N],
    actions: usize,
) -> Option<Word<C, N>> {
    let likelihoods = likelihoods.map(math::clamp_unit);
    let word = Word::certain(Category::ACTION, likelihoods.get(..actions)?).ok()?;
    word.is_present().then_some(word)
}

/// What a ray means in a scene.
#[must_use]
pub fn meant<const E: usize, const F: usize>(
    ray: &Ray,
    scene: &Scene<E, F>,
    aim: &Aim,
) -> Meant<E> {
    let positions = scene.entities().iter().map(|e| -> Vector { e.position });
    pointing::meant(ray, positions, aim)
}

/// The target word of a ray; `None` when it means nothing in the scene. The first target of a
/// sentence is rather an object, a later one rather a storage, which matters for things that can be
/// both.
#[must_use]
pub fn target_word<const N: usize, const C: usize, const E: usize, const F: usize>(
    meant: &Meant<E>,
    scene: &Scene<E, F>,
    vocabulary: &Vocabulary<N, C, F>,
    first: bool,
) -> Option<Word<C, N>> {
    let mut categories = [0.0; 3];
    for (entity, p) in scene.entities().iter().zip(&meant.points) {
        let expected = (entity.category == Category::OBJECT) == first;
        if let Some(sum) = categories.get_mut(entity.category.index()) {
            *sum += if expected { *p } else { 0.8 * p };
        }
    }
    let category = Category::from_index(math::argmax(&categories)?)?;
    let mut likelihoods = Vec::<f32, N>::new();
    likelihoods
        .resize(vocabulary.options_of(category), 0.0)
        .ok()?;
    for (entity, p) in scene.entities().iter().zip(&meant.points) {
        if entity.category == category
            && let Some(place) = likelihoods.get_mut(usize::from(entity.option))
        {
            *place = math::clamp_unit(*p);
        }
    }
    let word = Word::new(&categories.map(math::clamp_unit), &likelihoods).ok()?;
    word.is_present().then_some(word)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Entity;
    use crate::vocabulary::Action;

    fn ms(n: u64) -> Micros {
        Micros::from_millis(n)
    }

    #[test]
    fn the_last_moments_do_not_spoil_a_word() {
        let mut target = Target::new(ms(0));
        let ray = |y: f32| Ray {
            origin: [0.0; 3],
            direction: [1.0, y, 0.0],
        };
        for t in (0..800).step_by(9) {
            let y = if t < 650 { 0.0 } else { 2.0 };
            target.add(ms(t), &ray(y), 0.0);
        }
        let kept = target.ray().unwrap();
        assert!(kept.direction[1] < 1e-3, "{kept:?}");
    }

    #[test]
    fn a_word_that_was_hardly_shown_counts_whole() {
        let mut deed = Deed::<2>::new(ms(0), 1);
        deed.add(ms(5), &[0.25, 0.75]);
        let word: Word<4, 2> = deed.word(2).unwrap();
        assert_eq!(word.likelihoods(), [0.25, 0.75]);
        assert_eq!(Deed::<2>::new(ms(0), 1).word::<4>(2), None);
    }

    #[test]
    fn a_thing_that_can_be_both_is_an_object_first_and_a_storage_then() {
        let vocabulary =
            Vocabulary::<4, 4, 4>::new(&[Action::default()], &[2, 2], 0, None, 0).unwrap();
        let mut scene = Scene::<4, 4>::new(1);
        for (category, option, y) in [
            (Category::OBJECT, 1, 0.0),
            (Category::STORAGE, 0, 0.0),
            (Category::OBJECT, 0, 1.0),
        ] {
            let entity = Entity {
                category,
                option,
                position: [1.0, y, 0.0],
                features: Vec::new(),
            };
            scene.push(entity, &vocabulary).unwrap();
        }
        let ray = Ray {
            origin: [0.0; 3],
            direction: [1.0, 0.0, 0.0],
        };
        let meant = meant(&ray, &scene, &Aim::DEFAULT);
        let first = target_word(&meant, &scene, &vocabulary, true).unwrap();
        assert_eq!(first.category(), Some(Category::OBJECT));
        assert!(first.likelihoods()[1] > 0.4 && first.likelihoods()[0] < 0.01);
        let second = target_word(&meant, &scene, &vocabulary, false).unwrap();
        assert_eq!(second.category(), Some(Category::STORAGE));
        let away = Ray {
            direction: [-1.0, 0.0, 0.0],
            ..ray
        };
        let meant = super::meant(&away, &scene, &Aim::DEFAULT);
        assert_eq!(target_word(&meant, &scene, &vocabulary, true), None);
    }
}
