"""Comparisons of the engine with what owes nothing to it; a module for each subject."""
