//! No panic: in release the handler calls a function that nowhere exists, so the linker refuses an image from which a
//! panic can be reached and names this function. A debug image stops at a breakpoint, which the fault handler reports.
//! The measuring images are not for use: theirs prints and ends QEMU with a failure.

#[cfg(not(any(debug_assertions, feature = "bench")))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        safe fn deictic_panic_path_reachable() -> !;
    }
    deictic_panic_path_reachable()
}

#[cfg(all(debug_assertions, not(feature = "bench")))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        cortex_m::asm::udf();
    }
}

#[cfg(feature = "bench")]
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    cortex_m_semihosting::hprintln!("{}", info);
    crate::mps2_an386::stop()
}
