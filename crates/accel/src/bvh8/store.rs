//! Where nodes and triangles lie: in lists of their own, or in a file in memory.

use std::marker::PhantomData;
use std::ops::{Deref, Range};
use std::sync::Arc;

use bytemuck::Pod;
use memmap2::Mmap;

/// A list that is read in the same way wherever it lies.
#[derive(Clone, Debug)]
pub(crate) enum Store<T> {
    Owned(Vec<T>),
    Mapped(Mapped<T>),
}

/// A part of a file: one that is mapped, or pages of memory that it was read into.
#[derive(Clone, Debug)]
pub(crate) struct Mapped<T> {
    map: Arc<Mmap>,
    bytes: Range<usize>,
    holds: PhantomData<T>,
}

impl<T: Pod> Store<T> {
    /// The list in some bytes of a file. It is not copied when this is cloned.
    ///
    /// # Panics
    /// When the bytes are not there, or not a whole number of entries, or not aligned.
    pub(crate) fn mapped(map: &Arc<Mmap>, bytes: Range<usize>) -> Self {
        let _: &[T] = bytemuck::cast_slice(&map[bytes.clone()]);
        Self::Mapped(Mapped {
            map: Arc::clone(map),
            bytes,
            holds: PhantomData,
        })
    }

    /// The list, to be changed: out of a file it is copied, once.
    pub(crate) fn to_mut(&mut self) -> &mut Vec<T> {
        if let Self::Mapped(_) = self {
            *self = Self::Owned(self.to_vec());
        }
        match self {
            Self::Owned(list) => list,
            Self::Mapped(_) => unreachable!("it was copied"),
        }
    }
}

impl<T> From<Vec<T>> for Store<T> {
    fn from(list: Vec<T>) -> Self {
        Self::Owned(list)
    }
}

impl<T: Pod> Deref for Store<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        match self {
            Self::Owned(list) => list,
            Self::Mapped(part) => bytemuck::cast_slice(&part.map[part.bytes.clone()]),
        }
    }
}
