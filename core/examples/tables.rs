//! Computes `core/src/tables.rs`: `cargo run --release -p deictic-core --example tables`.
//!
//! The mean normalised entropy of N independent uniform numbers is N E[phi(u / (u + T))] / ln N with
//! phi(p) = -p ln p, u uniform on 0..1 and T the sum of N - 1 such numbers. Both are put on the
//! midpoints of a grid, where T's distribution is an (N - 1)-fold convolution of a box.

use std::fmt::Write as _;

/// Cells per unit; the midpoint rule then errs by less than 1e-5.
const CELLS: usize = 256;

/// Entry `n` of the table for `n` from 0 to `last`; 1 below two options.
pub fn mean_entropies(last: usize) -> Vec<f64> {
    let mut table = vec![1.0; 2];
    // Probability that the sum of k midpoints is (i + k / 2) / CELLS.
    let mut sum = vec![1.0 / CELLS as f64; CELLS];
    for n in 2..=last {
        let others = (n - 1) as f64 / 2.0;
        let mut mean = 0.0;
        for (i, p) in sum.iter().enumerate().filter(|(_, p)| **p > 1e-12) {
            let t = i as f64 + others;
            let per_u: f64 = (0..CELLS)
                .map(|u| {
                    let share = (u as f64 + 0.5) / (u as f64 + 0.5 + t);
                    -share * share.ln()
                })
                .sum();
            mean += p * per_u / CELLS as f64;
        }
        table.push(n as f64 * mean / (n as f64).ln());
        sum = convolve_with_box(&sum);
    }
    table
}

fn convolve_with_box(of: &[f64]) -> Vec<f64> {
    let mut window = 0.0;
    (0..of.len() + CELLS - 1)
        .map(|i| {
            window += of.get(i).copied().unwrap_or(0.0);
            if i >= CELLS {
                window -= of.get(i - CELLS).copied().unwrap_or(0.0);
            }
            window / CELLS as f64
        })
        .collect()
}

/// Entry `n` of the table of 1 / ln n for `n` from 0 to `last`; 0 below two options.
pub fn inverse_logarithms(last: usize) -> Vec<f64> {
    (0..=last)
        .map(|n| if n < 2 { 0.0 } else { 1.0 / (n as f64).ln() })
        .collect()
}

/// Both tables as Rust source.
pub fn source() -> String {
    let mut out = String::from(
        "//! By number of options. Made by `examples/tables.rs`, checked by `tests/tables.rs`: do not edit.\n",
    );
    let mut table = |doc: &str, name: &str, values: Vec<f64>| {
        write!(
            out,
            "\n/// {doc}, at index N.\npub const {name}: [f32; {}] = [",
            values.len()
        )
        .expect("writing to a string");
        for value in values {
            write!(out, "{:?}, ", value as f32).expect("writing to a string");
        }
        out.push_str("];\n");
    };
    table(
        "Mean normalised entropy of N independent uniform numbers (METHOD, section 4)",
        "MEAN_ENTROPY",
        mean_entropies(64)
            .into_iter()
            .map(|h| (h * 1e6).round() / 1e6)
            .collect(),
    );
    table(
        "1 / ln N, which scales entropies to 0..=1",
        "INVERSE_LN",
        inverse_logarithms(64),
    );
    out
}

#[allow(
    dead_code,
    reason = "the test that includes this file has a main of its own"
)]
fn main() {
    print!("{}", source());
}
