"""Functions and objects that a caller gives for what a case declares, by name."""
