"""Where the numbers come from: settings, what was recorded, versions."""

from __future__ import annotations

import hashlib
import json
import platform
from html import escape
from importlib.metadata import PackageNotFoundError, version

import numpy as np

from seacrane.plotting.table import facts, table_of
from seacrane.result import CHANNELS, Result

PACKAGES = ("seacrane", "numpy", "scipy", "matplotlib", "netCDF4", "xarray")


def versions() -> dict[str, str]:
    """Versions of Python and of the packages a result depends on."""
    found = {"python": platform.python_version(), "platform": f"{platform.system()} {platform.machine()}"}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed as a package"
    return found


def digest(result: Result) -> str:
    """SHA-256 of the recorded numbers: equal digests are equal results, bit for bit."""
    summed = hashlib.sha256(np.ascontiguousarray(result.time).tobytes())
    for name in sorted(result.channels):
        summed.update(name.encode())
        summed.update(np.ascontiguousarray(result[name]).tobytes())
    return summed.hexdigest()


def settings_block(result: Result) -> str:
    """All settings as the result states them."""
    return f"<pre>{escape(json.dumps(dict(result.settings), indent=1, sort_keys=True))}</pre>"


def versions_block() -> str:
    """What made the page."""
    return table_of(("package", "version"), versions().items()).html()


def _recorded(result: Result) -> str:
    rows = [
        (name, ", ".join(result.dims[name]), CHANNELS[name].unit, CHANNELS[name].long_name)
        for name in result.channels
    ]
    return table_of(("channel", "dimensions", "unit", ""), rows).html()


def provenance(result: Result) -> str:
    """Settings, what was recorded, and versions."""
    made = [
        ("seacrane that ran it", result.stats["seacrane_version"]),
        ("SHA-256 of the recorded numbers", digest(result)),
    ]
    parts = {
        "Settings": settings_block(result),
        "Recorded channels": _recorded(result),
        "Versions that made this page": versions_block(),
    }
    return "\n".join([facts(made).html(), *(f"<h3>{name}</h3>{html}" for name, html in parts.items())])
