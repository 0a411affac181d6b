//! A stack that grows too far faults at once instead of overwriting variables in silence.

use cortex_m::peripheral::MPU;

/// log2 of the guard's size in bytes, less one, as the MPU wants it: 4 KiB, so that no frame in the image steps over it.
/// It lies in memory that nothing uses.
const SIZE_FIELD: u32 = 11;
const SIZE: u32 = 1 << (SIZE_FIELD + 1);

unsafe extern "C" {
    /// First byte after all variables (cortex-m-rt's link.x).
    static __sheap: u8;
}

/// Makes the first whole block of [`SIZE`] bytes above the variables untouchable (ARMv7-M, B3.5). The fault it causes
/// escalates to HardFault, where the MPU does not apply: the handler can still push its own frame.
pub(crate) fn enable(mpu: &mut MPU) {
    const ENABLE: u32 = 1;
    const DEFAULT_MAP_ELSEWHERE: u32 = 1 << 2;
    const EXECUTE_NEVER: u32 = 1 << 28;
    const REGION_0: u32 = 1 << 4;
    let free = core::ptr::addr_of!(__sheap) as u32;
    let base = free.wrapping_add(SIZE - 1) & !(SIZE - 1);
    // SAFETY: the region covers only memory between the variables and the deepest stack; access permission 0 in RASR
    // is "none". Nothing else uses the MPU.
    unsafe {
        mpu.rbar.write(base | REGION_0);
        mpu.rasr.write(EXECUTE_NEVER | (SIZE_FIELD << 1) | ENABLE);
        mpu.ctrl.write(ENABLE | DEFAULT_MAP_ELSEWHERE);
    }
    cortex_m::asm::dsb();
    cortex_m::asm::isb();
}
