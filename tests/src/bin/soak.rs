//! `soak SECONDS [SEED]`: operates the image in a hurry for so long in its own time, and says what came of it.

use deictic_tests::network::trial::Setting;
use deictic_tests::soak::{has_image, soak};

fn main() {
    let mut numbers = std::env::args()
        .skip(1)
        .map(|n| n.parse().expect("a number"));
    let seconds = numbers.next().unwrap_or(3_600);
    let seed = numbers.next().unwrap_or(0);
    assert!(has_image());
    let figures = soak(&Setting::default(), seconds, seed);
    print!("{figures}");
    figures.check();
}
