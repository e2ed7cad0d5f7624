//! Pictures of a scheduled unit: clocks as columns, formats on the edges, the critical path marked.
