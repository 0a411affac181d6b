//! Drawing figures as SVG and PNG, to be printed at the width of a column.

use std::path::Path;
use std::sync::Once;

use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

use self::sheet::{SIZE, Sheet};
use super::figure::Figure;

mod densities;
mod shares;
mod sheet;

/// A PNG has 300 dots per inch.
const SCALE: u32 = 3;

/// Writes `name.svg` and `name.png` into a folder.
///
/// # Errors
/// The system's, with the file.
pub fn figure(folder: &Path, figure: &Figure) -> anyhow::Result<()> {
    files(folder, figure.name, |canvas| canvas.shares(figure))
}

/// Writes the densities of the noise levels as `noise-levels.svg` and `.png`.
///
/// # Errors
/// The system's, with the file.
pub fn noise_levels(folder: &Path) -> anyhow::Result<()> {
    files(folder, "noise-levels", |canvas| canvas.densities())
}

/// What can be drawn on either back end.
trait Canvas {
    fn shares(&self, figure: &Figure) -> anyhow::Result<()>;
    fn densities(&self) -> anyhow::Result<()>;
}

fn files(
    folder: &Path,
    name: &str,
    draw: impl Fn(&dyn Canvas) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    static FONT: Once = Once::new();
    FONT.call_once(|| {
        let _ = register_font("sans-serif", FontStyle::Normal, dejavu::sans::regular());
    });
    let (w, h) = SIZE;
    let svg = folder.join(format!("{name}.svg"));
    let area = SVGBackend::new(&svg, SIZE).into_drawing_area();
    draw(&Sheet { area, scale: 1 })?;
    let png = folder.join(format!("{name}.png"));
    let area = BitMapBackend::new(&png, (w * SCALE, h * SCALE)).into_drawing_area();
    draw(&Sheet { area, scale: SCALE })
}

impl<B: DrawingBackend> Canvas for Sheet<B> {
    fn shares(&self, figure: &Figure) -> anyhow::Result<()> {
        shares::draw(self, figure)
    }

    fn densities(&self) -> anyhow::Result<()> {
        densities::draw(self)
    }
}
