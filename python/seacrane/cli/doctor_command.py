"""``seacrane doctor``: what is installed, what is fast, what is missing."""

from __future__ import annotations

import argparse

from seacrane.cli.json_text import to_json
from seacrane.plotting.text import text_table

Facts = list[tuple[str, str]]


def run(arguments: argparse.Namespace) -> int:
    """Print the facts; 1 where something that is needed is missing, too old, or does not work."""
    from seacrane.installation.build import build_facts, core_file
    from seacrane.installation.packages import asked_packages

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
    from seacrane.installation.pace import SPAN, blas, lane_facts, pace_of_case2, thread_facts

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
            table = text_table(("", ""), facts).splitlines()[1:]
            print("\n".join([name, *(f"  {line}" for line in table), ""]))
    print("missing: " + "; ".join(missing) if missing else "all that is needed is there")
