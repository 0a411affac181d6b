//! Confidence intervals of shares.

/// The 95 % quantile of the standard normal distribution, two-sided.
const Z: f64 = 1.959_963_984_540_054;

/// Wilson's score interval at 95 % for `k` of `n`, in percent (Wilson 1927): unlike the normal
/// approximation it stays within 0..=100 and has a width at 0 and 100 %.
#[must_use]
pub fn wilson(k: usize, n: usize) -> [f64; 2] {
    if n == 0 {
        return [0.0, 100.0];
    }
    let (k, n) = (k as f64, n as f64);
    let p = k / n;
    let denominator = 1.0 + Z * Z / n;
    let centre = (p + Z * Z / (2.0 * n)) / denominator;
    let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt() / denominator;
    [
        100.0 * (centre - half).max(0.0),
        100.0 * (centre + half).min(1.0),
    ]
}

#[cfg(test)]
mod tests {
    use super::wilson;

    #[test]
    fn known_intervals() {
        // Newcombe 1998, Table I: 81 of 263 gives 0.2553..0.3662, 0 of 20 gives 0..0.1611.
        let close = |a: [f64; 2], b: [f64; 2]| {
            assert!(
                (a[0] - b[0]).abs() < 0.01 && (a[1] - b[1]).abs() < 0.01,
                "{a:?}"
            );
        };
        close(wilson(81, 263), [25.53, 36.62]);
        close(wilson(0, 20), [0.0, 16.11]);
        close(wilson(20, 20), [83.89, 100.0]);
        assert_eq!(wilson(0, 0), [0.0, 100.0]);
    }
}
