//! Rows of binary numbers, in either byte order.

use super::collected::{Collected, Role, SLOTS, slot_name};
use super::header::{Element, Kind, Number};
use crate::error::{Fault, FormatError};
use crate::source::Source;

/// Items of a list that are looked at together.
const PIECE: u64 = 4096;

pub(super) fn read_rows<const BIG: bool>(
    source: &mut Source<'_>,
    element: &Element,
    role: &Role,
    collected: &mut Collected,
) -> Result<(), FormatError> {
    for row in 1..=element.count {
        let place = source.place();
        let outcome = read_row::<BIG>(source, element, role, collected);
        match outcome {
            Ok(()) => {}
            Err(Stop::End) => {
                let (element, rows) = (element.name.clone(), element.count);
                let fault = Fault::UnexpectedEnd { element, row, rows };
                return Err(FormatError::new(place, fault));
            }
            Err(Stop::Fault(fault)) => {
                let (element, fault) = (element.name.clone(), Box::new(fault));
                let fault = Fault::Row {
                    element,
                    row,
                    fault,
                };
                return Err(FormatError::new(place, fault));
            }
            Err(Stop::Reading(error)) => return Err(error),
        }
    }
    Ok(())
}

/// Why a row could not be read.
enum Stop {
    End,
    Fault(Fault),
    Reading(FormatError),
}

impl From<Fault> for Stop {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

impl From<FormatError> for Stop {
    fn from(error: FormatError) -> Self {
        Self::Reading(error)
    }
}

fn read_row<const BIG: bool>(
    source: &mut Source<'_>,
    element: &Element,
    role: &Role,
    collected: &mut Collected,
) -> Result<(), Stop> {
    let mut vertex = [0.0; SLOTS];
    for (column, property) in element.properties.iter().enumerate() {
        match property.kind {
            Kind::Scalar(number) => {
                let bytes = source.take(number.size())?.ok_or(Stop::End)?;
                if let Role::Vertices { slots, .. } = role
                    && let Some(slot) = slots[column]
                {
                    vertex[slot] = finite::<BIG>(bytes, number, slot_name(slot))?;
                }
            }
            Kind::List { length, item } => {
                let bytes = source.take(length.size())?.ok_or(Stop::End)?;
                let length = list_length::<BIG>(bytes, length)?;
                match role {
                    Role::Faces { corners } if *corners == column => {
                        read_list::<BIG>(source, length, item, |i| collected.push_corner(i))?;
                    }
                    Role::Strips { corners } if *corners == column => {
                        read_list::<BIG>(source, length, item, |i| collected.push_strip_corner(i))?;
                    }
                    _ => {
                        if !source.skip(length * item.size() as u64)? {
                            return Err(Stop::End);
                        }
                    }
                }
            }
        }
    }
    match role {
        Role::Vertices { .. } => collected.push_vertex(vertex),
        Role::Faces { .. } => collected.end_face(),
        Role::Strips { .. } => collected.end_strip(),
        Role::Unused => {}
    }
    Ok(())
}

fn read_list<const BIG: bool>(
    source: &mut Source<'_>,
    length: u64,
    item: Number,
    mut keep: impl FnMut(i64) -> Result<(), Fault>,
) -> Result<(), Stop> {
    let mut left = length;
    while left > 0 {
        let piece = left.min(PIECE);
        let bytes = source.take(piece as usize * item.size())?;
        for bytes in bytes.ok_or(Stop::End)?.chunks_exact(item.size()) {
            keep(whole::<BIG>(bytes, item)?)?;
        }
        left -= piece;
    }
    Ok(())
}

fn list_length<const BIG: bool>(bytes: &[u8], number: Number) -> Result<u64, Fault> {
    let length = whole::<BIG>(bytes, number)?;
    u64::try_from(length).map_err(|_| Fault::Unexpected {
        found: length.to_string(),
        expected: "the length of a list, 0 or more,",
    })
}

/// A number in a slot of a vertex.
fn finite<const BIG: bool>(bytes: &[u8], number: Number, what: &'static str) -> Result<f32, Fault> {
    let value = value::<BIG>(bytes, number);
    let single = value as f32;
    if single.is_finite() {
        Ok(single)
    } else {
        let found = format!("{value:e}");
        Err(Fault::NotFinite { what, found })
    }
}

/// An index or a length. Some writers give them as floating-point numbers.
fn whole<const BIG: bool>(bytes: &[u8], number: Number) -> Result<i64, Fault> {
    let value = value::<BIG>(bytes, number);
    // Every 32-bit whole number is an `f64`; the conversion cuts what is not finite or too large.
    if value.fract() == 0.0 {
        Ok(value as i64)
    } else {
        let (what, found) = ("vertex index", value.to_string());
        Err(Fault::NotANumber { what, found })
    }
}

/// The value of a number in `bytes`, which are as many as its type has.
#[inline]
fn value<const BIG: bool>(bytes: &[u8], number: Number) -> f64 {
    let wide = ordered::<BIG, 8>(bytes);
    match number {
        Number::I8 => f64::from(wide as i8),
        Number::U8 => f64::from(wide as u8),
        Number::I16 => f64::from(wide as i16),
        Number::U16 => f64::from(wide as u16),
        Number::I32 => f64::from(wide as i32),
        Number::U32 => f64::from(wide as u32),
        Number::F32 => f64::from(f32::from_bits(wide as u32)),
        Number::F64 => f64::from_bits(wide),
    }
}

/// Up to `N` bytes as one number.
#[inline]
fn ordered<const BIG: bool, const N: usize>(bytes: &[u8]) -> u64 {
    let join = |sum: u64, &byte: &u8| sum << 8 | u64::from(byte);
    let bytes = &bytes[..bytes.len().min(N)];
    if BIG {
        bytes.iter().fold(0, join)
    } else {
        bytes.iter().rev().fold(0, join)
    }
}
