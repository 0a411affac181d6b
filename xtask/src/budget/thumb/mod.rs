//! What a Thumb-2 instruction does to the stack pointer and to the flow of control (ARMv7-M Architecture Reference
//! Manual, chapters A5 to A7). Nothing else of it matters here.

mod narrow;
mod wide;

use narrow::narrow;
use wide::wide;

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
