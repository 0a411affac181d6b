//! Tells the linker which board the image is for, and puts the board's key into it, where there is one. Interrupt vectors and memory come from the board's own tables.
use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=../memory.x");
    write_key()?;
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

/// The key of this board: 64 hexadecimal digits in the file that DEICTIC_KEY names; none without it.
fn write_key() -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-env-changed=DEICTIC_KEY");
    let key = match env::var_os("DEICTIC_KEY") {
        None => None,
        Some(path) => {
            let path = PathBuf::from(path);
            println!("cargo:rerun-if-changed={}", path.display());
            let text = fs::read_to_string(&path)
                .map_err(|e| format!("DEICTIC_KEY={}: {e}", path.display()))?;
            Some(
                digits(text.trim())
                    .ok_or("DEICTIC_KEY names a file that does not hold 64 hexadecimal digits")?,
            )
        }
    };
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?);
    fs::write(out.join("key.rs"), format!("{key:?}"))?;
    Ok(())
}

fn digits(text: &str) -> Option<[u8; 32]> {
    let bytes: Option<Vec<u8>> = (0..text.len())
        .step_by(2)
        .map(|at| u8::from_str_radix(text.get(at..at + 2)?, 16).ok())
        .collect();
    bytes?.try_into().ok()
}
