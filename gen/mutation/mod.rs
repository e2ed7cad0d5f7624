//! Mutation: small changes of the generated VHDL and of the reference model that co-simulation has to notice.
