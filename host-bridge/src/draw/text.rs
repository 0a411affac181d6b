//! A picture of characters.

use super::Picture;

/// How many lines it has.
pub const HEIGHT: usize = 18;

/// How many characters each view is wide.
const WIDTH: usize = 36;

/// What a view shows, in metres: a character is about twice as high as it is wide.
const SIZE: f64 = 1.1;
const BEHIND: f64 = 0.15;

/// A grid of characters.
struct Grid([[char; WIDTH]; HEIGHT]);

impl Grid {
    /// Sets a character at a place in 0..=1 of the width and of the height, counted from below.
    fn set(&mut self, [right, up]: [f64; 2], character: char) {
        if !(0.0..1.0).contains(&right) || !(0.0..1.0).contains(&up) {
            return;
        }
        let column = (right * WIDTH as f64) as usize;
        let row = HEIGHT.saturating_sub(1 + (up * HEIGHT as f64) as usize);
        if let Some(cell) = self.0.get_mut(row).and_then(|row| row.get_mut(column)) {
            *cell = character;
        }
    }
}

fn side([x, _, z]: [f64; 3]) -> [f64; 2] {
    [(x + BEHIND) / SIZE, (z + 0.03) / SIZE]
}

fn above([x, y, _]: [f64; 3]) -> [f64; 2] {
    [(x + BEHIND) / SIZE, (y + SIZE / 2.0) / SIZE]
}

fn view(picture: &Picture, view: fn([f64; 3]) -> [f64; 2]) -> Grid {
    let mut grid = Grid([[' '; WIDTH]; HEIGHT]);
    for pair in picture.arm.windows(2) {
        if let [a, b] = pair {
            for i in 0..=20 {
                let part = f64::from(i) / 20.0;
                let mut at = *a;
                for (x, to) in at.iter_mut().zip(b) {
                    *x += part * (to - *x);
                }
                grid.set(view(at), '#');
            }
        }
    }
    for thing in &picture.things {
        let first = thing.name.chars().next().unwrap_or('?');
        let [right, up] = view(thing.at);
        let second = thing.name.chars().nth(1).unwrap_or(' ');
        grid.set([right, up], first);
        grid.set([right + 1.0 / WIDTH as f64, up], second);
    }
    if let Some(hand) = picture.arm.last() {
        grid.set(view(*hand), '+');
    }
    grid
}

/// The picture in [`HEIGHT`] lines: from the side, then from above. Things are named by their first two
/// letters, the hand is a `+`.
#[must_use]
pub fn text(picture: &Picture) -> Vec<String> {
    let (beside, over) = (view(picture, side), view(picture, above));
    let rows = beside.0.iter().zip(&over.0);
    let line = |row: &[char; WIDTH]| row.iter().collect::<String>();
    rows.map(|(a, b)| format!("{}|{}", line(a), line(b)))
        .collect()
}
