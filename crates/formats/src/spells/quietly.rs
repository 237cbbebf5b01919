//! Broken files on which the library that unpacks them panics.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

use crate::columns::wrong;
use crate::error::FormatError;

thread_local! {
    static IS_QUIET: Cell<bool> = const { Cell::new(false) };
}

/// Reads; where that panics, the file is what is wrong, and nothing is said but that. What is read is dropped, so nobody sees it half done.
pub(super) fn quietly<T>(read: impl FnOnce() -> Result<T, FormatError>) -> Result<T, FormatError> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let others = take_hook();
        set_hook(Box::new(move |panic| {
            if !IS_QUIET.get() {
                others(panic);
            }
        }));
    });
    IS_QUIET.set(true);
    let read = catch_unwind(AssertUnwindSafe(read));
    IS_QUIET.set(false);
    read.unwrap_or_else(|_| Err(wrong("its pages are broken")))
}
