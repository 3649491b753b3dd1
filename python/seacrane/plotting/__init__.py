"""Figures and tables as data: what every picture and page of the package is made with."""
