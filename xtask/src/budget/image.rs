//! The parts of a linked image that budgets are about.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result};
use object::elf::{PT_LOAD, SHF_ALLOC, SHT_NOBITS};
use object::read::elf::{ElfFile32, FileHeader, ProgramHeader, SectionHeader};
use object::{Object, ObjectSection, ObjectSymbol, SymbolKind};

/// Where RAM lies on every Cortex-M (ARMv7-M, B3.1).
const RAM: std::ops::Range<u64> = 0x2000_0000..0x4000_0000;

/// An image, taken apart.
pub struct Image {
    /// Bytes that are written to flash: vectors, code, constants, and the first values of variables.
    pub flash_bytes: u64,
    /// Bytes of RAM that variables take, the stack not among them.
    pub ram_bytes: u64,
    /// Functions by address.
    pub functions: BTreeMap<u32, Function>,
    /// Handlers in the vector table: Reset, then exceptions 2 and up; 0 where there is none.
    pub vectors: Vec<u32>,
    /// Address and contents of the code section.
    text: (u32, Vec<u8>),
    /// What begins at an address in the code section, by the ABI's mapping symbols: data (true) or instructions.
    mapping: BTreeMap<u32, bool>,
}

/// A function's place.
pub struct Function {
    /// As in the source.
    pub name: String,
    /// First byte after it.
    pub end: u32,
}

impl Image {
    /// Reads the image at `path`.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes =
            std::fs::read(path).with_context(|| format!("no image at {}", path.display()))?;
        Self::parse(&bytes).with_context(|| format!("{} is no Cortex-M image", path.display()))
    }

    fn parse(bytes: &[u8]) -> Result<Self> {
        let elf: ElfFile32<'_> = ElfFile32::parse(bytes)?;
        let endian = elf.endian();
        let mut image = Self {
            flash_bytes: 0,
            ram_bytes: 0,
            functions: BTreeMap::new(),
            vectors: Vec::new(),
            text: (0, Vec::new()),
            mapping: BTreeMap::new(),
        };
        for segment in elf.elf_header().program_headers(endian, bytes)? {
            if segment.p_type(endian) == PT_LOAD {
                image.flash_bytes += u64::from(segment.p_filesz(endian));
            }
        }
        for section in elf.sections() {
            let header = section.elf_section_header();
            if !header.sh_flags(endian).contains(SHF_ALLOC) {
                continue;
            }
            if RAM.contains(&section.address()) {
                image.ram_bytes += section.size();
            }
            if header.sh_type(endian) == SHT_NOBITS {
                continue;
            }
            match section.name()? {
                ".vector_table" => {
                    image.vectors = words(section.data()?)
                        .skip(1)
                        .map(|word| word & !1)
                        .collect()
                }
                ".text" => {
                    image.text = (u32::try_from(section.address())?, section.data()?.to_vec())
                }
                _ => {}
            }
        }
        for symbol in elf.symbols() {
            let address = u32::try_from(symbol.address())?;
            let name = symbol.name()?;
            match name.get(..2) {
                Some("$d") => image.mapping.insert(address, true),
                Some("$t") => image.mapping.insert(address, false),
                _ => None,
            };
            if symbol.kind() == SymbolKind::Text {
                let start = address & !1;
                let end = start + u32::try_from(symbol.size())?;
                let function = image.functions.entry(start).or_insert_with(|| Function {
                    name: format!("{:#}", rustc_demangle::demangle(name)),
                    end,
                });
                function.end = function.end.max(end);
            }
        }
        image.close_open_functions();
        Ok(image)
    }

    /// Bytes of the functions whose names contain one of these.
    pub fn bytes_of(&self, names: &[&str]) -> u64 {
        let named = |f: &&Function| names.iter().any(|name| f.name.contains(name));
        let found = self.functions.iter().filter(|(_, f)| named(f));
        found.map(|(start, f)| u64::from(f.end - start)).sum()
    }

    /// Hand-written assembly may not say how long it is: it lasts until the next function.
    fn close_open_functions(&mut self) {
        let mut next = self.text.0 + u32::try_from(self.text.1.len()).unwrap_or(0);
        for (start, function) in self.functions.iter_mut().rev() {
            if function.end == *start {
                function.end = next;
            }
            next = *start;
        }
    }

    /// The code from `address` on; empty outside of the code section.
    pub fn code(&self, address: u32) -> &[u8] {
        let (start, bytes) = &self.text;
        address
            .checked_sub(*start)
            .and_then(|offset| bytes.get(usize::try_from(offset).ok()?..))
            .unwrap_or(&[])
    }

    /// Data lies at `address`, a literal or a jump table, and not an instruction.
    pub fn is_data(&self, address: u32) -> bool {
        self.mapping
            .range(..=address)
            .next_back()
            .is_some_and(|(_, data)| *data)
    }

    /// The name of the function that begins at `address`.
    pub fn name(&self, address: u32) -> &str {
        self.functions
            .get(&address)
            .map_or("?", |function| &function.name)
    }
}

fn words(bytes: &[u8]) -> impl Iterator<Item = u32> {
    bytes.chunks_exact(4).map(|word| {
        word.iter()
            .rev()
            .fold(0, |value, byte| value << 8 | u32::from(*byte))
    })
}
