"""Extremes on their papers: crossings over levels, and maxima over Gumbel's reduced variable."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.described import described
from seacrane.plotting.panel import Line, Panel, Sheet, draw
from seacrane.sea.crossings import expected_crossings
from seacrane.statistics.record_extremes import RecordExtremes
from seacrane.statistics.seeds import SeedExtremes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
LEVELS = 200  # of a curve
LOWEST = 0.03  # crossings in the exposure time that are drawn


def plot_extremes(found: RecordExtremes | SeedExtremes) -> Figure:
    """Draw what `extremes` returned.

    Parameters
    ----------
    found : RecordExtremes or SeedExtremes
        Of one record: up-crossings in the exposure time over the level, counted and fitted; the most probable
        maximum is where one crossing is left. Of several seeds: their maxima on Gumbel paper, where Gumbel's
        distribution is a straight line.

    Raises
    ------
    SceneError
        For anything else.
    """
    return draw(extremes_sheet(found))


def extremes_sheet(found: RecordExtremes | SeedExtremes) -> Sheet:
    """The panel of `plot_extremes` with its numbers."""
    if isinstance(found, RecordExtremes):
        return _crossing_paper(found)
    if isinstance(found, SeedExtremes):
        return _gumbel_paper(found)
    raise SceneError(f"found is {described(found)}; give what extremes() returns")


def _crossing_paper(found: RecordExtremes) -> Sheet:
    top = max(found.largest, found.gaussian.p90.value, found.maximum.p90.value)
    levels = np.linspace(found.mean, top, LEVELS)
    counted = found.crests.size * found.exceedance(levels) * found.exposure / found.duration
    clumped = _gaussian(found, levels, found.spectrum.bandwidth)
    lines = [
        Line(label="crests counted", values=_shown(counted)),
        Line(label="Rayleigh", values=_shown(_gaussian(found, levels, None)), colour=1, style="--"),
        Line(label="clumped, Vanmarcke", values=_shown(clumped), colour=2, style="--"),
    ]
    if found.tail is not None:
        above = np.where(levels >= found.tail.threshold, levels, np.nan)
        fitted = _shown(found.tail.crossings(above, found.exposure))
        lines.append(Line(label="peaks over threshold", values=fitted, colour=3))
    return Sheet(
        title=f"{found.name}: crossings in {found.exposure:g} s",
        caption="Up-crossings of levels above the mean. One is left at the most probable maximum.",
        abscissa=levels, abscissa_name=found.name, abscissa_unit=found.unit, logarithmic=True,
        panels=(Panel(quantity="crossings", unit="-", lines=tuple(lines)),),
        marks={"most probable maximum": np.array([found.maximum.mpm.value])},
    )  # fmt: skip


def _gaussian(found: RecordExtremes, levels: Array, bandwidth: float | None) -> Array:
    cycles = found.crossing_rate * found.exposure
    reduced = (levels - found.mean) / found.std
    return np.array([expected_crossings(one, cycles=cycles, bandwidth=bandwidth) for one in reduced.tolist()])


def _shown(crossings: Array) -> Array:
    """Without what is too rare to draw."""
    return np.where(crossings >= LOWEST, crossings, np.nan)


def _gumbel_paper(found: SeedExtremes) -> Sheet:
    count = found.maxima.size
    reduced = -np.log(-np.log((np.arange(count) + 0.5) / count))
    fitted = (found.maxima - found.location) / found.scale
    return Sheet(
        title=f"{found.name}: maxima of {count} seeds of {found.duration:g} s on Gumbel paper",
        caption="Gumbel's distribution is the straight line. F is the share of seeds with a smaller maximum.",
        abscissa=found.maxima, abscissa_name=found.name, abscissa_unit=found.unit,
        panels=(
            Panel(
                quantity="-ln(-ln F)", unit="-",
                lines=(
                    Line(label="seeds", values=reduced, style="o"),
                    Line(label="Gumbel, maximum likelihood", values=fitted, colour=1),
                ),
            ),
        ),
        marks={"most probable maximum of a record": np.array([found.location])},
    )  # fmt: skip
