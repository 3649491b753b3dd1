"""Does a built site ask for anything from a network: ``python docs/site/offline.py out/site``.

Looks at what a browser loads by itself: scripts, style sheets, icons, pictures, frames and media of every
page, and what style sheets load. Links that a reader may follow are free to lead anywhere.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

OUTSIDE = re.compile(r"\s*(https?:|ftp:|wss?:)?//", re.IGNORECASE)
LOADED = {
    "script": ("src",),
    "img": ("src", "srcset"),
    "iframe": ("src", "srcdoc"),
    "source": ("src", "srcset"),
    "video": ("src", "poster"),
    "audio": ("src",),
    "track": ("src",),
    "embed": ("src",),
    "object": ("data",),
    "image": ("href", "xlink:href"),
    "use": ("href", "xlink:href"),
    "input": ("src",),
}
FREE_LINKS = {"canonical", "next", "prev", "author", "license", "search", "index", "help", "copyright"}
STYLE = re.compile(r"""url\(\s*['"]?([^'")]+)|@import\s+['"]([^'"]+)""", re.IGNORECASE)


class Page(HTMLParser):
    """What a page loads."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.loaded: list[str] = []
        self._style = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Notes attributes that name what is loaded; looks into pages within the page."""
        given = {name: value or "" for name, value in attrs}
        self._style = tag == "style"
        self.loaded += list(in_style(given.get("style", "")))
        if tag == "link" and not set(given.get("rel", "").lower().split()) & FREE_LINKS:
            self.loaded.append(given.get("href", ""))
        for name in LOADED.get(tag, ()):
            value = given.get(name, "")
            if name == "srcdoc":
                self.loaded += Page(value).loaded
            elif name == "srcset":
                self.loaded += [part.split()[0] for part in value.split(",") if part.split()]
            else:
                self.loaded.append(value)

    def handle_endtag(self, tag: str) -> None:
        """A style sheet inside the page ends."""
        self._style = False

    def handle_data(self, data: str) -> None:
        """Style sheets inside the page."""
        if self._style:
            self.loaded += list(in_style(data))


def in_style(text: str) -> Iterator[str]:
    """Addresses that a style sheet loads."""
    return (first or second for first, second in STYLE.findall(text))


def outside(site: Path) -> list[str]:
    """Files of a site and the addresses on other machines that they load."""
    found = []
    for path in sorted(site.rglob("*")):
        if path.suffix not in (".html", ".css"):
            continue
        text = path.read_text(encoding="utf-8")
        loaded = Page(text).loaded if path.suffix == ".html" else in_style(text)
        found += [f"{path.relative_to(site)}: {one}" for one in loaded if OUTSIDE.match(one)]
    return found


def main() -> int:
    """Name what is outside; nothing may be."""
    site = Path(sys.argv[1])
    if not (site / "index.html").is_file():
        print(f"{site} holds no site: build it with make docs", file=sys.stderr)
        return 1
    found = outside(site)
    for one in found:
        print(one, file=sys.stderr)
    return int(bool(found))


if __name__ == "__main__":
    raise SystemExit(main())
