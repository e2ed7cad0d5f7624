//! What is around a design: the stream wrapper, the host side, the example behind a UART, boards, projects for tools.

pub(crate) mod board;
pub(super) mod drop_in;
pub(crate) mod example;
pub(crate) mod host;
pub(super) mod ise;
pub mod registers;
pub mod stream;
pub(crate) mod verilog;
pub(super) mod vivado;

pub use verilog::verilog_files;
