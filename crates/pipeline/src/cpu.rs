//! The device that every machine has.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::{Context, Control, Done, LaunchError, LaunchException, RayGeneration};

/// How many launch indices one thread takes at a time: enough to hide the cost of taking, few
/// enough that the threads end together.
const CHUNK: usize = 256;

/// Runs launches on the threads of this machine.
#[derive(Clone, Debug)]
pub struct Cpu {
    pool: Option<Arc<ThreadPool>>,
}

/// What a launch did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LaunchReport {
    /// How many rays were traced.
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
    /// not used are 1), each on its own element of `output`, x running fastest.
    ///
    /// The result is the same for any number of threads.
    ///
    /// # Errors
    /// When `output` is not as large as the launch, or a program raises an exception that the
    /// exception program does not settle; all other elements are done even then.
    pub fn launch<P: RayGeneration>(
        &self,
        program: &P,
        size: [u32; 3],
        output: &mut [P::Output],
        control: &Control<'_>,
    ) -> Result<LaunchReport, LaunchError> {
        let launch = size
            .iter()
            .try_fold(1_u64, |volume, &n| volume.checked_mul(n.into()));
        let launch = launch.unwrap_or(u64::MAX);
        if launch != output.len() as u64 {
            return Err(LaunchError::BufferSize {
                launch,
                buffer: output.len(),
            });
        }
        let parts: Vec<Part> = self.install(|| {
            output
                .par_chunks_mut(CHUNK)
                .enumerate()
                .map(|(chunk, elements)| {
                    if control
                        .stop
                        .is_some_and(|stop| stop.load(Ordering::Relaxed))
                    {
                        return Part {
                            stopped: true,
                            ..Part::default()
                        };
                    }
                    let part = run(program, size, chunk * CHUNK, elements);
                    if let Some(progress) = control.progress {
                        progress(part.done());
                    }
                    part
                })
                .collect()
        });
        let mut report = LaunchReport::default();
        // In the order of launch indices: the first exception is the one with the smallest.
        for part in parts {
            if let Some(exception) = part.exception {
                return Err(exception.into());
            }
            report.rays += part.rays;
            report.indices += part.indices;
            report.stopped |= part.stopped;
        }
        Ok(report)
    }
}

/// What became of some consecutive launch indices.
#[derive(Default)]
struct Part {
    rays: u64,
    indices: u64,
    stopped: bool,
    exception: Option<LaunchException>,
}

impl Part {
    const fn done(&self) -> Done {
        Done {
            indices: self.indices,
            rays: self.rays,
        }
    }
}

fn run<P: RayGeneration>(
    program: &P,
    size: [u32; 3],
    first: usize,
    elements: &mut [P::Output],
) -> Part {
    let mut part = Part::default();
    let [width, height, _] = size.map(u64::from);
    for (offset, element) in elements.iter_mut().enumerate() {
        let linear = (first + offset) as u64;
        let index = [
            linear % width,
            linear / width % height,
            linear / (width * height),
        ]
        .map(|i| i as u32);
        let mut cx = Context::new(program, index, size);
        if let Err(exception) = program.generate(&mut cx, element) {
            let raised = program.exception(LaunchException { index, exception }, element);
            if let Err(unsettled) = raised
                && part.exception.is_none()
            {
                part.exception = Some(unsettled);
            }
        }
        part.rays += cx.rays();
        part.indices += 1;
    }
    part
}
