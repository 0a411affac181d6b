//! Ctrl-C as something to be asked about.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use miette::{Context, IntoDiagnostic, Result};

/// Ctrl-C, noted instead of ending the program in the middle of something: 1 after it was pressed.
pub(super) fn interrupts() -> Result<Arc<AtomicU8>> {
    let count = Arc::new(AtomicU8::new(0));
    let counted = Arc::clone(&count);
    ctrlc::set_handler(move || {
        counted.store(1, Ordering::Relaxed);
    })
    .into_diagnostic()
    .wrap_err("Ctrl-C cannot be watched for")?;
    Ok(count)
}
