//! What a module is predicted to take of a device, from its signals alone.

use super::netlist::Module;
use crate::device::{Device, Resources};

/// The resources of one module by itself, without its instances.
pub fn own(_module: &Module, _device: &Device) -> Resources {
    Resources::default()
}

/// The resources of a module with everything in it.
pub fn whole(module: &Module, device: &Device) -> Resources {
    own(module, device) + module.instances.iter().map(|i| whole(&i.module, device)).sum()
}
