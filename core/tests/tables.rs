//! The committed tables are what their generator computes, and white noise what drawing numbers gives.

#[path = "../examples/tables.rs"]
mod generator;

use deictic_core::entropy::{diagonal_cross_entropy, white_noise};
use deictic_core::tables::INVERSE_LN;

#[test]
fn the_table_is_the_generators() {
    for (n, value) in generator::mean_entropies(12).into_iter().enumerate() {
        let table = f64::from(white_noise(n));
        assert!(
            (table - value).abs() < 2e-6,
            "N = {n}: {table} in the table, {value} computed"
        );
    }
}

#[test]
fn inverse_logarithms_are_the_generators_to_the_bit() {
    for (n, value) in generator::inverse_logarithms(64).into_iter().enumerate() {
        assert_eq!(INVERSE_LN[n].to_bits(), (value as f32).to_bits(), "N = {n}");
    }
}

#[test]
fn drawn_numbers_agree() {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut uniform = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1_u32 << 24) as f32
    };
    for n in [2, 4, 9, 33] {
        let draws = 20_000;
        let mut h = vec![0.0; n];
        let mean = (0..draws)
            .map(|_| {
                let w: Vec<f32> = (0..n).map(|_| uniform()).collect();
                f64::from(diagonal_cross_entropy(&w, &mut h))
            })
            .sum::<f64>()
            / f64::from(draws);
        // The standard error is largest, 0.0015, at N = 2.
        assert!(
            (mean - f64::from(white_noise(n))).abs() < 0.006,
            "N = {n}: mean {mean}"
        );
    }
}
