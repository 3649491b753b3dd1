"""A run: settings, stepping, outputs to memory or to a file."""
