//! Words of a sensor that says by itself how likely what it saw is under each option: nothing is
//! left to be explained by noise, so a likelihood is a cost as it stands.

use super::cost::{Costs, OCTAVE};
use super::word::{CLASH, DEAREST, put};

/// What a likelihood of `n` 255ths costs. One of 0 counts as 1 in 1000, as no option is less likely.
#[allow(
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects,
    reason = "at compile time, where a panic is an error"
)]
const COSTS: [u16; 256] = {
    let mut costs = [u16::MAX; 256];
    let mut n = 0;
    while n < 256 {
        costs[n] = cost(n as u32);
        n += 1;
    }
    costs
};

/// -32 log2(n / 255), by squaring.
#[allow(
    clippy::arithmetic_side_effects,
    reason = "at compile time, where an overflow is an error"
)]
const fn cost(n: u32) -> u16 {
    if n == 0 {
        return CLASH;
    }
    // In 2^-30ths, doubled until it is from 1 to 2: what that takes are whole octaves.
    let mut x = ((n as u64) << 30) / 255;
    let mut cost = 0;
    while x < 1 << 30 {
        x <<= 1;
        cost += OCTAVE;
    }
    let mut part = OCTAVE / 2;
    while part > 0 && cost > 0 {
        x = (x * x) >> 30;
        if x >= 1 << 31 {
            x >>= 1;
            cost -= part;
        }
        part /= 2;
    }
    cost
}

/// A word of such a sensor.
#[derive(Clone, Copy, Debug)]
pub struct Likely<'a> {
    likelihoods: &'a [f32],
    /// How much the word counts, in 256ths.
    weight: u32,
    /// Whether it is the first of its category: what is added to counts as 0 then.
    first: bool,
    least: u16,
}

impl<'a> Likely<'a> {
    /// One that counts `weight` 256ths.
    pub fn new(likelihoods: &'a [f32], weight: u32, first: bool) -> Self {
        let costs = likelihoods.iter().map(|&p| of(p));
        Self {
            likelihoods,
            weight,
            first,
            least: costs.min().unwrap_or(0),
        }
    }

    /// Adds what it costs these options, relative to the likeliest of all.
    pub fn add(&self, options: &[u8], heard: &mut [Costs]) {
        for (heard, &option) in heard.iter_mut().zip(options) {
            let Some(&p) = self.likelihoods.get(usize::from(option)) else {
                continue;
            };
            let cost = of(p).saturating_sub(self.least).min(CLASH);
            let cost = Costs::all(cost).weighed(self.weight);
            put(heard, cost.least(Costs::all(DEAREST)), self.first);
        }
    }
}

fn of(likelihood: f32) -> u16 {
    let n = (likelihood * 255.0 + 0.5) as usize;
    COSTS.get(n).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_are_logarithms() {
        for n in 1..=255_u32 {
            let exact = -32.0 * (f64::from(n) / 255.0).log2();
            let off = f64::from(COSTS[n as usize]) - exact;
            assert!((-0.1..=1.1).contains(&off), "{n}: {off}");
        }
        assert!(COSTS.windows(2).all(|pair| pair[0] >= pair[1]));
        assert_eq!(COSTS[255], 0);
    }

    #[test]
    fn the_likeliest_costs_nothing() {
        let costs = |weight| {
            let mut costs = [Costs::all(7); 5];
            Likely::new(&[0.25, 0.5, 0.0, 1.0, f32::NAN], weight, true)
                .add(&[0, 1, 2, 3, 4], &mut costs);
            costs.map(|c| c.lanes()[0])
        };
        let [quarter, half, never, sure, nothing] = costs(256);
        assert_eq!((sure, never, nothing), (0, CLASH, CLASH));
        assert!((31..=33).contains(&(quarter - half)));
        assert_eq!(costs(128)[0], quarter / 2);
        assert_eq!(costs(16 * 256)[2], DEAREST);
    }
}
