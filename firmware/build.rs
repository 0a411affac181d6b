//! Tells the linker which board the image is for. Interrupt vectors and memory come from the board's own tables.
use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=../memory.x");
    if env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("none") {
        return Ok(());
    }
    if env::var_os("CARGO_FEATURE_MPS2_AN386").is_some() {
        // cortex-m-rt's link.x includes a device.x with default handlers. The stm32-metapac crate brings its own; the
        // mps2-an386's vector table names every handler itself.
        let out = PathBuf::from(env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?);
        fs::write(out.join("device.x"), "")?;
        println!("cargo:rustc-link-search={}", out.display());
        println!("cargo:rustc-link-arg-bins=--defsym=_deictic_qemu=1");
    }
    Ok(())
}
