//! Shares by place and series: bars or lines.

use plotters::prelude::*;

use super::sheet::{COLOURS, Sheet};
use crate::paper::figure::{Figure, Form, Point};

/// Draws shares in percent with their intervals.
///
/// # Errors
/// The back end's.
pub fn draw<B: DrawingBackend>(sheet: &Sheet<B>, figure: &Figure) -> anyhow::Result<()> {
    sheet.area.fill(&WHITE).map_err(Sheet::<B>::error)?;
    let names: Vec<&str> = figure.series.iter().map(|s| s.name.as_str()).collect();
    let plot = sheet.legend(&names, figure.form)?;
    let places = figure.places.len();
    let mut chart = ChartBuilder::on(&plot)
        .margin_left(sheet.px(6))
        .margin_right(sheet.px(8))
        .margin_top(sheet.px(4))
        .x_label_area_size(sheet.px(32))
        .y_label_area_size(sheet.px(40))
        .build_cartesian_2d(-0.5..places as f64 - 0.5, 0.0..100.0)
        .map_err(Sheet::<B>::error)?;
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
        .bold_line_style(RGBColor(0xdd, 0xdd, 0xdd).stroke_width(sheet.scale))
        .axis_style(BLACK.stroke_width(sheet.scale))
        .x_labels(2 * places + 1)
        .x_label_formatter(&label)
        .y_labels(6)
        .y_label_formatter(&|y| format!("{y:.0}"))
        .x_desc(figure.x)
        .y_desc(figure.y)
        .x_label_style(sheet.font(if narrow { 8 } else { 10 }))
        .y_label_style(sheet.font(10))
        .axis_desc_style(sheet.font(10))
        .draw()
        .map_err(Sheet::<B>::error)?;
    let area = chart.plotting_area();
    let pixel = |x: f64, y: f64| area.map_coordinate(&(x, y));
    // Whole-canvas coordinates of the plot's own sub-area are those of the sheet.
    let whole = &sheet.area;
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
            let line = PathElement::new(path, colour.stroke_width(sheet.px(1)));
            whole.draw(&line).map_err(Sheet::<B>::error)?;
        }
        for (x, point) in points {
            match figure.form {
                Form::Lines => sheet.marker(whole, i, pixel(x, point.share), colour)?,
                Form::Bars => {
                    let corners = [
                        pixel(x - 0.45 * width, point.share),
                        pixel(x + 0.45 * width, 0.0),
                    ];
                    whole
                        .draw(&Rectangle::new(corners, colour.filled()))
                        .map_err(Sheet::<B>::error)?;
                }
            }
            let whisker = if figure.form == Form::Bars {
                BLACK
            } else {
                colour
            };
            sheet.whisker(whole, |y| pixel(x, y), point, whisker)?;
        }
    }
    whole.present().map_err(Sheet::<B>::error)
}
