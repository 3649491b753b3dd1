"""``seacrane doctor``: what is installed, what is fast, what is missing."""

from __future__ import annotations

import argparse
import os
import platform
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib.machinery import EXTENSION_SUFFIXES
from importlib.metadata import PackageNotFoundError, distribution, requires, version
from pathlib import Path
from typing import Any

from seacrane.cli.output import to_json
from seacrane.plotting.table import table_of
from seacrane.version import __version__

Facts = list[tuple[str, str]]
NOT_FOR_USERS = ("dev", "bench", "fuzz", "docs", "wheel")  # extras that only work on the package itself needs
NUMBER = re.compile(r"\d+")
PACKAGE = Path(__file__).parents[1]
COMPILERS = (rb"GCC: \([^)]*\) [\d.]+", rb"clang version [\d.]+", rb"Apple clang version [\d.]+")
# What is inside a core that was built to find errors, and is slow for it.
SLOW = {
    b"__asan_init": "AddressSanitizer",
    b"__tsan_init": "ThreadSanitizer",
    b"__ubsan_handle": "UBSan",
    b"__gcov_": "coverage",
}
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
SPAN, REPEATS = 20.0, 3  # s of case 2, and how often it runs


def doctor(arguments: argparse.Namespace) -> int:
    """Print the facts; 1 where something that is needed is missing, too old, or does not work."""
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
    """Threads, linear algebra, the quickest of some runs of case 2, and how many seeds step side by side."""
    from seacrane import cases
    from seacrane.answers.checks import speed
    from seacrane.run.lanes import INSTRUCTIONS, lanes_of
    from seacrane.simulation import simulate

    scene = cases.case2()
    quickest = min(
        (simulate(scene, SPAN) for _ in range(REPEATS)), key=lambda run: float(run.stats["wall_s"])
    )
    wall, fast = float(quickest.stats["wall_s"]), speed(quickest) or float("inf")
    return [
        ("processors", str(processors())),
        *((name, os.environ[name]) for name in THREADS if name in os.environ),
        ("linear algebra of NumPy", blas()),
        (f"case 2, {SPAN:g} s", f"{1e3 * wall:.3g} ms in the loop, {fast:.0f} times real time"),
        ("lanes of ensembles", f"{lanes_of(None)} by default; {', '.join(map(_lanes_told, INSTRUCTIONS))}"),
    ]


def processors() -> int:
    """Processors that this process may use."""
    allowed = getattr(os, "sched_getaffinity", None)
    return len(allowed(0)) if allowed else os.cpu_count() or 1


def blas() -> str:
    """NumPy's linear algebra."""
    import numpy as np

    config: Any = np.show_config(mode="dicts")
    found = config.get("Build Dependencies", {}).get("blas", {})
    return f"{found.get('name', 'unknown')} {found.get('version', '')}".strip()


def _lanes_told(lanes: int) -> str:
    from seacrane import _core
    from seacrane.run.lanes import INSTRUCTIONS, module_of

    name = INSTRUCTIONS[lanes]
    if module_of(lanes) is not None:
        return f"{lanes} ({name})"
    why = "this build has none" if _core.has_instructions(name) else "this processor has none"
    return f"not {lanes} ({name}): {why}"


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
    """One package that is asked for, by an extra or always, of a least version; the version that is found."""

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
            name, least, of = parts[1], parts[2] or "", extra[1] if extra else ""
            found.append(Package(name=name, extra=of, least=least, found=installed(name)))
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


def core_file() -> Path | None:
    """The compiled core of this interpreter; None where there is none."""
    names = (PACKAGE / f"_core{suffix}" for suffix in EXTENSION_SUFFIXES)
    return next((name for name in names if name.is_file()), None)


def build_facts() -> dict[str, str]:
    """What is known of how this package was built, and of its version, by what it is about."""
    facts = {
        "seacrane": __version__,
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "platform": f"{platform.system()} {platform.machine()}",
        "core": "missing: the package was not built for this Python",
    }
    file = core_file()
    if file is not None:
        facts["core"] = f"{file.name}, {file.stat().st_size / 1e6:.1f} MB"
        facts |= _inside(file.read_bytes())
    facts |= _wheel()
    return {**facts, "installed in": str(PACKAGE)}


def _inside(core: bytes) -> dict[str, str]:
    found: dict[str, str] = {}
    for pattern in COMPILERS:
        match = re.search(pattern, core)
        if match:
            found["compiler"] = match[0].decode("ascii", "replace")
            break
    slow = [name for mark, name in SLOW.items() if mark in core]
    return found | ({"instrumented": f"{', '.join(slow)}: slow"} if slow else {})


def _wheel() -> dict[str, str]:
    try:
        text = distribution("seacrane").read_text("WHEEL") or ""
    except PackageNotFoundError:
        return {}
    tags = re.findall(r"^Tag: (.+)$", text, re.MULTILINE)
    return {"wheel": ", ".join(tags)} if tags else {}
