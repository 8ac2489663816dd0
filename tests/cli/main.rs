//! The command line as its users see it: what it prints, where, and how it ends.

mod bad_input;
mod explain;
mod fix;
mod fmt;
mod gateway;
mod generate;
mod help;
mod lint;
mod neighbours;
mod own_files;
mod pages;
mod profiles;
mod run;
mod settings;
mod show;
