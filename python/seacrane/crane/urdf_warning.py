"""What a URDF file says and seacrane does not take over."""

from __future__ import annotations

from seacrane.inputs.caller import warn_caller


class UrdfWarning(UserWarning):
    """A URDF file says something that is not taken over: friction of a joint, a mesh of another kind."""


def warn_of_urdf(text: str) -> None:
    """Warn whoever called seacrane."""
    warn_caller(text, UrdfWarning)
