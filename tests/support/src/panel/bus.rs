//! The wires between a driver and the controller, as embedded-hal sees them.

use super::Controller;
use core::convert::Infallible;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::spi::{self, Operation, SpiDevice};
use std::cell::{Ref, RefCell, RefMut};
use std::rc::Rc;

#[derive(Debug)]
struct Wires {
    controller: Controller,
    /// The D/C line: high for data.
    data: bool,
    /// The number of bytes after which the bus fails once.
    until_failure: Option<usize>,
}

/// A controller with its bus and its D/C line; all clones share it.
#[derive(Clone, Debug)]
pub struct Panel(Rc<RefCell<Wires>>);

/// The bus failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Failure;

impl Panel {
    pub fn new() -> Self {
        Self::of(Controller::new())
    }

    pub fn of(controller: Controller) -> Self {
        Self(Rc::new(RefCell::new(Wires { controller, data: false, until_failure: None })))
    }

    pub fn controller(&self) -> Ref<'_, Controller> {
        Ref::map(self.0.borrow(), |wires| &wires.controller)
    }

    pub fn controller_mut(&self) -> RefMut<'_, Controller> {
        RefMut::map(self.0.borrow_mut(), |wires| &mut wires.controller)
    }

    /// Makes the bus fail once, after `bytes` more bytes.
    pub fn fail_after(&self, bytes: usize) {
        self.0.borrow_mut().until_failure = Some(bytes);
    }

    pub fn data_or_command(&self) -> DataOrCommand {
        DataOrCommand(self.clone())
    }
}

impl spi::ErrorType for Panel {
    type Error = Failure;
}

impl spi::Error for Failure {
    fn kind(&self) -> spi::ErrorKind {
        spi::ErrorKind::Other
    }
}

impl SpiDevice for Panel {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Failure> {
        let Wires { controller, data, until_failure } = &mut *self.0.borrow_mut();
        for operation in operations {
            let Operation::Write(bytes) = operation else {
                controller.errors.push("nothing is read from this panel".into());
                return Err(Failure);
            };
            for byte in bytes.iter() {
                if let Some(left) = until_failure {
                    if *left == 0 {
                        *until_failure = None;
                        return Err(Failure);
                    }
                    *left -= 1;
                }
                controller.receive(*byte, *data);
            }
        }
        Ok(())
    }
}

/// The D/C line.
#[derive(Debug)]
pub struct DataOrCommand(Panel);

impl digital::ErrorType for DataOrCommand {
    type Error = Infallible;
}

impl OutputPin for DataOrCommand {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0 .0.borrow_mut().data = false;
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0 .0.borrow_mut().data = true;
        Ok(())
    }
}

/// A delay that does not wait.
pub struct NoDelay;

impl DelayNs for NoDelay {
    fn delay_ns(&mut self, _: u32) {}
}
