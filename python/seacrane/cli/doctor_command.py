"""``seacrane doctor``: what is installed, what is fast, what is missing."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, requires, version

from seacrane.cli.as_json import to_json
from seacrane.plotting.table import table_of

Facts = list[tuple[str, str]]
NOT_FOR_USERS = ("dev", "bench", "fuzz", "docs", "wheel")  # extras that only work on the package itself needs
NUMBER = re.compile(r"\d+")


def run(arguments: argparse.Namespace) -> int:
    """Print the facts; 1 where something that is needed is missing, too old, or does not work."""
    from seacrane.cli.built import build_facts, core_file

    asked = asked_packages()
    needed = [package for package in asked if not package.extra]
    optional = [package for package in asked if package.extra]
    sections: dict[str, Facts] = {
        "package": list(build_facts().items()),
        "needed": [(package.name, package.words) for package in needed],
        "optional": [(f"{package.name} [{package.extra}]", package.words) for package in optional],
    }
    if not asked:
        sections["needed"] = [("metadata", "none: a source tree that is not installed; pip install .")]
    missing = [f"{package.name}: {package.words}" for package in needed if not package.good]
    if core_file() is None:
        missing.append("the compiled core: pip install . in the source tree, or a wheel for this Python")
    if not missing:
        sections["speed"] = _speed()
    _show(sections, missing, as_json=arguments.json)
    return 1 if missing else 0


def _speed() -> Facts:
    from seacrane.cli.pace import SPAN, blas, lane_facts, pace_of_case2, thread_facts

    wall, fast = pace_of_case2()
    return [
        *thread_facts().items(),
        ("linear algebra of NumPy", blas()),
        (f"case 2, {SPAN:g} s", f"{1e3 * wall:.3g} ms in the loop, {fast:.0f} times real time"),
        *lane_facts().items(),
    ]


def _show(sections: dict[str, Facts], missing: list[str], *, as_json: bool) -> None:
    if as_json:
        print(to_json({**{name: dict(facts) for name, facts in sections.items()}, "missing": missing}))
        return
    for name, facts in sections.items():
        if facts:
            print(f"{table_of(('', ''), facts, title=name)}\n")
    print("missing: " + "; ".join(missing) if missing else "all that is needed is there")


@dataclass(frozen=True, kw_only=True)
class Package:
    """One package that is asked for.

    Attributes
    ----------
    extra : The optional part of seacrane that needs it; empty for what is always needed.
    least : Least version, or empty.
    found : Version that is installed, or empty.
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
    """The numbers of a version's release: 2.10.1rc1 is (2, 10, 1)."""
    release = re.match(r"[\d.]*", text)
    return tuple(int(number) for number in NUMBER.findall(release[0] if release else ""))
