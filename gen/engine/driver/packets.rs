//! Packets of pairs and poses, which an engine takes between queries.

use crate::format::EngineFormat;
use efsat_unit::host::driver::{Driver, DriverError, Transfer, UnitAnswer};
use efsat_unit::pair::{Pair, Pose};
use efsat_unit::params::{ParamError, Params};
use efsat_unit::words::StreamWidth;

/// Packs pairs and poses for the unit in an engine, and reads its answers, in 64-bit words. Tags have 16 bits.
#[derive(Clone, Debug)]
pub struct UnitPackets(Driver);

fn words(transfers: Vec<Transfer>) -> Vec<u64> {
    transfers.into_iter().map(|transfer| transfer.data.low() as u64).collect()
}

impl UnitPackets {
    /// The packets of an engine around a unit.
    ///
    /// # Errors
    /// A parameter outside its range.
    pub fn new(unit: &Params) -> Result<Self, ParamError> {
        Ok(Self(Driver::new(&EngineFormat::packets(unit), StreamWidth::Bits64)?))
    }

    /// The packet that loads a pose for the packets of pairs behind it, up to the next query.
    ///
    /// # Errors
    /// A number that its word does not hold.
    pub fn pose(&self, pose: &Pose) -> Result<Vec<u64>, DriverError> {
        self.0.pack_pose(pose).map(words)
    }

    /// The packet of some pairs with their tags; no words if there are no pairs.
    ///
    /// # Errors
    /// A number that its word does not hold.
    pub fn pairs<'a>(&self, pairs: impl IntoIterator<Item = (u64, &'a Pair)>) -> Result<Vec<u64>, DriverError> {
        self.0.pack_pairs(pairs).map(words)
    }

    /// What a word of the answer to such a packet says; none if no engine sends it.
    pub fn answer(&self, word: u64) -> Option<UnitAnswer> {
        self.0.unpack(u128::from(word).into())
    }
}
