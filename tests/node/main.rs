//! Nodes in virtual time: random frames, bad buses, and every file of the corpus.

mod random;
