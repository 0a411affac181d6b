#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| deictic_tests::fuzz::command::run(bytes));
