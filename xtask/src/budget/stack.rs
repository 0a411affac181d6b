//! The most stack that an image can use, from the calls in its machine code.

use std::collections::BTreeMap;

use serde::Serialize;

use super::function::{Blind, shape};
use super::image::Image;

/// What the core pushes when it takes an exception: 26 words with the floating-point registers, and one to align
/// (ARMv7-M, B1.5.7).
const EXCEPTION_FRAME: u32 = 27 * 4;

/// Numbers of exceptions in the vector table.
const NMI: usize = 2;
const HARD_FAULT: usize = 3;

/// The figure and how it comes about.
#[derive(Debug, Serialize)]
pub struct WorstCase {
    /// Everything at once: the deepest path of the loop, the deepest interrupt on it, then HardFault, then NMI.
    pub bytes: u32,
    /// Deepest path from Reset.
    pub thread: Path,
    /// Deepest interrupt handler. All interrupts have the same priority, so one runs at a time.
    pub interrupt: Path,
    /// HardFault's handler.
    pub hard_fault: Path,
    /// NMI's handler.
    pub nmi: Path,
    /// What the figure does not cover. Empty when it covers everything.
    pub blind_spots: Vec<String>,
}

/// A chain of calls and the bytes of stack it takes, the exception frame among them.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Path {
    /// Bytes.
    pub bytes: u32,
    /// From the outermost function to the innermost, each with its share.
    pub calls: Vec<(String, u32)>,
}

/// Adds up the worst case.
pub fn worst_case(image: &Image) -> WorstCase {
    let mut graph = Graph {
        image,
        known: BTreeMap::new(),
        open: Vec::new(),
        blind_spots: Vec::new(),
    };
    let mut thread = Path::default();
    let mut interrupt = Path::default();
    let mut hard_fault = Path::default();
    let mut nmi = Path::default();
    for (index, handler) in image.vectors.iter().enumerate() {
        if *handler == 0 {
            continue;
        }
        let mut path = graph.path(*handler);
        let number = index + 1;
        if number > 1 {
            path.bytes += EXCEPTION_FRAME;
            path.calls
                .insert(0, ("exception frame".to_owned(), EXCEPTION_FRAME));
        }
        let slot = match number {
            1 => &mut thread,
            NMI => &mut nmi,
            HARD_FAULT => &mut hard_fault,
            _ => &mut interrupt,
        };
        if path.bytes > slot.bytes {
            *slot = path;
        }
    }
    WorstCase {
        bytes: thread.bytes + interrupt.bytes + hard_fault.bytes + nmi.bytes,
        thread,
        interrupt,
        hard_fault,
        nmi,
        blind_spots: graph.blind_spots,
    }
}

struct Graph<'a> {
    image: &'a Image,
    /// Deepest use from a function on, and through which call it comes about.
    known: BTreeMap<u32, (u32, Option<(u32, u32)>)>,
    /// Functions that are being looked at: a call to one of them is a recursion.
    open: Vec<u32>,
    blind_spots: Vec<String>,
}

impl Graph<'_> {
    fn deepest(&mut self, function: u32) -> u32 {
        if let Some((bytes, _)) = self.known.get(&function) {
            return *bytes;
        }
        if self.open.contains(&function) {
            let names: Vec<&str> = self
                .open
                .iter()
                .map(|open| self.image.name(*open))
                .collect();
            self.blind_spots.push(format!(
                "recursion: {} -> {}",
                names.join(" -> "),
                self.image.name(function)
            ));
            return 0;
        }
        if !self.image.functions.contains_key(&function) {
            self.blind_spots
                .push(format!("a jump to {function:#x}, where no function begins"));
            return 0;
        }
        let shape = shape(self.image, function);
        for blind in &shape.blind {
            let name = self.image.name(function);
            self.blind_spots.push(match blind {
                Blind::Indirect(address) => {
                    format!("call through a pointer at {address:#x} in {name}")
                }
                Blind::Dynamic(address) => {
                    format!("stack pointer computed at {address:#x} in {name}")
                }
            });
        }
        self.open.push(function);
        let mut worst = (shape.frame, None);
        for (callee, depth) in &shape.calls {
            let bytes = depth + self.deepest(*callee);
            if bytes > worst.0 {
                worst = (bytes, Some((*callee, *depth)));
            }
        }
        self.open.pop();
        self.known.insert(function, worst);
        worst.0
    }

    fn path(&mut self, function: u32) -> Path {
        let bytes = self.deepest(function);
        let mut calls = Vec::new();
        let mut at = Some(function);
        while let Some(function) = at {
            let name = self.image.name(function).to_owned();
            let (bytes, through) = self.known.get(&function).copied().unwrap_or_default();
            calls.push((name, through.map_or(bytes, |(_, depth)| depth)));
            at = through.map(|(callee, _)| callee);
        }
        Path { bytes, calls }
    }
}
