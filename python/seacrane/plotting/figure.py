"""Where figures are made: without pyplot, and shown by notebooks all the same."""

from __future__ import annotations

from functools import partial
from io import BytesIO
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def new_figure(**given: Any) -> Figure:
    """A figure of no window and no global state, which a notebook shows as the last expression of a cell.

    Notebooks know how to show figures once pyplot has been loaded; this one tells it by itself.
    """
    from matplotlib.figure import Figure

    figure = Figure(**given)
    figure._repr_png_ = partial(_png, figure)  # type: ignore[attr-defined]
    return figure


def _png(figure: Figure) -> bytes:
    target = BytesIO()
    figure.savefig(target, format="png", bbox_inches="tight")
    return target.getvalue()
