//! Instructions of two halfwords.

use super::{Flow, PC, SP, Stack, sign_extend};

pub(super) fn wide(address: u32, first: u16, second: u16) -> (Stack, Flow) {
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
