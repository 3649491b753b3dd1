"""The TOML text of a lift file, parsed in bounded memory; what is no such text is refused by name."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, NoReturn

from seacrane.errors import FileFormatError
from seacrane.inputs.looks_like import looks_like
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import read_whole

FORMAT = "seacrane lift"
VERSION = 2
LARGEST_FILE = 512 * 2**10  # bytes; TOML's smallest tables take some 150 times their size when it is parsed
MOST_PARTS = 8  # of a dotted key: parsing one takes time by the square of them
_PART = r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')"""
_LONG_KEY = re.compile(rf"(?<![\w-]){_PART}(?:[ \t]*\.[ \t]*{_PART}){{{MOST_PARTS}}}")
_AT_LINE = re.compile(r"^(.*) \(at line (\d+), column (\d+)\)$", re.DOTALL)
_AT_END = " (at end of document)"
_BEGIN = re.compile(rb"(?:\xef\xbb\xbf)?\s*(?:#|\[\[?\s*[\w\"']|[\w\"'-][^\n=]{0,200}=)")
_NO_LIFT = f'no lift file, which is TOML with format = "{FORMAT}" at its top (docs/lift-files.md)'
_TOO_DEEP = "is nested too deeply to be a lift file"


@dataclass(frozen=True)
class Document:
    """Tables of a file as they were parsed, and where their keys stand."""

    source: str  # name of the file, as messages give it
    data: Mapping[str, Any]
    lines: Mapping[Place, int] = field(default_factory=dict)  # none where the tables come from no file

    def place(self, path: Place) -> str:
        """The file and the line of a key or table, or of the nearest thing around it.

        The last part may be a dotted name, of which the file has the parts.
        """
        *outer, last = path
        parts = (*outer, *(last.split(".") if isinstance(last, str) else (last,)))
        around = [path, *(parts[:end] for end in range(len(parts), 0, -1))]
        line = next((self.lines[one] for one in around if one in self.lines), None)
        return self.source if line is None else f"{self.source} line {line}"

    def require_version(self) -> None:
        """Raise a FileFormatError for another version than the one that is read."""
        version = self.data.get("version")
        if version != VERSION or isinstance(version, bool):
            told = "has no version" if version is None else f"version is {shown(version)}"
            self.fail(("version",), f"{told}; this seacrane reads version = {VERSION}")

    def fail(self, path: Place, text: str) -> NoReturn:
        """Raise a FileFormatError about a place."""
        error = FileFormatError(f"{self.place(path)}: {text}")
        error.placed = True
        raise error


def read_document(path: Path) -> Document:
    """The document of a lift file.

    Raises FileFormatError, with the line, for what is no TOML, or no lift; OSError where it cannot be read.
    """
    name = path.name
    if not path.exists():
        raise FileNotFoundError(f"there is no lift file {path}; name one by its path")
    content = read_whole(path, LARGEST_FILE, "no lift file is; name tables by a scene in JSON (Scene.save)")
    try:
        text = _decoded(name, content)
        data = _parsed(name, text)
    except FileFormatError:
        if not _BEGIN.match(content):
            raise FileFormatError(f"{name}: is {looks_like(path, content)}, {_NO_LIFT}") from None
        raise
    if data.get("format") != FORMAT:
        what = f"is {looks_like(path, content)}" if "format" not in data else "names another format"
        raise FileFormatError(f"{name}: {what}, {_NO_LIFT}")
    try:
        return Document(name, data, lines_of(text))
    except RecursionError as error:
        raise FileFormatError(f"{name}: {_TOO_DEEP}") from error


def _decoded(name: str, content: bytes) -> str:
    """The text; some editors begin it with a mark."""
    try:
        return content.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise FileFormatError(f"{name} line {line}: byte {error.start} is not UTF-8 text") from error


def _parsed(name: str, text: str) -> dict[str, Any]:
    long = _LONG_KEY.search(text)
    if long:
        line = text.count("\n", 0, long.start()) + 1
        raise FileFormatError(f"{name} line {line}: a key has more than {MOST_PARTS} parts; no lift has such")
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        raise FileFormatError(f"{name}: {_TOO_DEEP}") from error
    except ValueError as error:  # TOMLDecodeError is one, a number of too many digits another
        raise FileFormatError(
            f"{_told(name, text, str(error)[:200])}; truncated or malformed TOML"
        ) from error


def _told(name: str, text: str, reason: str) -> str:
    """The parser's words with the line where ours have it."""
    found = _AT_LINE.match(reason)
    if found:
        return f"{name} line {found[2]}, column {found[3]}: {found[1]}"
    if reason.endswith(_AT_END):
        end = text.rstrip("\n").count("\n") + 1
        return f"{name} line {end}: {reason.removesuffix(_AT_END)} at the end of the file"
    return f"{name}: {reason}"


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
    """Lines of all keys and tables of a text that `tomllib` has read without an error.

    From 1 on, by the path of keys and places in lists, such as ("wire", 1, "joint"); the first of several.
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
            if token.kind == "bare" or token.text[0] == "'":
                parts.append(token.text.strip("'"))
            elif token.kind != "mark":  # a quoted key, which may hold escapes
                parts.append(next(iter(tomllib.loads(f"{token.text} = 0"))))
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
