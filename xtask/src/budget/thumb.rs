//! What a Thumb-2 instruction does to the stack pointer and to the flow of control (ARMv7-M Architecture Reference
//! Manual, chapters A5 to A7). Nothing else of it matters here.

/// One decoded instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// Bytes: 2 or 4.
    pub size: u32,
    /// What it does to the stack.
    pub stack: Stack,
    /// Where control goes next.
    pub flow: Flow,
}

/// Effect on the stack pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stack {
    /// Takes that many bytes; gives back when negative. 0 for most instructions.
    Grow(i32),
    /// Sets it to something that only a running program knows.
    Unknown,
}

/// Effect on the program counter. Targets are absolute addresses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// The next instruction.
    Next,
    /// `b`: a jump in the function or, to elsewhere, a tail call.
    Jump(u32),
    /// A conditional `b`, `cbz`, `cbnz`.
    Branch(u32),
    /// `bl`.
    Call(u32),
    /// `blx` with a register.
    CallIndirect,
    /// Back to the caller.
    Return,
    /// To an address in a register or in memory: a tail call through a pointer.
    JumpIndirect,
    /// `tbb`, `tbh`: a jump by the table that follows, of entries of that many bytes.
    Table(u32),
    /// `it`: that many of the following instructions are conditional.
    If(u32),
    /// `udf`: never goes on.
    Stop,
}

const SP: u16 = 13;
const LR: u16 = 14;
const PC: u16 = 15;

/// Decodes the instruction at `address`; none when `code` ends before it does.
pub fn decode(address: u32, code: &[u8]) -> Option<Instruction> {
    let first = halfword(code, 0)?;
    if first >> 11 < 0b11101 {
        let (stack, flow) = narrow(address, first);
        Some(Instruction {
            size: 2,
            stack,
            flow,
        })
    } else {
        let (stack, flow) = wide(address, first, halfword(code, 2)?);
        Some(Instruction {
            size: 4,
            stack,
            flow,
        })
    }
}

fn halfword(code: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_le_bytes(code.get(at..at + 2)?.try_into().ok()?))
}

fn narrow(address: u32, op: u16) -> (Stack, Flow) {
    let words = |count: u32| i32::try_from(4 * count).unwrap_or(i32::MAX);
    let keep = Stack::Grow(0);
    let pc = address.wrapping_add(4);
    match op {
        // push, pop
        _ if op & 0xfe00 == 0xb400 => (Stack::Grow(words((op & 0x1ff).count_ones())), Flow::Next),
        _ if op & 0xfe00 == 0xbc00 => {
            let flow = if op & 0x100 == 0 {
                Flow::Next
            } else {
                Flow::Return
            };
            (Stack::Grow(-words((op & 0x1ff).count_ones())), flow)
        }
        // add sp, #imm and sub sp, #imm
        _ if op & 0xff80 == 0xb000 => (Stack::Grow(-words(u32::from(op & 0x7f))), Flow::Next),
        _ if op & 0xff80 == 0xb080 => (Stack::Grow(words(u32::from(op & 0x7f))), Flow::Next),
        // it; with an empty mask it is a hint such as nop or wfi
        _ if op & 0xff00 == 0xbf00 => {
            let mask = op & 0xf;
            let flow = if mask == 0 {
                Flow::Next
            } else {
                Flow::If(4 - mask.trailing_zeros())
            };
            (keep, flow)
        }
        // cbz, cbnz
        _ if op & 0xf500 == 0xb100 => {
            let offset = u32::from(op >> 9 & 1) << 6 | u32::from(op >> 3 & 0x1f) << 1;
            (keep, Flow::Branch(pc.wrapping_add(offset)))
        }
        // conditional b; udf and svc share the encoding
        _ if op & 0xf000 == 0xd000 => match op >> 8 & 0xf {
            14 => (keep, Flow::Stop),
            15 => (keep, Flow::Next),
            _ => {
                let offset = sign_extend(u32::from(op & 0xff) << 1, 9);
                (keep, Flow::Branch(pc.wrapping_add(offset)))
            }
        },
        // b
        _ if op & 0xf800 == 0xe000 => {
            let offset = sign_extend(u32::from(op & 0x7ff) << 1, 12);
            (keep, Flow::Jump(pc.wrapping_add(offset)))
        }
        // bx, blx
        _ if op & 0xff80 == 0x4700 && op >> 3 & 0xf == LR => (keep, Flow::Return),
        _ if op & 0xff80 == 0x4700 => (keep, Flow::JumpIndirect),
        _ if op & 0xff80 == 0x4780 => (keep, Flow::CallIndirect),
        // mov and add between any registers
        _ if op & 0xfd00 == 0x4400 => match (op >> 4 & 8) | (op & 7) {
            SP => (Stack::Unknown, Flow::Next),
            PC if op & 0x78 == LR << 3 && op & 0xff00 == 0x4600 => (keep, Flow::Return),
            PC => (keep, Flow::JumpIndirect),
            _ => (keep, Flow::Next),
        },
        _ => (keep, Flow::Next),
    }
}

fn wide(address: u32, first: u16, second: u16) -> (Stack, Flow) {
    let keep = Stack::Grow(0);
    let base = first & 0xf;
    let destination = second >> 8 & 0xf;
    match first >> 9 {
        // ldm, stm, ldrd, strd, exclusives, tables
        0b111_0100 => multiple_or_double(first, second),
        // shifted-register arithmetic
        0b111_0101 => other_write(destination),
        // vpush, vpop and other loads and stores of floats
        0b111_0110 => {
            let writes_back = first & 0x20 != 0;
            let is_transfer = first & 0x1a0 != 0 && second & 0x0e00 == 0x0a00;
            if writes_back && is_transfer && base == SP {
                let bytes = 4 * i32::from(second & 0xff);
                let up = first & 0x80 != 0;
                (Stack::Grow(if up { -bytes } else { bytes }), Flow::Next)
            } else {
                (keep, Flow::Next)
            }
        }
        0b111_0111 => (keep, Flow::Next),
        // immediate arithmetic, branches, special registers
        _ if first >> 11 == 0b11110 && second & 0x8000 == 0 => immediate(first, second),
        _ if first >> 11 == 0b11110 => branch(address, first, second),
        // single loads and stores, register arithmetic
        0b111_1100 => single(first, second),
        0b111_1101 => other_write(destination),
        _ => (keep, Flow::Next),
    }
}

fn multiple_or_double(first: u16, second: u16) -> (Stack, Flow) {
    let keep = Stack::Grow(0);
    let base = first & 0xf;
    let load = first & 0x10 != 0;
    let writes_back = first & 0x20 != 0;
    if first & 0x40 == 0 {
        let bytes = 4 * i32::try_from(second.count_ones()).unwrap_or(0);
        let down = first & 0x100 != 0;
        let stack = match (base == SP && writes_back, down) {
            (true, true) => Stack::Grow(bytes),
            (true, false) => Stack::Grow(-bytes),
            _ => keep,
        };
        let flow = match (load && second & 0x8000 != 0, base == SP) {
            (true, true) => Flow::Return,
            (true, false) => Flow::JumpIndirect,
            _ => Flow::Next,
        };
        return (stack, flow);
    }
    if first & 0xfff0 == 0xe8d0 && second & 0xffe0 == 0xf000 {
        return (keep, Flow::Table(if second & 0x10 == 0 { 1 } else { 2 }));
    }
    // ldrd and strd write back, exclusives do not: they have this bit but not P or W.
    if base == SP && writes_back {
        let bytes = 4 * i32::from(second & 0xff);
        let up = first & 0x80 != 0;
        return (Stack::Grow(if up { -bytes } else { bytes }), Flow::Next);
    }
    (keep, Flow::Next)
}

fn immediate(first: u16, second: u16) -> (Stack, Flow) {
    let destination = second >> 8 & 0xf;
    if destination != SP {
        return (Stack::Grow(0), Flow::Next);
    }
    let imm12 = u32::from(first >> 10 & 1) << 11
        | u32::from(second >> 12 & 7) << 8
        | u32::from(second & 0xff);
    let from_sp = first & 0xf == SP;
    let (add, bytes) = match (first & 0x200 != 0, first >> 5 & 0xf) {
        // add.w and sub.w with an expanded immediate
        (false, 0b1000) => (true, expand(imm12)),
        (false, 0b1101) => (false, expand(imm12)),
        // addw and subw
        (true, 0b0000) => (true, imm12),
        (true, 0b0101) => (false, imm12),
        _ => return (Stack::Unknown, Flow::Next),
    };
    match i32::try_from(bytes) {
        Ok(bytes) if from_sp => (Stack::Grow(if add { -bytes } else { bytes }), Flow::Next),
        _ => (Stack::Unknown, Flow::Next),
    }
}

/// ThumbExpandImm (A5.3.2).
fn expand(imm12: u32) -> u32 {
    let byte = imm12 & 0xff;
    match imm12 >> 8 & 0xf {
        0 => byte,
        1 => byte << 16 | byte,
        2 => byte << 24 | byte << 8,
        3 => byte << 24 | byte << 16 | byte << 8 | byte,
        _ => (imm12 & 0x7f | 0x80).rotate_right(imm12 >> 7),
    }
}

fn branch(address: u32, first: u16, second: u16) -> (Stack, Flow) {
    let keep = Stack::Grow(0);
    let pc = address.wrapping_add(4);
    let sign = u32::from(first >> 10 & 1);
    let j1 = u32::from(second >> 13 & 1);
    let j2 = u32::from(second >> 11 & 1);
    let low = u32::from(second & 0x7ff) << 1;
    let far = {
        let i1 = !(j1 ^ sign) & 1;
        let i2 = !(j2 ^ sign) & 1;
        let offset = sign << 24 | i1 << 23 | i2 << 22 | u32::from(first & 0x3ff) << 12 | low;
        pc.wrapping_add(sign_extend(offset, 25))
    };
    match (second >> 14 & 1, second >> 12 & 1) {
        (1, 1) => (keep, Flow::Call(far)),
        (0, 1) => (keep, Flow::Jump(far)),
        (0, 0) if first >> 7 & 7 != 7 => {
            let offset = sign << 20 | j2 << 19 | j1 << 18 | u32::from(first & 0x3f) << 12 | low;
            (keep, Flow::Branch(pc.wrapping_add(sign_extend(offset, 21))))
        }
        // msr to a stack pointer
        _ if first & 0xfff0 == 0xf380
            && second & 0xff00 == 0x8800
            && matches!(second & 0xff, 8 | 9) =>
        {
            (Stack::Unknown, Flow::Next)
        }
        _ if first & 0xfff0 == 0xf7f0 && second & 0xf000 == 0xa000 => (keep, Flow::Stop),
        _ => (keep, Flow::Next),
    }
}

fn single(first: u16, second: u16) -> (Stack, Flow) {
    let base = first & 0xf;
    let target = second >> 12;
    let is_word_load = first & 0x70 == 0x50 && first & 0x100 == 0;
    // Post- or pre-indexed by an 8-bit immediate, with write-back.
    let writes_back = first & 0x80 == 0 && base != PC && second & 0x900 == 0x900;
    let stack = if writes_back && base == SP {
        let bytes = i32::from(second & 0xff);
        let up = second & 0x200 != 0;
        Stack::Grow(if up { -bytes } else { bytes })
    } else if is_word_load && target == SP {
        Stack::Unknown
    } else {
        Stack::Grow(0)
    };
    let flow = match (is_word_load && target == PC, base == SP && writes_back) {
        (true, true) => Flow::Return,
        (true, false) => Flow::JumpIndirect,
        _ => Flow::Next,
    };
    (stack, flow)
}

/// Arithmetic between registers with this destination.
fn other_write(destination: u16) -> (Stack, Flow) {
    let stack = if destination == SP {
        Stack::Unknown
    } else {
        Stack::Grow(0)
    };
    (stack, Flow::Next)
}

fn sign_extend(value: u32, bits: u32) -> u32 {
    let shift = 32 - bits;
    (((value << shift) as i32) >> shift) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Encodings by LLVM's assembler for thumbv7em, at address 0x1000.
    #[test]
    fn reads_what_the_assembler_writes() {
        use Flow::*;
        let cases: &[(&[u8], Stack, Flow)] = &[
            (&[0xf0, 0xb5], Stack::Grow(20), Next),    // push {r4-r7, lr}
            (&[0xf0, 0xbd], Stack::Grow(-20), Return), // pop {r4-r7, pc}
            (&[0x2d, 0xe9, 0xf0, 0x4f], Stack::Grow(36), Next), // push.w {r4-r11, lr}
            (&[0xbd, 0xe8, 0xf0, 0x8f], Stack::Grow(-36), Return), // pop.w {r4-r11, pc}
            (&[0x4d, 0xf8, 0x04, 0xbd], Stack::Grow(4), Next), // str r11, [sp, #-4]!
            (&[0x5d, 0xf8, 0x04, 0xfb], Stack::Grow(-4), Return), // ldr pc, [sp], #4
            (&[0x5d, 0xf8, 0x04, 0xbb], Stack::Grow(-4), Next), // ldr r11, [sp], #4
            (&[0x84, 0xb0], Stack::Grow(16), Next),    // sub sp, #16
            (&[0x04, 0xb0], Stack::Grow(-16), Next),   // add sp, #16
            (&[0xad, 0xf5, 0x00, 0x7d], Stack::Grow(512), Next), // sub.w sp, sp, #512
            (&[0x0d, 0xf5, 0x00, 0x7d], Stack::Grow(-512), Next), // add.w sp, sp, #512
            (&[0xad, 0xf2, 0x0c, 0x4d], Stack::Grow(0x40c), Next), // subw sp, sp, #1036
            (&[0x2d, 0xed, 0x04, 0x8b], Stack::Grow(16), Next), // vpush {d8, d9}
            (&[0xbd, 0xec, 0x04, 0x8b], Stack::Grow(-16), Next), // vpop {d8, d9}
            (&[0xad, 0xeb, 0x00, 0x0d], Stack::Unknown, Next), // sub.w sp, sp, r0
            (&[0xa5, 0x46], Stack::Unknown, Next),     // mov sp, r4
            (&[0x01, 0xa8], Stack::Grow(0), Next),     // add r0, sp, #4
            (&[0x9d, 0xed, 0x01, 0x0a], Stack::Grow(0), Next), // vldr s0, [sp, #4]
            (&[0xcd, 0xe9, 0x02, 0x01], Stack::Grow(0), Next), // strd r0, r1, [sp, #8]
            (&[0xfe, 0xe7], Stack::Grow(0), Jump(0x1000)), // b .
            (&[0xfe, 0xd0], Stack::Grow(0), Branch(0x1000)), // beq .
            (&[0x08, 0xb1], Stack::Grow(0), Branch(0x1006)), // cbz r0, .+6
            (&[0xff, 0xf7, 0xfe, 0xff], Stack::Grow(0), Call(0x1000)), // bl .
            (&[0xff, 0xf7, 0xfe, 0xbf], Stack::Grow(0), Jump(0x1000)), // b.w .
            (&[0x3f, 0xf4, 0xfe, 0xaf], Stack::Grow(0), Branch(0x1000)), // beq.w .
            (&[0x80, 0x47], Stack::Grow(0), CallIndirect), // blx r0
            (&[0x00, 0x47], Stack::Grow(0), JumpIndirect), // bx r0
            (&[0x70, 0x47], Stack::Grow(0), Return),   // bx lr
            (&[0xdf, 0xe8, 0x00, 0xf0], Stack::Grow(0), Table(1)), // tbb [pc, r0]
            (&[0xdf, 0xe8, 0x10, 0xf0], Stack::Grow(0), Table(2)), // tbh [pc, r0, lsl #1]
            (&[0x08, 0xbf], Stack::Grow(0), If(1)),    // it eq
            (&[0x05, 0xbf], Stack::Grow(0), If(4)),    // ittet eq
            (&[0x00, 0xbf], Stack::Grow(0), Next),     // nop
            (&[0x30, 0xbf], Stack::Grow(0), Next),     // wfi
            (&[0xfe, 0xde], Stack::Grow(0), Stop),     // udf #254
            (&[0xab, 0xbe], Stack::Grow(0), Next),     // bkpt #0xab
            (&[0x80, 0xf3, 0x08, 0x88], Stack::Unknown, Next), // msr msp, r0
            (&[0x80, 0xf3, 0x10, 0x88], Stack::Grow(0), Next), // msr primask, r0
        ];
        for (code, stack, flow) in cases {
            let size = u32::try_from(code.len()).expect("2 or 4");
            let expected = Instruction {
                size,
                stack: *stack,
                flow: *flow,
            };
            assert_eq!(decode(0x1000, code), Some(expected), "{code:02x?}");
        }
        assert_eq!(decode(0x1000, &[0x2d, 0xe9]), None);
    }
}
