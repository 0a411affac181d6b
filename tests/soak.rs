//! A short while of what `cargo xtask soak` does for an hour of the board's time.

use deictic_tests::network::trial::Setting;
use deictic_tests::soak::{has_image, soak};

#[test]
fn the_unit_operates_for_minutes_and_every_command_is_accounted_for() {
    if !has_image() {
        return;
    }
    let figures = soak(&Setting::default(), 400, 0);
    eprintln!("{figures}");
    figures.check();
}
