"""What the contacts of a run carried: how hard, how fast and how often again, by contact."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.plotting.answer import Answer, Table
from seacrane.result.result import Result

HEAD = ("contact", "on", "first at [s]", "fastest [m/s]", "largest press [kN]", "of", "at [s]", "re-hits")


@dataclass(frozen=True, kw_only=True)
class ContactLoad:
    """What one contact carried.

    Attributes
    ----------
    name, body, on : Of the contact, of whose points it is, and whose surface.
    first : float
        s, when a point first touched; the start where one did there; NaN where none ever did.
    speed : float
        The fastest at which a point came, m/s; 0 where all touched from the start.
    peak, peak_at : float
        Largest force of a point away from the surface, N, and by which output, s; 0 and NaN without any.
    point : str
        Which point that was, such as "feet.1".
    rehits : int
        How often points came again, all together.
    """

    name: str
    body: str
    on: str
    first: float
    speed: float
    peak: float
    peak_at: float
    point: str
    rehits: int


@dataclass(frozen=True, repr=False)
class ContactLoads(Sequence[ContactLoad], Answer):
    """Every contact of a run, in the order of its scene; prints as a table."""

    loads: tuple[ContactLoad, ...]

    def __getitem__(self, key: Any) -> Any:
        """By number, or by name; KeyError names those that are there."""
        if not isinstance(key, str):
            return self.loads[key]
        for one in self.loads:
            if one.name == key:
                return one
        raise KeyError(
            f"there is no contact {key!r}; the run has {', '.join(o.name for o in self) or 'none'}"
        )

    def __len__(self) -> int:
        return len(self.loads)

    def __iter__(self) -> Iterator[ContactLoad]:
        return iter(self.loads)

    def __repr__(self) -> str:
        return f"<ContactLoads of {len(self)} contacts>"

    def _shown(self) -> Table:
        return Table(
            head=HEAD, rows=self.cells(), right=(2, 3, 4, 6, 7), title="" if self.loads else "no contacts",
            caption="Contacts, over the whole run",
        )  # fmt: skip

    def cells(self) -> list[list[str]]:
        """Texts of the table, row by row."""
        return [
            [one.name, one.on, _shown(one.first), _shown(one.speed), f"{one.peak / 1e3:.1f}", one.point,
             _shown(one.peak_at), str(one.rehits)]
            for one in self.loads
        ]  # fmt: skip


NO_CONTACTS = ContactLoads(())


def contact_loads(result: Result) -> ContactLoads:
    """The contacts of a run by how they were hit; none where it holds no scene, or did not record them."""
    if result.scene is None or "contact_press" not in result:
        return NO_CONTACTS
    names = [name for name, load in result.scene.loads.items() if isinstance(load, _core.Contact)]
    return ContactLoads(tuple(_load(result, name) for name in names))


def _load(result: Result, name: str) -> ContactLoad:
    assert result.scene is not None
    contact = result.scene.loads[name]
    points = [f"{name}.{i + 1}" for i in range(len(contact.points))]
    came = [event for event in result.events if event.kind == "contact" and event.name in points]
    press = np.stack([result.reached("contact_press", contact_point=one)[1] for one in points])
    press = np.where(np.isfinite(press), press, 0.0)
    point, at = np.unravel_index(int(np.argmax(press)), press.shape)
    peak = max(float(press[point, at]), 0.0)
    begun = [float(result.time[0])] if np.any(press[:, 0] > 0.0) else []
    times = Counter(event.name for event in came)
    return ContactLoad(
        name=name, body=contact.body, on=contact.on,
        first=min([*begun, *(event.time for event in came)], default=np.nan),
        speed=max((event.speed for event in came), default=0.0),
        peak=peak, peak_at=float(result.time[at]) if peak > 0.0 else np.nan,
        point=points[int(point)] if peak > 0.0 else "",
        rehits=sum(count - 1 for count in times.values()),
    )  # fmt: skip


def _shown(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.4g}"
