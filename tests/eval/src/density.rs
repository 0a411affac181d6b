//! The joint model's tables of costs, from the noise that [`crate::noise`] draws.

use std::fmt::Write as _;

use deictic_core::joint::cost::OCTAVE;

use crate::noise::{Level, Noise};

/// Errors from 0 to 255 255ths.
pub const ERRORS: usize = 256;

/// How often an element is anything at all, so that no single one decides alone.
const STRAY: f64 = 0.001;

/// Points of a mean; the midpoint rule then errs by less than a tenth of a cost.
const POINTS: u32 = 64;

/// The levels of the tables.
const LEVELS: [Level; 4] = [Level::N1, Level::N2, Level::N3, Level::N4];

/// Both tables: the costs of elements between 0 and 1, and of those at an end.
#[must_use]
pub fn tables() -> [[[u16; 4]; ERRORS]; 2] {
    let of = |density: fn(usize, Noise) -> f64, whole: f64| {
        std::array::from_fn::<_, ERRORS, _>(|error| {
            LEVELS.map(|level| (1.0 - STRAY) * density(error, level.into()) + STRAY * whole)
        })
    };
    let both = [of(between, 1.0), of(end, 0.5)];
    let octaves = |p: f64| p.log2() * f64::from(OCTAVE);
    let largest = both[0].as_flattened().iter().copied().fold(0.0, f64::max);
    let top = octaves(largest).ceil();
    both.map(|table| table.map(|row| row.map(|p| (top - octaves(p)).round() as u16)))
}

/// The mean density of an error that two roundings made `error` 255ths: theirs is a triangle.
fn between(error: usize, noise: Noise) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in 0..POINTS {
        let off = (f64::from(i) + 0.5) / f64::from(POINTS) * 2.0 - 1.0;
        let weight = 1.0 - off.abs();
        sum += weight * noise.density((error as f64 + off) / 255.0);
        weights += weight;
    }
    sum / weights
}

/// The probability that an error reaches an end which one rounding made `error` 255ths away; of
/// what is expected at the end itself half of all errors do.
fn end(error: usize, noise: Noise) -> f64 {
    if error == 0 {
        return 0.5;
    }
    let beyond = |i: u32| {
        let off = (f64::from(i) + 0.5) / f64::from(POINTS) - 0.5;
        noise.beyond((error as f64 + off) / 255.0)
    };
    (0..POINTS).map(beyond).sum::<f64>() / f64::from(POINTS)
}

/// As short as it can be written for 32 bits, with six digits behind the point at most.
pub(crate) fn six_digits(x: f64) -> f32 {
    ((x * 1e6).round() / 1e6) as f32
}

/// The core's module of tables.
#[must_use]
pub fn source() -> String {
    let mut out = "//! What an element costs by its error and the noise level. Made by `deictic-eval calibrate \
                   --tables`,\n\
                   //! checked by its tests: do not edit.\n\
                   \n\
                   use super::cost::Costs;\n\
                   \n\
                   /// The costs of errors from 0 to 255 255ths.\n\
                   pub type Line = [Costs; 256];\n"
        .to_owned();
    out.push_str(
        "\n/// Of elements between 0 and 1 by their distance from what is expected, then of those at 0 or 1, \
         where\n/// clipping gathers all that lies beyond.\n#[rustfmt::skip]\npub static LINES: [Line; 2] = [\n",
    );
    for (table, doc) in tables().iter().zip(["Between 0 and 1.", "At an end."]) {
        let _ = writeln!(out, "    // {doc}\n    [");
        for row in table {
            let _ = writeln!(out, "        Costs::new({row:?}),");
        }
        out.push_str("    ],\n");
    }
    out.push_str("];\n");
    out.push_str(
        "\n/// The bits of 2 to the power of -i / 32.\n#[rustfmt::skip]\npub static POWERS: [u32; 32] = [\n",
    );
    for row in powers().chunks(4) {
        for bits in row {
            let before = if bits == &row[0] { "    " } else { " " };
            let _ = write!(out, "{before}0x{:04x}_{:04x},", bits >> 16, bits & 0xffff);
        }
        out.push('\n');
    }
    out.push_str("];\n");
    out
}

fn powers() -> [u32; 32] {
    std::array::from_fn(|i| (libm::exp2(-(i as f64) / f64::from(OCTAVE)) as f32).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use deictic_core::joint::tables;

    #[test]
    fn the_committed_tables_are_what_the_noise_makes_them() {
        for (committed, computed) in tables::LINES.iter().zip(tables()) {
            for (i, (committed, computed)) in committed.iter().zip(computed).enumerate() {
                assert_eq!(committed.lanes(), computed, "error {i}");
            }
        }
        assert_eq!(tables::POWERS, powers());
    }
}
