//! edskit-model
