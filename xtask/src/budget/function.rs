//! How deep one function pushes the stack, and how deep it is at each of its calls.

use std::collections::{BTreeMap, BTreeSet};

use super::image::Image;
use super::thumb::{Flow, Stack, decode};

/// A function as far as the stack is concerned. Depths are in bytes, from the stack pointer at its entry.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Shape {
    /// The deepest it gets by itself.
    pub frame: u32,
    /// Address of each function it calls or jumps to, and the depth at which it does.
    pub calls: BTreeSet<(u32, u32)>,
    /// What the analysis cannot follow.
    pub blind: Vec<Blind>,
}

/// Something the analysis cannot follow, at an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blind {
    /// A call through a pointer.
    Indirect(u32),
    /// The stack pointer takes a value that only a running program knows, or grows in a loop.
    Dynamic(u32),
}

/// Deeper than any board's RAM: the stack grows in a loop.
const ENDLESS: u32 = 1 << 20;

/// Follows every path through the function at `start`.
pub fn shape(image: &Image, start: u32) -> Shape {
    let mut shape = Shape::default();
    let Some(function) = image.functions.get(&start) else {
        return shape;
    };
    let inside = |address: u32| (start..function.end).contains(&address);
    let mut deepest: BTreeMap<u32, u32> = BTreeMap::new();
    let mut conditional: BTreeSet<u32> = BTreeSet::new();
    let mut open = vec![(start, 0_u32)];
    while let Some((address, depth)) = open.pop() {
        if !inside(address) || image.is_data(address) {
            continue;
        }
        if deepest.get(&address).is_some_and(|seen| *seen >= depth) {
            continue;
        }
        deepest.insert(address, depth);
        let Some(instruction) = decode(address, image.code(address)) else {
            continue;
        };
        let next = address + instruction.size;
        let may_skip = conditional.contains(&address);
        let mut after = match instruction.stack {
            Stack::Grow(bytes) => depth.saturating_add_signed(bytes),
            Stack::Unknown => {
                shape.note(Blind::Dynamic(address));
                depth
            }
        };
        if after > ENDLESS {
            shape.note(Blind::Dynamic(address));
            continue;
        }
        shape.frame = shape.frame.max(after);
        if may_skip {
            after = after.max(depth);
        }
        let mut leave = |to: u32, open: &mut Vec<(u32, u32)>| {
            if inside(to) {
                open.push((to, after));
            } else {
                shape.calls.insert((to, after));
            }
        };
        match instruction.flow {
            Flow::Next => open.push((next, after)),
            Flow::If(count) => {
                let mut at = next;
                for _ in 0..count {
                    conditional.insert(at);
                    at += decode(at, image.code(at)).map_or(2, |instruction| instruction.size);
                }
                open.push((next, after));
            }
            Flow::Branch(to) => {
                leave(to, &mut open);
                open.push((next, after));
            }
            Flow::Jump(to) => leave(to, &mut open),
            Flow::Call(to) => {
                shape.calls.insert((to, after));
                open.push((next, after));
            }
            Flow::CallIndirect => {
                shape.note(Blind::Indirect(address));
                open.push((next, after));
            }
            Flow::JumpIndirect => shape.note(Blind::Indirect(address)),
            Flow::Table(width) => open.extend(table(image, next, width).map(|to| (to, after))),
            Flow::Return | Flow::Stop => {}
        }
        if may_skip {
            open.push((next, after));
        }
    }
    shape
}

impl Shape {
    fn note(&mut self, blind: Blind) {
        if !self.blind.contains(&blind) {
            self.blind.push(blind);
        }
    }
}

/// Targets of a jump table of entries of `width` bytes at `base`, which lasts as long as the data does.
fn table(image: &Image, base: u32, width: u32) -> impl Iterator<Item = u32> {
    let bytes = image.code(base);
    (base..)
        .step_by(width as usize)
        .zip(bytes.chunks_exact(width as usize))
        .take_while(|(address, _)| image.is_data(*address))
        .map(move |(_, entry)| {
            let entry = entry
                .iter()
                .rev()
                .fold(0, |value, byte| value << 8 | u32::from(*byte));
            base + 2 * entry
        })
}
