"""What a file that is not of the kind asked for seems to be, for the message that refuses it."""

from __future__ import annotations

import re
from pathlib import Path

_STARTS = {
    b"\x89HDF": "a NetCDF file (Result.load or load_database)",
    b"CDF": "a NetCDF file (load_database)",
    b"ISO-10303-21": "a STEP model",
    b"seacrane state": "a state (load_state)",
    b"<": "XML, such as a URDF model",
    b"PK\x03\x04": "a ZIP archive",
    b"glTF": "a glTF model",
    b"%PDF": "a PDF document",
}
_SUFFIXES = {
    ".py": "a Python script (seacrane run)",
    ".yml": "YAML, as of an OrcaFlex model (load_database)",
    ".yaml": "YAML, as of an OrcaFlex model (load_database)",
    ".stl": "a surface (Hull.from_stl)",
}
_LINES = {  # of TOML texts, which say themselves what they are of
    rb"(?m)^\s*format\s*=\s*[\"']seacrane lift[\"']": "a lift in TOML (Lift.load, seacrane run)",
    rb"(?m)^\s*schema\s*=\s*\d": "a crane in TOML (load_crane)",
}
_TOML = "TOML, as of a crane (load_crane) or a lift (Lift.load, seacrane run)"
_LONGEST = 20_000  # bytes that are looked at


def looks_like(path: Path, data: bytes) -> str:
    """By its first bytes, else by its suffix, else by its first lines; with what reads it, where we do."""
    if not data.strip():
        return "empty"
    for start, kind in _STARTS.items():
        if data.startswith(start):
            return kind
    if path.suffix.lower() in _SUFFIXES:
        return _SUFFIXES[path.suffix.lower()]
    text = data.lstrip()
    if text.startswith(b"{"):
        return "JSON, as of a scene (Scene.load)"
    for line, kind in _LINES.items():
        if re.search(line, text[:_LONGEST]):
            return kind
    if path.suffix.lower() == ".toml":
        return _TOML
    return "a JSON list" if text.startswith(b"[") else "something else"
