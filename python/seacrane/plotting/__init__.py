"""Figures as data: what every picture of the package is drawn with."""
