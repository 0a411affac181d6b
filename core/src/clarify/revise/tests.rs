use super::*;
use crate::category::{Category, CategorySet};
use crate::joint::fits::{Fits, Kind, Row, Rows, Thing};
use crate::joint::level::Weighed;
use crate::joint::survey::Survey;
use crate::vocabulary::Action;
use std::vec::Vec;

const N: usize = 4;

/// Some numbers, alike on every machine.
fn some(seed: &mut u32, below: u32) -> u32 {
    *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    (*seed >> 8) % below
}

#[test]
fn what_costs_all_alike_changes_nothing() {
    let mut actions = [Action::default(); 3];
    actions[1].signature.compulsory = CategorySet::EMPTY.with(1);
    actions[1].object.wanted = CategorySet::EMPTY.with(0);
    actions[2].signature.compulsory = CategorySet::EMPTY.with(1).with(2);
    actions[2].object.wanted = CategorySet::EMPTY.with(1);
    actions[2].storage.unwanted = CategorySet::EMPTY.with(0);
    let spoken = CategorySet::EMPTY.with(0).with(1).with(2);
    for round in 0..200 {
        let seed = &mut (round + 1);
        let features: Vec<[f32; 2]> = (0..2 * N)
            .map(|_| std::array::from_fn(|_| [0.0, 0.6, 1.0][some(seed, 3) as usize]))
            .collect();
        let things: Vec<Thing<'_>> = (0_u8..)
            .zip(&features)
            .map(|(i, features)| Thing {
                option: i % 4,
                features,
            })
            .collect();
        let (mut rows, mut of) = ([[Row::NONE; 3]; 2], [[0; 2]; 3]);
        let (mut bytes, mut usable) = ([[0; 3 * N]; 2], [[false; N]; 2]);
        let (mut live, mut possible) = ([[0; N]; 2], [0.0; 3]);
        let [object_rows, storage_rows] = &mut rows;
        let [object_bytes, storage_bytes] = &mut bytes;
        let [usable_objects, usable_storages] = &mut usable;
        let kind = |category| Rows {
            category,
            things: &things[(category.index() - 1) * N..][..N],
            rows: &mut [],
            used: 0,
            bytes: &mut [],
            stride: N,
            usable: &mut [],
        };
        let mut survey = Survey {
            actions: &actions,
            spoken,
            prior: &mut [0; 3],
            kinds: [
                Rows {
                    rows: object_rows,
                    bytes: object_bytes,
                    usable: usable_objects,
                    ..kind(Category::OBJECT)
                },
                Rows {
                    rows: storage_rows,
                    bytes: storage_bytes,
                    usable: usable_storages,
                    ..kind(Category::STORAGE)
                },
            ],
            of: &mut of,
            possible: &mut possible,
        };
        survey.run();
        let mut used = [0; 2];
        let kinds = survey.kinds.iter_mut().zip(&mut live).zip(&mut used);
        let live: Vec<&[u8]> = kinds
            .map(|((kind, live), used)| {
                *used = kind.used;
                let count = kind.close(live);
                &live[..count]
            })
            .collect();
        let mut costs = |n: usize| -> Vec<Costs> {
            (0..n)
                .map(|_| Costs::new(std::array::from_fn(|_| some(seed, 120) as u16)))
                .collect()
        };
        let live_actions: Vec<u8> = (0..3).filter(|a| possible[usize::from(*a)] > 0.0).collect();
        let (deeds, objects, storages) = (costs(3), costs(N), costs(N));
        let factors = Factors {
            deeds: Options::new(&live_actions, &deeds),
            things: [
                Options::new(live[0], &objects),
                Options::new(live[1], &storages),
            ],
            fits: Fits {
                kinds: std::array::from_fn(|i| Kind {
                    rows: &rows[i][..used[i]],
                    bytes: &bytes[i],
                }),
                of: &of,
                stride: N,
            },
            rest: [3, 9, 0, 4],
        };
        let mut rooms = [[[0.0; N]; 6], [[0.0; N]; 6]];
        let [mut a, mut b] = rooms.each_mut().map(|room| {
            let [a, b, c, d, e, f] = room;
            [(a, b), (c, d), (e, f)].map(|(of, weights)| Marginal {
                of: &mut of[..],
                weights: &mut weights[..],
            })
        });
        let whole = factors
            .solve([&mut [Weighed::NONE; 3], &mut [Weighed::NONE; 3]], &mut a)
            .unwrap();
        let alike = |cost| Heard {
            asked: whole.best,
            it: Costs::all(cost),
            others: Costs::all(cost),
        };
        let revised = factors.revise(&[alike(77), alike(0)], &mut b).unwrap();
        let close = |a: f32, b: f32| (a - b).abs() < 2e-3;
        // The product is searched at each level alone, which may miss what is best at none.
        let gained = revised.posterior - whole.posterior;
        assert!(gained > -2e-3, "{whole:?} {revised:?}");
        assert!(gained < 2e-3 || whole.best != revised.best);
        assert!(close(whole.noise, revised.noise));
        for (a, b) in a.iter().zip(&b) {
            assert!(
                a.of.iter().zip(&*b.of).all(|(a, b)| close(*a, *b)),
                "{round}"
            );
        }
        let yes = Heard {
            asked: revised.best,
            others: Costs::all(100),
            ..alike(0)
        };
        let sure = factors.revise(&[yes], &mut b).unwrap();
        assert_eq!(sure.best, revised.best);
        assert!(sure.posterior >= revised.posterior);
    }
}
