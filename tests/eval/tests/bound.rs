//! The Bayes bound against the recorded one, and what it must be by its definition.

use std::path::Path;

use deictic_eval::bound::of;
use deictic_eval::catalogue::Catalogue;
use deictic_eval::dataset;
use deictic_eval::free;
use deictic_eval::generate::{Kind, set};
use deictic_eval::maker::Maker;
use deictic_eval::noise::Level;
use deictic_eval::score::Field;
use deictic_eval::situation::FeatureForm;
use deictic_eval::variant::{ModelName, ProfileName, Variant};

#[test]
fn the_recorded_bound_is_met() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let Ok(table) = std::fs::read_to_string(shared.join("reference/bayes_bound.csv")) else {
        println!("skipped: the recorded bound is not beside the project");
        return;
    };
    let (catalogue, sets) = dataset::read_folder(&shared.join("data/sim")).unwrap();
    let mut compared = 0;
    for row in table.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let name = format!("{}_{}", cells[1], cells[2]);
        let theirs = sets.iter().find(|s| s.name == name).unwrap();
        let recorded: f64 = cells[3].parse().unwrap();
        let bound = of(&catalogue, theirs, Maker::of(&name).unwrap());
        let ours = bound.percent(bound.triple);
        assert!(
            (ours - recorded).abs() < 0.2,
            "{name}: {ours} instead of {recorded}"
        );
        compared += 1;
    }
    assert_eq!(compared, 15);
}

#[test]
fn names_say_how_a_set_was_made() {
    let maker = Maker::Paper(Kind::Arity, Level::N3);
    assert_eq!(Maker::of("D_arity_n3"), Some(maker));
    assert_eq!(Maker::of("D_free_n1"), Some(Maker::Free(Level::N1)));
    assert_eq!(Maker::of("D_arity_n9"), None);
    assert_eq!(Maker::of("real_aligned"), None);
}

/// On sets made here no model beats the bound by more than chance, and the floor lies below it.
#[test]
fn no_model_beats_the_bound() {
    let (catalogue, recipe) = Catalogue::papers();
    for level in [Level::N1, Level::N3, Level::N4] {
        let fair = free::set(&catalogue, &recipe, level, 1500, 21);
        let paper = set(&catalogue, &recipe, Kind::Properties, level, 1500, 21);
        for (made, maker, form) in [
            (fair, Maker::Free(level), FeatureForm::Graded),
            (
                paper,
                Maker::Paper(Kind::Properties, level),
                FeatureForm::Sure,
            ),
        ] {
            let bound = of(&catalogue, &made, maker);
            assert!(bound.floor < 0.75 * bound.triple, "{}", made.name);
            let field = Field::new(&made, &catalogue, ProfileName::Paper, form).unwrap();
            for model in [
                ModelName::Baseline,
                ModelName::M1,
                ModelName::M2,
                ModelName::M3,
            ] {
                let variant = Variant::new(model, None, None, ProfileName::Paper);
                let tally = field.tally(&variant).unwrap();
                let (ours, best) = (
                    tally.percent(tally.triple_argmax),
                    bound.percent(bound.triple),
                );
                assert!(
                    ours < best + 1.0,
                    "{} {model}: {ours} above {best}",
                    made.name
                );
            }
        }
    }
}

#[test]
fn d_free_gives_nothing_away_by_order_or_presence() {
    let (catalogue, recipe) = Catalogue::papers();
    let made = free::set(&catalogue, &recipe, Level::N2, 3000, 5);
    let (mut first, mut with_object, mut possible) = (0, 0, 0);
    for record in &made.records {
        let actions = (0..catalogue.count(0)).filter(|&a| catalogue.possible(a, record));
        possible += actions.count();
        let Some(object) = record.truth.object else {
            continue;
        };
        with_object += 1;
        first += usize::from(record.objects[0].option == object);
        assert!(record.objects.iter().any(|o| o.option == object));
        for thing in &record.objects {
            for f in &thing.features {
                assert_eq!(f.likelihood > 0.5, f.holds);
            }
        }
    }
    // One in five stands first by chance.
    let share = first as f64 / f64::from(with_object);
    assert!((share - 0.2).abs() < 0.03, "{share}");
    assert!(possible as f64 / made.records.len() as f64 > 6.0);
}
