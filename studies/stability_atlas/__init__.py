"""The stability atlas: every axis of use driven far beyond it, with every formulation and method."""

from __future__ import annotations

from stability_atlas.study import Atlas, stability_atlas

__all__ = ["Atlas", "stability_atlas"]
