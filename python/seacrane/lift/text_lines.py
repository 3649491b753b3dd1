"""On which line of a TOML text each of its keys stands, which the standard library does not say."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from typing import NamedTuple

Place = tuple[str | int, ...]

_TOKEN = re.compile(
    r'''(?P<skip>[ \t\r]+|\#[^\n]*)
      | (?P<line>\n)
      | (?P<text>"""(?:[^\\]|\\.)*?"""(?:"{1,2})? | \'\'\'.*?\'\'\'(?:'{1,2})?
               | "(?:[^"\\\n]|\\.)*" | '[^'\n]*')
      | (?P<mark>[][{}=,.])
      | (?P<bare>[^][{}=,.\s\#"']+)''',
    re.VERBOSE | re.DOTALL,
)


class _Token(NamedTuple):
    kind: str
    text: str
    line: int


_END = _Token("end", "", 0)


def lines_of(text: str) -> dict[Place, int]:
    """Lines of all keys and tables.

    Parameters
    ----------
    text : A TOML document that `tomllib` has read without an error.

    Returns
    -------
    dict
        Line, counted from 1, by the path of keys and places in lists, such as ("sea", "hs_m") or
        ("wire", 1, "joint"). Of what stands in several places the first.
    """
    return _Scanner(text).lines


class _Scanner:
    """Walks through a document that is known to be sound, one token after the other."""

    def __init__(self, text: str) -> None:
        self.tokens = _tokens(text)
        self.now = next(self.tokens, _END)
        self.lines: dict[Place, int] = {}
        self.counts: dict[Place, int] = {}
        table: Place = ()
        while self.now is not _END:
            if self.now.kind == "line":
                self._pass()
            elif self._is("["):
                table = self._header()
            else:
                self._pair(table)

    def _pass(self) -> _Token:
        """The token at hand; the next one takes its place."""
        passed, self.now = self.now, next(self.tokens, _END)
        return passed

    def _is(self, marks: str) -> bool:
        return self.now.kind == "mark" and self.now.text in marks

    def _header(self) -> Place:
        """The header of a table, or of one more in a list of tables."""
        line = self._pass().line
        several = self._is("[")
        if several:
            self._pass()
        path: Place = ()
        *around, last = self._key("]")
        for part in around:
            path = self._latest((*path, part))
        path = (*path, last)
        if several:
            self._pass()
            self.lines.setdefault(path, line)
            self.counts[path] = self.counts.get(path, 0) + 1
        path = self._latest(path)
        self.lines.setdefault(path, line)
        return path

    def _latest(self, path: Place) -> Place:
        """The path itself, or its last table where it is a list of tables."""
        return (*path, self.counts[path] - 1) if path in self.counts else path

    def _key(self, end: str) -> list[str]:
        """Parts of a dotted key up to the mark that ends it, which is passed."""
        parts = []
        while not self._is(end):
            token = self._pass()
            if token.kind != "mark":
                parts.append(_unquoted(token))
        self._pass()
        return parts

    def _pair(self, table: Place) -> None:
        line, path = self.now.line, table
        for part in self._key("="):
            path = (*path, part)
            self.lines.setdefault(path, line)
        self._value(path)

    def _value(self, path: Place) -> None:
        if self._is("[{"):
            self._several(path)
            return
        while self.now is not _END and self.now.kind != "line" and not self._is(",]}"):
            self._pass()  # one value, perhaps of several tokens: 1.5

    def _several(self, path: Place) -> None:
        """A list, or a table on its line."""
        opened, index = self._pass(), 0
        if opened.text == "{":
            self.lines.setdefault(path, opened.line)
        while not self._is("]}"):
            if self.now.kind == "line" or self._is(","):
                index += self._pass().text == ","
            elif opened.text == "{":
                self._pair(path)
            else:
                self._value((*path, index))
        self._pass()


def _tokens(text: str) -> Iterator[_Token]:
    line = 1
    for match in _TOKEN.finditer(text):
        kind = str(match.lastgroup)
        if kind != "skip":
            yield _Token(kind, match[0], line)
        line += match[0].count("\n")


def _unquoted(token: _Token) -> str:
    """A part of a key as it is meant; quoted keys are rare, and their escapes rarer."""
    if token.kind == "bare" or token.text[0] == "'":
        return token.text.strip("'")
    return next(iter(tomllib.loads(f"{token.text} = 0")))
