//! Memory for large lists, as the system gives it.

use std::mem::MaybeUninit;

use rayon::prelude::*;

/// Values a task.
const TASK: usize = 1 << 14;
/// From how many bytes on a list is large.
#[cfg(target_os = "linux")]
const LARGE: usize = 1 << 23;

/// So many values, all bits zero. Where the system can give large lists large pages it is asked to,
/// before they are touched: to come by small ones took a fifth of a build.
///
/// # Safety
/// - All bits zero are a value of this type.
pub(super) unsafe fn zeroed<T: Send>(count: usize) -> Vec<T> {
    let mut list = Box::<[T]>::new_uninit_slice(count);
    #[cfg(target_os = "linux")]
    ask_for_large_pages(&list);
    list.par_chunks_mut(TASK)
        .for_each(|part| part.fill_with(MaybeUninit::zeroed));
    // SAFETY: all were written; the caller's promise.
    unsafe { list.assume_init() }.into_vec()
}

/// Does so; whether the system heeds it does not matter.
#[cfg(target_os = "linux")]
fn ask_for_large_pages<T>(list: &[T]) {
    use rustix::mm::{Advice, madvise};
    let bytes = size_of_val(list);
    if bytes < LARGE {
        return;
    }
    let page = rustix::param::page_size();
    let from = list.as_ptr().cast::<u8>();
    let skipped = from.align_offset(page);
    if skipped >= bytes {
        return;
    }
    let whole = (bytes - skipped) / page * page;
    // SAFETY: whole pages that this list owns; the advice changes nothing of what they hold.
    let _ = unsafe {
        madvise(
            from.add(skipped).cast_mut().cast(),
            whole,
            Advice::LinuxHugepage,
        )
    };
}
