//! Prints a line `case,way,instructions` for every case and way, and at last of placing an object and of turning its light.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::board::{println, Clock};
use bench::firmware;
use bench::growth::{placing, Memory, CASES};

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = Clock::new()?;
    for (at, case) in CASES.iter().enumerate() {
        for way in case.ways() {
            println!("{at},{way},{}", case.count(way, memory, &mut clock)?);
        }
    }
    let [place, light] = placing(&mut clock)?;
    println!("placing,{place}\nlight,{light}");
    Some(())
});
