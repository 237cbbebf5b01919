#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| ombra_fuzz::points(data));
