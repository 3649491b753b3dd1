"""Warnings by their classes, which `data/warnings.md` lists: code, name, when each comes and what to do.

The class of a section silences it, or makes it an error, as a whole:
``warnings.simplefilter("error", seacrane.warnings.RunWarning)``.
"""

import re as _re
from importlib.resources import files as _files

_PAGE = (_files("seacrane") / "data" / "warnings.md").read_text(encoding="utf-8")
_ENTRY = _re.compile(r"^(## |- \*\*)(SW\d+) (\w+)(?:\n\n|\*\*: )(.+?)(?=\n- |\n\n|\n\Z)", _re.M | _re.S)


class SeacraneWarning(UserWarning):
    """Base of every warning that seacrane gives on purpose; `code` is its own in `data/warnings.md`."""

    code = "SW000"


def _made() -> dict[str, type[SeacraneWarning]]:
    """Classes by name: an entry of the page is a kind of the section above it."""
    made: dict[str, type[SeacraneWarning]] = {}
    section = SeacraneWarning
    for mark, code, name, text in _ENTRY.findall(_PAGE):
        own = {"code": code, "__doc__": text.replace("\n  ", "\n"), "__module__": __name__}
        made[name] = type(name, (SeacraneWarning if mark == "## " else section,), own)
        section = made[name] if mark == "## " else section
    return made


globals().update(_made())
