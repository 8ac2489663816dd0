//! edskit-lint
