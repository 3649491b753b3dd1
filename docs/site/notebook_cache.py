"""Where outputs of notebooks are kept: apart for each state of the package; none outlives its code."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

import seacrane


def folder(parent: Path) -> Path:
    """A folder in `parent` named after the contents of the installed package."""
    package = Path(seacrane.__file__).parent
    files = sorted(path for path in package.rglob("*") if path.is_file() and "__pycache__" not in path.parts)
    digest = sha256()
    for path in files:
        digest.update(str(path.relative_to(package)).encode())
        digest.update(path.read_bytes())
    return parent / digest.hexdigest()[:16]
