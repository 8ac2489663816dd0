//! `edskit config` beyond its fixtures: both units together, what people type, tables of the PC tool.

mod notation;
mod tables;
mod units;
