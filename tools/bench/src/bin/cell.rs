//! A cell: the name of the image that is built chooses it.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{of_image, Cell, Image};

type Chosen = Image<{ of_image(env!("CARGO_BIN_NAME")) }>;
type Memory = <Chosen as Cell>::Memory;

#[cfg(target_os = "none")]
#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    use core::cell::RefCell;
    use critical_section::Mutex;
    // Not on the stack.
    static MEMORY: Mutex<RefCell<Memory>> = Mutex::new(RefCell::new(Memory::NEW));
    bench::stack::paint();
    let counted = critical_section::with(|token| Chosen::draw(&mut MEMORY.borrow_ref_mut(token)));
    let stack = bench::stack::deepest();
    if let Some(counted) = counted {
        bench::cells::print(counted, stack);
    }
    bench::board::end(counted.is_some())
}

#[cfg(not(target_os = "none"))]
fn main() {
    let counted = Chosen::draw(&mut *Box::<Memory>::new(Memory::NEW));
    bench::board::end(counted.is_some())
}
