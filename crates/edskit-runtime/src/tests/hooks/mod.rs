//! Devices whose manuals want it otherwise, each with all that it needs, as their users would write them.

mod drive;
mod sensor;
mod services;
