"""The error of a run: what it is measured in, how it is estimated, and methods chosen by it."""
