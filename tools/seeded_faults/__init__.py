"""Faults of a few characters, put into the sources one at a time: which test finds each?"""
