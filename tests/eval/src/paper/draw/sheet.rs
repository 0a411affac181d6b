//! A sheet to draw on, at either back end's scale, and what all drawings share: colours, keys, markers, intervals.

use anyhow::anyhow;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::paper::figure::{Form, Point};

/// Okabe and Ito's colours, which people with any colour vision tell apart, darkest uses first.
pub const COLOURS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x00, 0x00, 0x00),
    RGBColor(0x99, 0x99, 0x99),
];

/// Width and height of a figure in points of 1/100 inch: 3.4 inches, a column.
pub const SIZE: (u32, u32) = (340, 250);

pub type Area<B> = DrawingArea<B, Shift>;

/// Where a figure is drawn.
pub struct Sheet<B: DrawingBackend> {
    /// The whole of it.
    pub area: Area<B>,
    /// Dots per point.
    pub scale: u32,
}

impl<B: DrawingBackend> Sheet<B> {
    pub fn px(&self, points: u32) -> u32 {
        points * self.scale
    }

    pub fn font(&self, points: u32) -> TextStyle<'static> {
        ("sans-serif", self.px(points)).into_font().color(&BLACK)
    }

    pub fn error(e: impl std::fmt::Display) -> anyhow::Error {
        anyhow!("cannot draw: {e}")
    }

    /// A row of keys above the plot, as many lines of it as are needed.
    pub fn legend(&self, names: &[&str], form: Form) -> anyhow::Result<Area<B>> {
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
    pub fn marker(
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
                let stroke = colour.stroke_width(self.px(1));
                area.draw(&Rectangle::new([(x - r, y - r), (x + r, y + r)], stroke))
            }
            5 => {
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
    pub fn whisker(
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
