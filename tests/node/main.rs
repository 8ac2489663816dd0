//! Nodes in virtual time: random frames, bad buses, and every file of the corpus.

mod bad_bus;
mod corpus;
mod line;
mod random;
