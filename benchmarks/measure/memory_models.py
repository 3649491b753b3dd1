"""The shipped database: its self-check, the fits of its memory, and the errors of other fits."""

from __future__ import annotations

from typing import Any

from seacrane.hydro import fit_memory, shipped_database

from .memory_trade import memory_trade
from .section import Section, significant


def self_check() -> Section:
    """Every row of the self-check."""
    database = shipped_database()
    rows = [
        [
            f"`{row.check}`",
            significant(row.value),
            None if row.limit is None else f"{row.limit:g}",
            row.verdict,
        ]
        for row in database.check()
        if not row.check.startswith("memory_r2_")  # those are in the fits
    ]
    return Section(
        title="Self-check of the shipped database",
        text="`database.check()` with the memory per pair; docs/hydrodynamics.md explains each value.",
        head=["check", "value", "limit", "verdict"],
        rows=rows,
    )


def fits() -> Section:
    """Order, agreement and poles of every fitted pair."""
    rows: list[list[Any]] = [
        [
            f"{row.output + 1}{row.input + 1}",
            row.cause,
            row.order,
            f"{row.r2_added_mass:.4f}",
            f"{row.r2_damping:.4f}",
            f"{row.slowest_decay:.2f}",
            f"{row.fastest_pole:.2f}",
        ]
        for row in fit_memory(database=shipped_database(), kind="per-pair").rows
    ]
    return Section(
        title="Fits of the shipped hull",
        text="`fit_memory` per pair at R2 = 0.99 over the trusted band.",
        head=["entry", "cause", "order", "R2 of A", "R2 of B", "slowest decay, 1/s", "largest pole, rad/s"],
        rows=rows,
    )


def trade() -> Section:
    """States and errors of every kind of fitted model."""
    rows: list[list[Any]] = [
        [
            row.kind,
            row.states,
            *(f"{error:.3f}" for error in (row.error_kernel, row.error_added_mass, row.error_damping)),
            f"{row.error_motion:.3f} ({row.worst_motion})",
            f"{row.margin:+.3f}",
            f"R2 {row.r2:g}" if row.limit is None else f"limit {row.limit:g}",
        ]
        for row in memory_trade(shipped_database(), kinds=("by-motion", "per-pair", "passive"))
    ]
    return Section(
        title="Memory models of the shipped hull",
        text="Worst errors within the trusted band, by kind and by what was asked.",
        head=[
            "kind",
            "states",
            "error of K",
            "error of A",
            "error of B",
            "error of motion",
            "margin",
            "asked",
        ],
        rows=rows,
    )
