"""What the contacts of a run carried: how hard, how fast and how often again, by contact."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from seacrane import _core
from seacrane.plotting.table import Rows, Table
from seacrane.result.result import Result


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
class ContactLoads(Rows[ContactLoad]):
    """Every contact of a run, in the order of its scene; prints as a table."""

    def _shown(self) -> Table:
        return Table(
            axes=[self.names("contact", head="contact")],
            columns=[
                self.column("body", printed=False), self.column("on"),
                self.column("first", unit="s", head="first at"),
                self.column("speed", unit="m/s", head="fastest"),
                self.column("peak", unit="N", head="largest press", form=".1f"),
                self.column("point", head="of"), self.column("peak_at", unit="s", head="at"),
                self.column("rehits", head="re-hits"),
            ],
            title="Contacts, over the whole run" if self.rows else "no contacts",
        )  # fmt: skip


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
