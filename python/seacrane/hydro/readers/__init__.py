"""Readers of hydrodynamic files."""
