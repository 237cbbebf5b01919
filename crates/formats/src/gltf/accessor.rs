//! Accessors: numbers in buffers (section 3.6 of the specification). They are looked up one by one,
//! so that nothing is allocated for a count.

use super::buffer::{Buffers, no_such};
use super::document::{AccessorSpec, Document, SparseSpec};
use super::wrong;
use crate::error::FormatError;

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    const fn of(code: u32) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The first number of some bytes. Whole numbers that are normalized are taken to 0 to 1, or to
    /// −1 to 1 if they have a sign.
    fn number(self, bytes: &[u8], normalized: bool) -> f32 {
        let most = |most: f32| if normalized { most } else { 1.0 };
        let signed = |x: f32| if normalized { x.max(-1.0) } else { x };
        match (self, bytes) {
            (Self::I8, [a, ..]) => signed(f32::from(*a as i8) / most(127.0)),
            (Self::U8, [a, ..]) => f32::from(*a) / most(255.0),
            (Self::I16, [a, b, ..]) => {
                signed(f32::from(i16::from_le_bytes([*a, *b])) / most(32767.0))
            }
            (Self::U16, [a, b, ..]) => f32::from(u16::from_le_bytes([*a, *b])) / most(65535.0),
            (Self::U32, [a, b, c, d, ..]) => {
                let whole = f64::from(u32::from_le_bytes([*a, *b, *c, *d]));
                (if normalized {
                    whole / f64::from(u32::MAX)
                } else {
                    whole
                }) as f32
            }
            (Self::F32, [a, b, c, d, ..]) => f32::from_le_bytes([*a, *b, *c, *d]),
            _ => 0.0,
        }
    }

    /// The first whole number of some bytes, without sign.
    fn whole(self, bytes: &[u8]) -> u32 {
        match (self, bytes) {
            (Self::U8, [a, ..]) => u32::from(*a),
            (Self::U16, [a, b, ..]) => u32::from(u16::from_le_bytes([*a, *b])),
            (Self::U32, [a, b, c, d, ..]) => u32::from_le_bytes([*a, *b, *c, *d]),
            _ => 0,
        }
    }
}

/// What an accessor has to be like for its use.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    /// The types that are right, such as "VEC3".
    pub(super) kinds: &'a [&'a str],
    /// Whether it holds indices: whole numbers without sign.
    pub(super) indices: bool,
}

/// An accessor whose elements are all there.
#[derive(Debug)]
pub(super) struct Accessor<'a> {
    pub(super) count: u64,
    component: Component,
    normalized: bool,
    /// How many numbers an element has.
    width: usize,
    base: Option<Strided<'a>>,
    sparse: Option<Sparse<'a>>,
}

/// Elements at a distance from one another.
#[derive(Debug)]
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
}

impl<'a> Strided<'a> {
    fn at(&self, index: u64) -> &'a [u8] {
        let start = index as usize * self.stride;
        self.bytes.get(start..).unwrap_or_default()
    }
}

/// Elements that stand in place of others.
#[derive(Debug)]
struct Sparse<'a> {
    count: u64,
    indices: Strided<'a>,
    index: Component,
    values: Strided<'a>,
}

impl<'a> Sparse<'a> {
    fn index(&self, place: u64) -> u64 {
        u64::from(self.index.whole(self.indices.at(place)))
    }

    /// The bytes of an element, if it is one of those; its indices ascend.
    fn find(&self, index: u64) -> Option<&'a [u8]> {
        let (mut low, mut high) = (0, self.count);
        while low < high {
            let middle = low + (high - low) / 2;
            if self.index(middle) < index {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        (low < self.count && self.index(low) == index).then(|| self.values.at(low))
    }
}

impl<'a> Accessor<'a> {
    /// The accessor that `user` refers to, checked: its type is one of those wanted, and all its
    /// bytes are there.
    pub(super) fn of(
        document: &Document,
        buffers: &'a Buffers<'_>,
        index: usize,
        wanted: Wanted<'_>,
        user: &str,
    ) -> Result<Self, FormatError> {
        let spec = document.accessors.get(index).ok_or_else(|| {
            let count = document.accessors.len();
            wrong(user, no_such("accessors", index, count))
        })?;
        let place = format!("accessors[{index}]");
        let component = component(spec, wanted, &place, user)?;
        let width = width(spec, wanted, &place, user)?;
        let element = width * component.size();
        let base = match spec.buffer_view {
            None => None,
            Some(view) => {
                let view = buffers.view(document, view, &format!("{place}.bufferView"))?;
                let stride = view.stride.unwrap_or(element);
                if stride < element {
                    let message = format!(
                        "its bufferView has a byteStride of {stride}, but an element has \
                         {element} bytes"
                    );
                    return Err(wrong(place, message));
                }
                let shape = (spec.count, stride, element);
                Some(strided(view.bytes, spec.byte_offset, shape, &place)?)
            }
        };
        let sparse = match &spec.sparse {
            None => None,
            Some(sparse) => Some(read_sparse(
                document, buffers, spec.count, sparse, element, &place,
            )?),
        };
        Ok(Self {
            count: spec.count,
            component,
            normalized: spec.normalized && component != Component::F32,
            width,
            base,
            sparse,
        })
    }

    /// An element as numbers; 0 where it has fewer than `N` or there are fewer elements. An accessor
    /// without a buffer view is zeros, but for what is sparse.
    pub(super) fn numbers<const N: usize>(&self, index: u64) -> [f32; N] {
        let Some(bytes) = self.element(index) else {
            return [0.0; N];
        };
        let size = self.component.size();
        std::array::from_fn(|i| {
            if i >= self.width {
                return 0.0;
            }
            let bytes = bytes.get(i * size..).unwrap_or_default();
            self.component.number(bytes, self.normalized)
        })
    }

    /// An element as an index.
    pub(super) fn index(&self, index: u64) -> u32 {
        let bytes = self.element(index);
        bytes.map_or(0, |bytes| self.component.whole(bytes))
    }

    fn element(&self, index: u64) -> Option<&'a [u8]> {
        if index >= self.count {
            return None;
        }
        let replaced = self.sparse.as_ref().and_then(|sparse| sparse.find(index));
        replaced.or_else(|| self.base.as_ref().map(|base| base.at(index)))
    }
}

fn component(
    spec: &AccessorSpec,
    wanted: Wanted<'_>,
    place: &str,
    user: &str,
) -> Result<Component, FormatError> {
    let code = spec.component_type;
    let component = Component::of(code).ok_or_else(|| {
        wrong(
            format!("{place}.componentType"),
            format!(
                "is {code}; 5120 (byte), 5121 (unsigned byte), 5122 (short), 5123 (unsigned \
                 short), 5125 (unsigned int) or 5126 (float) is right"
            ),
        )
    })?;
    let whole = matches!(component, Component::U8 | Component::U16 | Component::U32);
    if wanted.indices && !whole {
        let message = format!(
            "is {code}, but {user} needs 5121 (unsigned byte), 5123 (unsigned short) or 5125 \
             (unsigned int)"
        );
        return Err(wrong(format!("{place}.componentType"), message));
    }
    Ok(component)
}

fn width(
    spec: &AccessorSpec,
    wanted: Wanted<'_>,
    place: &str,
    user: &str,
) -> Result<usize, FormatError> {
    let width = match spec.kind.as_str() {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        _ => 0,
    };
    if width > 0 && wanted.kinds.contains(&spec.kind.as_str()) {
        return Ok(width);
    }
    let message = format!(
        "is {:?}, but {user} needs {}",
        spec.kind,
        wanted.kinds.join(" or ")
    );
    Err(wrong(format!("{place}.type"), message))
}

/// `count` elements of `element` bytes each, `stride` bytes apart, from a byte of a view on.
fn strided<'a>(
    view: &'a [u8],
    offset: u64,
    (count, stride, element): (u64, usize, usize),
    place: &str,
) -> Result<Strided<'a>, FormatError> {
    let needed = match count {
        0 => 0,
        _ => (count - 1)
            .saturating_mul(stride as u64)
            .saturating_add(element as u64),
    };
    let end = offset.saturating_add(needed);
    if end > view.len() as u64 {
        let message = format!(
            "{count} elements need bytes {offset} to {end} of its bufferView, which has only {}",
            view.len()
        );
        return Err(wrong(place, message));
    }
    Ok(Strided {
        bytes: &view[offset as usize..end as usize],
        stride,
    })
}

fn read_sparse<'a>(
    document: &Document,
    buffers: &'a Buffers<'_>,
    count: u64,
    spec: &SparseSpec,
    element: usize,
    place: &str,
) -> Result<Sparse<'a>, FormatError> {
    let place = format!("{place}.sparse");
    let code = spec.indices.component_type;
    let component = Component::of(code)
        .filter(|c| matches!(c, Component::U8 | Component::U16 | Component::U32))
        .ok_or_else(|| {
            let message = format!(
                "is {code}; 5121 (unsigned byte), 5123 (unsigned short) or 5125 (unsigned int) \
                 is right"
            );
            wrong(format!("{place}.indices.componentType"), message)
        })?;
    let at = format!("{place}.indices");
    let view = buffers.view(document, spec.indices.buffer_view, &at)?;
    let size = component.size();
    let shape = (spec.count, size, size);
    let indices = strided(view.bytes, spec.indices.byte_offset, shape, &at)?;
    let at = format!("{place}.values");
    let view = buffers.view(document, spec.values.buffer_view, &at)?;
    let shape = (spec.count, element, element);
    let values = strided(view.bytes, spec.values.byte_offset, shape, &at)?;
    let sparse = Sparse {
        count: spec.count,
        indices,
        index: component,
        values,
    };
    let mut before = None;
    for i in 0..sparse.count {
        let index = sparse.index(i);
        if index >= count {
            let message = format!("index {index}, but the accessor has only {count} elements");
            return Err(wrong(format!("{place}.indices"), message));
        }
        if before.is_some_and(|before| before >= index) {
            let message =
                format!("index {index} does not come after the one before it; they ascend");
            return Err(wrong(format!("{place}.indices"), message));
        }
        before = Some(index);
    }
    Ok(sparse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normalized_numbers_are_what_the_specification_says() {
        let number = |component: Component, bytes: &[u8]| component.number(bytes, true);
        assert_eq!(number(Component::I8, &[127]), 1.0);
        assert_eq!(number(Component::I8, &[0x80]), -1.0, "-128 is -1 too");
        assert_eq!(number(Component::I8, &[0x81]), -1.0);
        assert_eq!(number(Component::U8, &[51]), 0.2);
        assert_eq!(number(Component::I16, &[0xff, 0x7f]), 1.0);
        assert_eq!(number(Component::I16, &[0x00, 0x80]), -1.0);
        assert_eq!(number(Component::U16, &[0xff, 0xff]), 1.0);
        assert_eq!(number(Component::U32, &[0xff; 4]), 1.0);
        assert_eq!(number(Component::F32, &2.5_f32.to_le_bytes()), 2.5);
        assert_eq!(Component::I16.number(&[0xfe, 0xff], false), -2.0);
        assert_eq!(Component::U8.number(&[200], false), 200.0);
    }
}
