//! The device that every machine has.

use std::sync::Arc;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::batch::launch_index;
use crate::{
    Batch, Context, Control, Done, Exception, LaunchError, LaunchException, RayGeneration,
};

/// How many launch indices one thread takes at a time, at most: enough to hide the cost of taking.
const LARGEST_CHUNK: usize = 256;

/// Into how many chunks a launch is cut, if it has as many indices, so that one of few but heavy
/// elements still keeps every thread busy, and all end together.
const CHUNKS: usize = 1024;

/// Runs launches on the threads of this machine.
#[derive(Clone, Debug)]
pub struct Cpu {
    pool: Option<Arc<ThreadPool>>,
}

/// What a launch did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LaunchReport {
    /// How many rays were traced, also by launch indices that were given up.
    pub rays: u64,
    /// How many launch indices were run: all of them, unless the launch was stopped.
    pub indices: u64,
    /// Whether it was stopped from outside before the end.
    pub stopped: bool,
}

impl Cpu {
    /// With every thread of the machine.
    #[must_use]
    pub const fn all_threads() -> Self {
        Self { pool: None }
    }

    /// With so many threads; 0 means every one of the machine.
    ///
    /// # Errors
    /// When the operating system does not give them.
    pub fn with_threads(threads: usize) -> Result<Self, rayon::ThreadPoolBuildError> {
        if threads == 0 {
            return Ok(Self::all_threads());
        }
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        Ok(Self {
            pool: Some(Arc::new(pool)),
        })
    }

    /// How many threads launches run on.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.pool
            .as_ref()
            .map_or_else(rayon::current_num_threads, |p| p.current_num_threads())
    }

    /// Runs `operation` on these threads, so that what it does in parallel stays within them.
    pub fn install<T: Send>(&self, operation: impl FnOnce() -> T + Send) -> T {
        match &self.pool {
            Some(pool) => pool.install(operation),
            None => operation(),
        }
    }

    /// Runs the ray generation program once for every launch index of `size` (dimensions that are
    /// not used are 1), each on its own element of `output`, x running fastest. A launch without
    /// indices does nothing.
    ///
    /// The result is the same for any number of threads, as long as what a program does to an
    /// element depends on nothing but its launch index and the pipeline.
    ///
    /// # Errors
    /// When `output` is not as large as the launch, or a program raises an exception that the
    /// exception program does not settle; all other elements are done even then.
    ///
    /// # Panics
    /// When a program panics, with what it panicked with, once the threads have come to rest. Which
    /// other elements are done is open then; the device is as good as before.
    pub fn launch<Entry, P: RayGeneration<Entry>>(
        &self,
        program: &P,
        size: [u32; 3],
        output: &mut [P::Output],
        control: &Control<'_>,
    ) -> Result<LaunchReport, LaunchError> {
        let launch = size.map(u128::from).iter().product();
        if launch != output.len() as u128 {
            return Err(LaunchError::BufferSize {
                launch,
                buffer: output.len(),
            });
        }
        // It follows from the size alone, so that progress comes in the same parts on any machine.
        let chunk = output.len().div_ceil(CHUNKS).clamp(1, LARGEST_CHUNK);
        let part = self.install(|| {
            output
                .par_chunks_mut(chunk)
                .enumerate()
                .map(|(place, elements)| run(program, size, place * chunk, elements, control))
                .reduce(Part::default, Part::then)
        });
        match part.exception {
            Some(exception) => Err(exception.into()),
            None => Ok(part.report),
        }
    }
}

/// What became of some consecutive launch indices.
#[derive(Default)]
struct Part {
    report: LaunchReport,
    /// Of those not settled, the one with the smallest launch index.
    exception: Option<LaunchException>,
}

impl Part {
    /// This part and the one after it. Rayon keeps the order, so the first exception stays first.
    fn then(self, next: Self) -> Self {
        Self {
            report: LaunchReport {
                rays: self.report.rays + next.report.rays,
                indices: self.report.indices + next.report.indices,
                stopped: self.report.stopped | next.report.stopped,
            },
            exception: self.exception.or(next.exception),
        }
    }
}

fn run<Entry, P: RayGeneration<Entry>>(
    program: &P,
    size: [u32; 3],
    first: usize,
    elements: &mut [P::Output],
    control: &Control<'_>,
) -> Part {
    let mut part = Part::default();
    if !elements.is_empty() && !control.is_stopped() {
        let mut batch = Batch::new(program, control, first, elements.len(), size);
        if program.generate_many(&mut batch, elements) {
            part.report.rays = batch.rays();
            part.report.indices = elements.len() as u64;
        }
    }
    let mut index = launch_index(first, size);
    // What was not done at once is done one by one.
    let done = part.report.indices as usize;
    for element in &mut elements[done..] {
        if control.is_stopped() {
            part.report.stopped = true;
            break;
        }
        let mut cx = Context::new(program, control, index, size);
        let result = program.generate(&mut cx, element);
        part.report.rays += cx.rays();
        match result {
            Ok(()) => {}
            // A program that makes this up has raised an exception like any other.
            Err(Exception::Stopped) if control.is_stopped() => {
                part.report.stopped = true;
                break;
            }
            Err(exception) => {
                let raised = program.exception(LaunchException { index, exception }, element);
                part.exception = part.exception.or(raised.err());
            }
        }
        part.report.indices += 1;
        advance(&mut index, size);
    }
    if let Some(progress) = control.progress
        && part.report.rays + part.report.indices > 0
    {
        progress(Done {
            indices: part.report.indices,
            rays: part.report.rays,
        });
    }
    part
}

/// Goes on to the next launch index.
#[inline]
const fn advance([x, y, z]: &mut [u32; 3], [width, height, _]: [u32; 3]) {
    *x += 1;
    if *x == width {
        *x = 0;
        *y += 1;
        if *y == height {
            *y = 0;
            *z += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advancing_and_dividing_agree_on_the_launch_index() {
        for size in [[7, 3, 2], [1, 1, 9], [5, 1, 1], [1, 4, 3]] {
            let mut index = [0, 0, 0];
            for element in 0..size.iter().product::<u32>() as usize {
                assert_eq!(
                    index,
                    launch_index(element, size),
                    "element {element} of {size:?}"
                );
                advance(&mut index, size);
            }
        }
    }
}
