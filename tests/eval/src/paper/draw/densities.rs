//! The noise levels' densities.

use plotters::prelude::*;

use super::sheet::{COLOURS, Sheet};
use crate::noise::{Level, Noise};
use crate::paper::figure::Form;

/// Draws the density of every noise level.
///
/// # Errors
/// The back end's.
pub fn draw<B: DrawingBackend>(sheet: &Sheet<B>) -> anyhow::Result<()> {
    sheet.area.fill(&WHITE).map_err(Sheet::<B>::error)?;
    let plot = sheet.legend(&["n1 (real)", "n2", "n3", "n4"], Form::Lines)?;
    let mut chart = ChartBuilder::on(&plot)
        .margin_left(sheet.px(6))
        .margin_right(sheet.px(8))
        .margin_top(sheet.px(4))
        .x_label_area_size(sheet.px(32))
        .y_label_area_size(sheet.px(40))
        .build_cartesian_2d(-1.0..1.0, 0.0..4.0)
        .map_err(Sheet::<B>::error)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .axis_style(BLACK.stroke_width(sheet.scale))
        .x_desc("Error of a likelihood (1)")
        .y_desc("Density (1)")
        .y_labels(5)
        .x_label_style(sheet.font(10))
        .y_label_style(sheet.font(10))
        .axis_desc_style(sheet.font(10))
        .draw()
        .map_err(Sheet::<B>::error)?;
    for (colour, level) in COLOURS.iter().zip(&Level::ALL[1..]) {
        let noise = Noise::from(*level);
        let curve = (-400..=400).map(|i| {
            let x = f64::from(i) / 400.0;
            (x, noise.density(x).min(4.0))
        });
        let style = colour.stroke_width(sheet.px(1));
        chart
            .draw_series(LineSeries::new(curve, style))
            .map_err(Sheet::<B>::error)?;
    }
    sheet.area.present().map_err(Sheet::<B>::error)
}
