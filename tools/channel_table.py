"""Writes the table of channels into docs/channels.md, from the table that the core registers."""

from __future__ import annotations

from pathlib import Path

from seacrane.description.channels import CHANNELS, FIXED, Channel

DOCUMENT = Path(__file__).parents[1] / "docs" / "channels.md"
BEGIN, END = "<!-- begin: tools/channel_table.py -->\n", "<!-- end -->\n"


def _row(name: str, channel: Channel) -> str:
    optional = set(channel.dims_of_several) - set(channel.dims)
    dims = ", ".join(f"({dim})" if dim in optional else dim for dim in channel.dims_of_several)
    made_of = f"; from {' or '.join(f'`{part}`' for part in channel.made_of)}" if channel.made_of else ""
    text = channel.long_name + made_of + ("" if channel.by_default else "; on request")
    return f"| `{name}` | {dims} | {channel.unit} | {text} |\n"


def table() -> str:
    """The generated block, its marks included."""
    rows = "".join(_row(name, channel) for name, channel in CHANNELS.items())
    fixed = "".join(f"- `{dim}`: {', '.join(names)}\n" for dim, names in FIXED.items())
    return f"{BEGIN}| channel | dimensions | unit | |\n|---|---|---|---|\n{rows}\n{fixed}{END}"


def current(text: str) -> str:
    """A document with the block made anew."""
    before, _, rest = text.partition(BEGIN)
    return before + table() + rest.partition(END)[2]


if __name__ == "__main__":
    DOCUMENT.write_text(current(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")
