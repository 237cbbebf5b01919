//! Shadow time as a whole: against closed forms, against rays, and what must always hold.

mod against_rays;
mod closed_forms;
mod disc;
mod faces;
mod fast;
mod numbers;
mod solids;
mod spells;
mod whole;
