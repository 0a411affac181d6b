//! Drawing figures as SVG and PNG, to be printed at the width of a column.

use std::path::Path;
use std::sync::Once;

use anyhow::anyhow;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};

use super::figure::{Figure, Form, Point};
use crate::noise::{Level, Noise};

/// Okabe and Ito's colours, which people with any colour vision tell apart, darkest uses first.
const COLOURS: [RGBColor; 6] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0x00, 0x00, 0x00),
    RGBColor(0x99, 0x99, 0x99),
];

/// Width and height of a figure in points of 1/100 inch: 3.4 inches, a column.
const SIZE: (u32, u32) = (340, 250);

/// A PNG has 300 dots per inch.
const SCALE: u32 = 3;

type Area<B> = DrawingArea<B, Shift>;

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

struct Sheet<B: DrawingBackend> {
    area: Area<B>,
    scale: u32,
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

impl<B: DrawingBackend> Sheet<B> {
    fn px(&self, points: u32) -> u32 {
        points * self.scale
    }

    fn font(&self, points: u32) -> TextStyle<'static> {
        ("sans-serif", self.px(points)).into_font().color(&BLACK)
    }

    fn error(e: impl std::fmt::Display) -> anyhow::Error {
        anyhow!("cannot draw: {e}")
    }

    /// A row of keys above the plot, as many lines of it as are needed.
    fn legend(&self, names: &[&str], form: Form) -> anyhow::Result<Area<B>> {
        let columns = if names.len() > 4 {
            3
        } else {
            2.max(names.len().min(4))
        };
        let wide = names.iter().any(|n| n.len() > 12);
        let columns = if wide { columns.min(2) } else { columns };
        let lines = names.len().div_ceil(columns);
        let line = self.px(13);
        let (top, plot) = self.area.split_vertically(line * lines as u32 + self.px(5));
        let left = self.px(44);
        let key = self.font(10).pos(Pos::new(HPos::Left, VPos::Center));
        let step = (self.px(SIZE.0) - left) / columns as u32;
        for (i, name) in names.iter().enumerate() {
            let x = (left + step * (i % columns) as u32) as i32;
            let y = (self.px(9) + line * (i / columns) as u32) as i32;
            let colour = COLOURS[i % COLOURS.len()];
            let reach = self.px(12) as i32;
            if form == Form::Bars {
                let r = self.px(4) as i32;
                let corners = [(x + reach - 2 * r, y - r), (x + reach, y + r)];
                top.draw(&Rectangle::new(corners, colour.filled()))
                    .map_err(Self::error)?;
            } else {
                let stroke = colour.stroke_width(self.px(1));
                top.draw(&PathElement::new(vec![(x, y), (x + reach, y)], stroke))
                    .map_err(Self::error)?;
                self.marker(&top, i, (x + reach / 2, y), colour)?;
            }
            let at = (x + reach + self.px(4) as i32, y);
            top.draw(&Text::new((*name).to_owned(), at, key.clone()))
                .map_err(Self::error)?;
        }
        Ok(plot)
    }

    /// Series differ in shape as well as in colour.
    fn marker(
        &self,
        area: &Area<B>,
        i: usize,
        (x, y): (i32, i32),
        colour: RGBColor,
    ) -> anyhow::Result<()> {
        let r = self.px(3) as i32;
        let fill = colour.filled();
        match i % COLOURS.len() {
            0 => area.draw(&Circle::new((x, y), r, fill)),
            1 => area.draw(&TriangleMarker::new((x, y), r + 1, fill)),
            2 => area.draw(&Rectangle::new([(x - r, y - r), (x + r, y + r)], fill)),
            3 => {
                let stroke = colour.stroke_width(self.px(1));
                area.draw(&Cross::new((x, y), r, stroke))
            }
            4 => {
                let diamond = vec![
                    (x, y - r - 1),
                    (x + r + 1, y),
                    (x, y + r + 1),
                    (x - r - 1, y),
                ];
                area.draw(&Polygon::new(diamond, fill))
            }
            _ => {
                let stroke = colour.stroke_width(self.px(1));
                area.draw(&Circle::new((x, y), r, stroke))
            }
        }
        .map_err(Self::error)
    }

    /// A point's interval, with caps.
    fn whisker(
        &self,
        area: &Area<B>,
        at: impl Fn(f64) -> (i32, i32),
        point: Point,
        colour: RGBColor,
    ) -> anyhow::Result<()> {
        let stroke = colour.stroke_width(self.px(1).div_ceil(2));
        let [low, high] = point.interval.map(&at);
        area.draw(&PathElement::new(vec![low, high], stroke))
            .map_err(Self::error)?;
        let cap = self.px(2) as i32;
        for (x, y) in [low, high] {
            area.draw(&PathElement::new(vec![(x - cap, y), (x + cap, y)], stroke))
                .map_err(Self::error)?;
        }
        Ok(())
    }
}

impl<B: DrawingBackend> Canvas for Sheet<B> {
    fn shares(&self, figure: &Figure) -> anyhow::Result<()> {
        self.area.fill(&WHITE).map_err(Self::error)?;
        let names: Vec<&str> = figure.series.iter().map(|s| s.name.as_str()).collect();
        let plot = self.legend(&names, figure.form)?;
        let places = figure.places.len();
        let mut chart = ChartBuilder::on(&plot)
            .margin_left(self.px(6))
            .margin_right(self.px(8))
            .margin_top(self.px(4))
            .x_label_area_size(self.px(32))
            .y_label_area_size(self.px(40))
            .build_cartesian_2d(-0.5..places as f64 - 0.5, 0.0..100.0)
            .map_err(Self::error)?;
        let label = |x: &f64| {
            let near = x.round();
            let at = (x - near).abs() < 0.01 && near >= 0.0;
            let name = figure.places.get(near as usize).filter(|_| at);
            name.cloned().unwrap_or_default()
        };
        let narrow = figure.places.iter().any(|p| p.len() > 10);
        chart
            .configure_mesh()
            .disable_x_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(0xdd, 0xdd, 0xdd).stroke_width(self.scale))
            .axis_style(BLACK.stroke_width(self.scale))
            .x_labels(2 * places + 1)
            .x_label_formatter(&label)
            .y_labels(6)
            .y_label_formatter(&|y| format!("{y:.0}"))
            .x_desc(figure.x)
            .y_desc(figure.y)
            .x_label_style(self.font(if narrow { 8 } else { 10 }))
            .y_label_style(self.font(10))
            .axis_desc_style(self.font(10))
            .draw()
            .map_err(Self::error)?;
        let area = chart.plotting_area();
        let pixel = |x: f64, y: f64| area.map_coordinate(&(x, y));
        // Whole-canvas coordinates of the plot's own sub-area are those of the sheet.
        let sheet = &self.area;
        let width = 0.8 / figure.series.len().max(1) as f64;
        for (i, series) in figure.series.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            let offset = match figure.form {
                Form::Bars => -0.4 + (i as f64 + 0.5) * width,
                Form::Lines => (i as f64 - figure.series.len() as f64 / 2.0) * 0.02,
            };
            let points: Vec<(f64, Point)> = series
                .points
                .iter()
                .enumerate()
                .filter_map(|(k, p)| Some((k as f64 + offset, (*p)?)))
                .collect();
            if figure.form == Form::Lines {
                let path = points
                    .iter()
                    .map(|(x, p)| pixel(*x, p.share))
                    .collect::<Vec<_>>();
                let line = PathElement::new(path, colour.stroke_width(self.px(1)));
                sheet.draw(&line).map_err(Self::error)?;
            }
            for (x, point) in points {
                match figure.form {
                    Form::Lines => self.marker(sheet, i, pixel(x, point.share), colour)?,
                    Form::Bars => {
                        let corners = [
                            pixel(x - 0.45 * width, point.share),
                            pixel(x + 0.45 * width, 0.0),
                        ];
                        sheet
                            .draw(&Rectangle::new(corners, colour.filled()))
                            .map_err(Self::error)?;
                    }
                }
                let whisker = if figure.form == Form::Bars {
                    BLACK
                } else {
                    colour
                };
                self.whisker(sheet, |y| pixel(x, y), point, whisker)?;
            }
        }
        sheet.present().map_err(Self::error)
    }

    fn densities(&self) -> anyhow::Result<()> {
        self.area.fill(&WHITE).map_err(Self::error)?;
        let plot = self.legend(&["n1 (real)", "n2", "n3", "n4"], Form::Lines)?;
        let mut chart = ChartBuilder::on(&plot)
            .margin_left(self.px(6))
            .margin_right(self.px(8))
            .margin_top(self.px(4))
            .x_label_area_size(self.px(32))
            .y_label_area_size(self.px(40))
            .build_cartesian_2d(-1.0..1.0, 0.0..4.0)
            .map_err(Self::error)?;
        chart
            .configure_mesh()
            .disable_mesh()
            .axis_style(BLACK.stroke_width(self.scale))
            .x_desc("Error of a likelihood (1)")
            .y_desc("Density (1)")
            .y_labels(5)
            .x_label_style(self.font(10))
            .y_label_style(self.font(10))
            .axis_desc_style(self.font(10))
            .draw()
            .map_err(Self::error)?;
        for (colour, level) in COLOURS.iter().zip(&Level::ALL[1..]) {
            let noise = Noise::from(*level);
            let curve = (-400..=400).map(|i| {
                let x = f64::from(i) / 400.0;
                (x, noise.density(x).min(4.0))
            });
            let style = colour.stroke_width(self.px(1));
            chart
                .draw_series(LineSeries::new(curve, style))
                .map_err(Self::error)?;
        }
        self.area.present().map_err(Self::error)
    }
}
