"""Warnings of the readers: what a source does not say, and what was taken in its place."""

from __future__ import annotations


class AssumedDensityWarning(UserWarning):
    """The source holds no water density: 1025 kg/m3 scales every mass, stiffness and force."""


class AssumedInertiaWarning(UserWarning):
    """The source holds no mass matrix: displaced mass and usual radii of gyration decide the motions."""


class AssumedSymmetryWarning(UserWarning):
    """The source does not name its symmetry: loads from the other side, or none, follow from a guess."""


class PartialSetWarning(UserWarning):
    """Files of a set cover different periods, headings or speeds: only the common ones are read."""


class SeveralSpeedsWarning(UserWarning):
    """The source holds several forward speeds and none was chosen: motions of the others are not seen."""


class EncounterFrequencyWarning(UserWarning):
    """Matrices at forward speed are not known as one function of encounter frequency: motions are off."""


class HydrostaticsWarning(UserWarning):
    """The hydrostatics of a set contradict its matrices: mass, restoring or both are of another loading."""


class MissingMotionsWarning(UserWarning):
    """The source lacks some of the six motions: nothing of the water acts in them."""


class RoughDataWarning(UserWarning):
    """The matrices of the source jump from a frequency on: its trusted band ends below it."""
