"""Commands that documents name: each is one that the program knows, and those of a page run in order."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from seacrane.cli.command_line import build_parser

ROOT = Path(__file__).resolve().parents[2]
TEXTS = {
    str(path.relative_to(ROOT)): path.read_text(encoding="utf-8")
    for pattern in ("README.md", "docs/*.md", "notebooks/*.md")
    for path in sorted(ROOT.glob(pattern))
}
INDENTED = re.compile(r"^ {4}(?:\$ )?(seacrane [^\n]*)$", re.MULTILINE)
QUOTED = re.compile(r"`(seacrane\s[^`]*)`")
LISTING = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)
NO_COMMANDS = {"state"}  # the first line of a state file
TOML = re.compile(r"^```toml\n(.*?)^```", re.DOTALL | re.MULTILINE)
RUN = ("docs/getting-started.md", "docs/lift-files.md", "docs/answers.md", "docs/studies.md")


def words(line: str) -> list[str]:
    """Of a command: without a comment, what is redirected, and brackets about options."""
    line = re.split(r" [>|#]", line)[0].replace("[", "").replace("]", "")
    return shlex.split(line)[1:]


def commands(text: str) -> list[list[str]]:
    """All of a page; names of commands alone as well."""
    plain = LISTING.sub("", text)
    found = [words(line) for line in INDENTED.findall(plain)]
    found += [words(" ".join(line.split())) for line in QUOTED.findall(plain)]
    return [one for one in found if one and one[0] not in NO_COMMANDS]


@pytest.mark.parametrize("name", [name for name, text in TEXTS.items() if commands(text)])
def test_commands_of_a_document_can_be_given(name: str) -> None:
    parser = build_parser()
    for one in commands(TEXTS[name]):
        try:
            parser.parse_args(one if len(one) > 1 or one[0].startswith("-") else [*one, "--help"])
        except SystemExit as end:
            assert not end.code, f"{name}: seacrane {' '.join(one)}"


@pytest.mark.slow("all commands of a document")
@pytest.mark.parametrize("name", RUN)
def test_commands_of_a_document_run_in_order(name: str, tmp_path: Path) -> None:
    """Files that a page calls the reader's own hold the page's first listing."""
    text = TEXTS[name]
    lines = INDENTED.findall(LISTING.sub("", text))
    for own in set(re.findall(r"my_\w+\.toml", " ".join(lines))):
        (listing, *_) = TOML.findall(text)
        (tmp_path / own).write_text(listing, encoding="utf-8")
    for line in lines:
        command = [sys.executable, "-m", "seacrane", *words(line)]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=900, check=False)
        assert done.returncode == 0, f"{name}: {line}\n{done.stderr}"
