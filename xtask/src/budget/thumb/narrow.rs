//! Instructions of one halfword.

use super::{Flow, LR, PC, SP, Stack, sign_extend};

pub(super) fn narrow(address: u32, op: u16) -> (Stack, Flow) {
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
