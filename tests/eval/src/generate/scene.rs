//! Things on a table.

use rand::seq::{IndexedRandom, SliceRandom};
use rand::{Rng, RngExt};

use crate::catalogue::Catalogue;
use crate::recipe::Recipe;
use crate::record::{Feature, Thing, Triple};

/// Which options of a category stand on the table, in random order: `count` of `of`, with `wanted`
/// among them.
pub fn chosen(count: usize, of: usize, wanted: Option<u8>, rng: &mut impl Rng) -> Vec<u8> {
    let all: Vec<u8> = (0_u8..).take(of).filter(|&o| Some(o) != wanted).collect();
    let others = count.saturating_sub(usize::from(wanted.is_some()));
    let mut options: Vec<u8> = all.sample(rng, others).copied().collect();
    options.extend(wanted);
    options.shuffle(rng);
    options
}

/// Features that a thing has by chance.
pub fn things_by_chance(recipe: &Recipe, rng: &mut impl Rng) -> Vec<bool> {
    let mut holds: Vec<bool> = recipe
        .chances
        .iter()
        .map(|c| rng.random_bool(c.probability))
        .collect();
    for (i, chance) in recipe.chances.iter().enumerate() {
        if let Some(same) = chance.same_as {
            holds[i] = holds[same];
        }
    }
    holds
}

/// The things of a category around what is meant. Where it takes one, that alone meets the meant
/// action's requirements, and no more, and everything else is spoiled. Where it takes none, all is
/// by chance.
pub fn around(
    catalogue: &Catalogue,
    recipe: &Recipe,
    truth: Triple,
    category: usize,
    rng: &mut impl Rng,
) -> Vec<Thing> {
    let meant = truth.options()[category];
    let options = chosen(
        recipe.things[category],
        catalogue.count(category),
        meant,
        rng,
    );
    let action = &catalogue.actions[usize::from(truth.action)];
    let wanted = if category == 1 {
        action.object.wanted
    } else {
        action.storage.wanted
    };
    let asks_for_spoiled = recipe
        .chances
        .iter()
        .enumerate()
        .any(|(k, chance)| chance.spoils && wanted.contains(k));
    options
        .into_iter()
        .map(|option| {
            let holds = match meant {
                None => things_by_chance(recipe, rng),
                Some(meant) if meant == option => (0..recipe.chances.len())
                    .map(|k| wanted.contains(k))
                    .collect(),
                Some(_) => recipe
                    .chances
                    .iter()
                    .map(|chance| chance.spoils && !asks_for_spoiled)
                    .collect(),
            };
            let kind = match meant {
                None => (!catalogue.types.is_empty()).then_some(0),
                Some(meant) if meant == option => (0_u8..)
                    .take(catalogue.types.len())
                    .find(|&t| wanted.contains(catalogue.features.len() + usize::from(t))),
                Some(_) => None,
            };
            Thing {
                option,
                kind,
                features: holds.into_iter().map(Feature::sure).collect(),
            }
        })
        .collect()
}
