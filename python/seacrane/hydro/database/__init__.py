"""Hydrodynamic coefficients of a hull over frequency and heading."""
