"""Fluid memory: state-space models, their fits and their passivity."""
