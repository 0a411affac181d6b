//! All that goes on while the arm moves: a hand in front of the sensor, a person who talks, a table that changes, and
//! lines full of noise.

use std::collections::VecDeque;

use deictic::hand::session::{Act, made_up};
use deictic::hand::source::recording::framed;
use deictic::session::Session;
use deictic_bits::random::Random;
use deictic_core::gesture::pointing::Mount;
use deictic_core::gesture::shape::Shape;
use deictic_core::large::Sentence;

use crate::network::world::World;

/// Frames of the hand sensor in a second: one in every eighth control period.
pub const RATE: f64 = 125.0;

/// Every so many control periods: a frame of the hand, a sentence, another table.
const FRAME_EVERY: u64 = 8;
const SENTENCE_EVERY: u64 = 90;
const TABLE_EVERY: u64 = 40;

/// Bytes of noise on the unit's line in every control period and either direction: as many as fit beside all else at
/// 921,600 baud.
const NOISE: u32 = 60;

/// What is still to come.
pub struct Load {
    hand: VecDeque<Vec<u8>>,
    talk: Sentence,
    periods: u64,
    noise: Random,
}

impl Load {
    /// A person who points about, and at the end shows the stop gesture. What they say all the while is never enough
    /// to be done.
    #[must_use]
    pub fn new(seed: u64, talk: Sentence) -> Self {
        let mut random = Random::new(seed);
        let mut acts = Vec::new();
        for _ in 0..1 + random.below(3) {
            let y = 0.4 - 0.8 * random.unit();
            acts.push(Act::Point([-0.5, y, 0.05]));
            acts.push(Act::Show(Shape::Grab));
        }
        acts.push(Act::Show(Shape::Two));
        let samples = made_up(seed, Mount::DEFAULT, 0.03, &acts, RATE);
        Self {
            hand: samples.iter().map(framed).collect(),
            talk,
            periods: 0,
            noise: random,
        }
    }

    /// What happens in one control period.
    pub fn turn(&mut self, world: &World, session: &mut Session<'_>) {
        self.periods += 1;
        let mut noise: Vec<u8> = (1..NOISE)
            .map(|_| self.noise.below(255) as u8 + 1)
            .collect();
        noise.push(0);
        world.disturb(&noise);
        let due = |every: u64| self.periods.is_multiple_of(every);
        if due(FRAME_EVERY) {
            let frame = self.hand.pop_front();
            world.sense(&frame.unwrap_or_default());
        }
        // A unit that is not there hears nothing of either.
        if due(SENTENCE_EVERY) {
            let _ = session.observe(self.talk.clone());
        }
        if due(TABLE_EVERY) {
            let mut things = session.table().scene().entities().to_vec();
            if let Some(thing) = things.last_mut() {
                let away = if due(2 * TABLE_EVERY) { 1e-3 } else { -1e-3 };
                thing.position[2] += away;
            }
            let _ = session.lay(things);
        }
    }
}
