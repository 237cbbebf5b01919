//! How long every place lies in shadow: exact in time, and sampled.
