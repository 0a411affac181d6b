//! The orders in which the parts of a sentence may come.

/// All orders of `n` things, with the number of pairs that are out of order.
pub(super) fn permutations(n: usize) -> Vec<(Vec<usize>, usize)> {
    let mut all = vec![(Vec::new(), 0)];
    for next in 0..n {
        all = all
            .into_iter()
            .flat_map(|(order, swaps)| {
                (0..=order.len()).map(move |at| {
                    let mut longer = order.clone();
                    longer.insert(at, next);
                    (longer, swaps + order.len() - at)
                })
            })
            .collect();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_are_complete_and_the_first_has_no_swap() {
        for (n, count) in [(0, 1), (1, 1), (3, 6), (4, 24)] {
            let mut all = permutations(n);
            assert_eq!(all.iter().filter(|(_, swaps)| *swaps == 0).count(), 1);
            all.sort();
            all.dedup();
            assert_eq!(all.len(), count);
        }
    }
}
