"""The packages that seacrane needs or can use: which are there, which are missing or too old."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, requires, version

NOT_FOR_USERS = ("dev", "bench", "fuzz", "docs", "wheel")  # extras that only work on the package itself needs
NUMBER = re.compile(r"\d+")


@dataclass(frozen=True, kw_only=True)
class Package:
    """One package that is asked for.

    Attributes
    ----------
    name : str
    extra : str
        The optional part of seacrane that needs it; empty for what is always needed.
    least : str
        Least version, or empty.
    found : str
        Version that is installed, or empty.
    """

    name: str
    extra: str
    least: str
    found: str

    @property
    def good(self) -> bool:
        """Whether it is installed and not too old."""
        return bool(self.found) and _numbers(self.found) >= _numbers(self.least)

    @property
    def words(self) -> str:
        """What is there, and what to do where it is not enough."""
        if self.good:
            return self.found
        what = f"seacrane[{self.extra}]" if self.extra else f"{self.name}>={self.least}".removesuffix(">=")
        state = f"{self.found}, too old: {self.least} or newer is needed" if self.found else "not installed"
        return f"{state}; pip install '{what}'"


def asked_packages() -> list[Package]:
    """All packages of the installed metadata, those for users; none where there is no metadata."""
    try:
        lines = requires("seacrane") or []
    except PackageNotFoundError:
        return []
    return chosen_packages(lines, _installed)


def chosen_packages(lines: Iterable[str], installed: Callable[[str], str]) -> list[Package]:
    """The packages of requirements as metadata writes them; those for other Pythons are left out."""
    found = []
    for line in lines:
        wanted, _, marker = line.partition(";")
        extra = re.search(r"extra == [\"'](.+?)[\"']", marker)
        if "python_version" in marker or (extra and extra[1] in NOT_FOR_USERS):
            continue
        parts = re.match(r"\s*([\w.-]+)[^>=]*(?:[>=]=\s*([\w.]+))?", wanted)
        if parts:
            name = parts[1]
            found.append(
                Package(
                    name=name, extra=extra[1] if extra else "", least=parts[2] or "", found=installed(name)
                )
            )
    return found


def _installed(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def _numbers(text: str) -> tuple[int, ...]:
    """Of a version's release: 2.10.1rc1 is (2, 10, 1)."""
    release = re.match(r"[\d.]*", text)
    return tuple(int(number) for number in NUMBER.findall(release[0] if release else ""))
