//! What is around a design: the stream wrapper, the host side, the example behind a UART, boards, projects for tools.

pub(crate) mod board;
pub(crate) mod drop_in;
pub(crate) mod example;
pub(crate) mod host;
mod ise;
pub(crate) mod packaged;
pub(crate) mod projects;
pub mod registers;
pub mod stream;
pub(crate) mod verilog;
mod vivado;

pub use verilog::verilog_files;
