"""The hydrodynamics of one vessel as plain values, and what follows from them directly."""
