//! Ray programs from outside, as a user writes them: one binary, one file a subject.

mod control;
mod exceptions;
mod hits;
mod intersection;
mod launch;
mod many;
mod nesting;
mod row;
