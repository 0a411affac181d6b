//! Evidence as costs: how improbable something is at each noise level, in 32nds of a power of two.
//!
//! Whole numbers make the board's bits the host's, and four levels in two words make one table
//! look-up and two additions serve all of them.

/// Costs per factor of two.
pub const OCTAVE: u16 = 32;

/// What a single cost can be at most, for [`Costs::least`] to tell which is smaller.
pub const MOST: u16 = 0x7fff;

/// The first bit of every lane.
const TOP: u32 = 0x8000_8000;

/// One cost per noise level, 16 bits each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Costs([u32; 2]);

impl Costs {
    /// Certain at every level.
    pub const ZERO: Self = Self([0, 0]);

    /// The same at every level.
    #[must_use]
    pub const fn all(cost: u16) -> Self {
        Self::new([cost; 4])
    }

    /// These costs, from the lowest level on.
    #[must_use]
    pub const fn new([a, b, c, d]: [u16; 4]) -> Self {
        Self([
            (b as u32).wrapping_shl(16) | a as u32,
            (d as u32).wrapping_shl(16) | c as u32,
        ])
    }

    /// The costs, from the lowest level on.
    #[must_use]
    #[inline(always)]
    pub const fn lanes(self) -> [u16; 4] {
        let Self([ab, cd]) = self;
        [
            ab as u16,
            ab.wrapping_shr(16) as u16,
            cd as u16,
            cd.wrapping_shr(16) as u16,
        ]
    }

    /// The cost at a level, of which only the lowest two bits count.
    #[must_use]
    #[inline(always)]
    pub const fn at(self, level: usize) -> u32 {
        let Self([ab, cd]) = self;
        let pair = if level & 2 == 0 { ab } else { cd };
        pair.wrapping_shr((level as u32 & 1).wrapping_shl(4)) & 0xffff
    }

    /// Both together. Sums must stay below 2^16.
    #[must_use]
    #[inline(always)]
    pub const fn plus(self, other: Self) -> Self {
        let (Self([a, b]), Self([c, d])) = (self, other);
        Self([a.wrapping_add(c), b.wrapping_add(d)])
    }

    /// So many of them together. The sum must stay below 2^16.
    #[must_use]
    #[inline(always)]
    pub const fn times(self, count: usize) -> Self {
        let Self([a, b]) = self;
        Self([a.wrapping_mul(count as u32), b.wrapping_mul(count as u32)])
    }

    /// What is left of these costs without `other`, none of which may be larger.
    #[must_use]
    #[inline(always)]
    pub const fn minus(self, other: Self) -> Self {
        let (Self([a, b]), Self([c, d])) = (self, other);
        Self([a.wrapping_sub(c), b.wrapping_sub(d)])
    }

    /// The smaller at every level, of costs up to [`MOST`].
    #[must_use]
    #[inline(always)]
    pub const fn least(self, other: Self) -> Self {
        let (Self([a, b]), Self([c, d])) = (self, other);
        Self([least(a, c), least(b, d)])
    }

    /// To be compared with often.
    #[must_use]
    #[inline(always)]
    pub const fn bar(self) -> Bar {
        let Self([a, b]) = self;
        Bar([a | TOP, b | TOP])
    }

    /// By how much it is below the bar at every level; 0 where it is not.
    #[must_use]
    #[inline(always)]
    pub const fn below(self, bar: Bar) -> Self {
        let (Self([a, b]), Bar([c, d])) = (self, bar);
        Self([below(a, c), below(b, d)])
    }

    /// `weight` 256ths of it, no more than [`MOST`].
    #[must_use]
    pub fn weighed(self, weight: u32) -> Self {
        Self::new(self.lanes().map(|cost| {
            let cost = u32::from(cost).saturating_mul(weight).wrapping_shr(8);
            cost.min(u32::from(MOST)) as u16
        }))
    }

    /// The smallest of all.
    #[must_use]
    pub fn lowest(self) -> u16 {
        let [a, b, c, d] = self.lanes();
        a.min(b).min(c).min(d)
    }
}

/// Costs up to [`MOST`] with a guard bit before every lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bar([u32; 2]);

impl Bar {
    /// Nothing is below it.
    pub const ZERO: Self = Costs::ZERO.bar();

    /// The costs.
    #[must_use]
    #[inline(always)]
    pub const fn costs(self) -> Costs {
        let Self([a, b]) = self;
        Costs([a & !TOP, b & !TOP])
    }
}

/// The smaller of each pair of lanes.
#[inline(always)]
const fn least(a: u32, b: u32) -> u32 {
    b.wrapping_sub(below(a, b | TOP))
}

/// By how much each lane is below that of `bar`, whose guard bit is left over where it is.
#[inline(always)]
const fn below(a: u32, bar: u32) -> u32 {
    let difference = bar.wrapping_sub(a);
    let smaller = difference & TOP;
    difference & smaller.wrapping_sub(smaller.wrapping_shr(15))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_do_not_disturb_each_other() {
        let cases = [[0, MOST, 3, 9], [MOST, 0, 9, 3], [5, 5, MOST, MOST]];
        for a in cases {
            for b in cases {
                let (x, y) = (Costs::new(a), Costs::new(b));
                let expect = |f: fn(u16, u16) -> u16| core::array::from_fn(|i| f(a[i], b[i]));
                assert_eq!(x.least(y).lanes(), expect(u16::min));
                assert_eq!(x.plus(y).lanes(), expect(|a, b| a + b));
                assert_eq!(x.plus(y).minus(y), x);
                assert_eq!(y.minus(x.below(y.bar())), x.least(y));
                assert_eq!(y.bar().costs(), y);
                for (level, &cost) in a.iter().enumerate() {
                    assert_eq!(x.at(level), u32::from(cost));
                }
            }
        }
        let costs = Costs::new([0, 100, MOST, 7]);
        assert_eq!(costs.weighed(512).lanes(), [0, 200, MOST, 14]);
        assert_eq!(costs.weighed(128).lanes(), [0, 50, MOST / 2, 3]);
        assert_eq!(Costs::new([9, 4, 5, 6]).lowest(), 4);
    }
}
