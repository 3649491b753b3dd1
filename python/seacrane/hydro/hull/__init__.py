"""Hull shapes and their hydrodynamics by strip theory or by Capytaine."""
