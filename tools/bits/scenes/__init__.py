"""Every file here puts its cases into the list."""

from bits.scenes import afloat, contact, cranes, drawn, ensembles, lines, loads, stages, water

__all__ = ["afloat", "contact", "cranes", "drawn", "ensembles", "lines", "loads", "stages", "water"]
