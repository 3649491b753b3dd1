"""What is installed and how it was built; one writer of a file on any platform; no module of one system."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from seacrane.cli import doctor_command
from seacrane.cli.command_line import main
from seacrane.inputs import sole_writer
from seacrane.result.partial_file import PartialFile
from seacrane.run.lanes import lanes_of

WITHOUT_POSIX = """
import sys, types
locked = {}
def locking(number, mode, count):
    import os
    at, file = os.lseek(number, 0, os.SEEK_CUR), os.fstat(number).st_ino
    if file in locked:
        raise PermissionError(13, "locked")
    locked[file] = (at, count)
fake = types.ModuleType("msvcrt")
fake.LK_NBLCK, fake.locking = 2, locking
sys.modules["msvcrt"] = fake
for name in ("fcntl", "resource", "pwd", "grp", "termios", "pty", "posix_ipc"):
    sys.modules[name] = None
"""


def python(code: str, *arguments: str) -> str:
    """Standard output of a fresh interpreter in which POSIX's modules are absent."""
    command = [sys.executable, "-c", WITHOUT_POSIX + code, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_every_module_is_imported_without_the_modules_of_posix() -> None:
    code = (
        "import pkgutil, seacrane, importlib\n"
        "names = [m.name for m in pkgutil.walk_packages(seacrane.__path__, 'seacrane.')]\n"
        "for name in names:\n"
        "    if not name.endswith('__main__'): importlib.import_module(name)\n"
        "print(len(names))\n"
    )
    assert int(python(code)) > 150


TWO_WRITERS = """
from pathlib import Path
from seacrane.result.partial_file import PartialFile, Piece
import numpy as np
one, two = PartialFile(Path(sys.argv[1])), PartialFile(Path(sys.argv[1]))
one.claim(); one.keep_until(0)
one.append(Piece(arrays={'time': np.arange(3.0)}, coords={}, stats={}))
print([piece.outputs for piece, _ in one.pieces()])
try: two.claim()
except FileExistsError as error: print(error)
(at, count), = locked.values()
print(at > 10**9, count)
"""


def test_a_file_has_one_writer_without_fcntl(tmp_path: Path) -> None:
    pieces, refused, lock = python(TWO_WRITERS, str(tmp_path / "run.nc.partial")).splitlines()
    assert (pieces, lock) == ("[3]", "True 1") and "written by another run" in refused


@pytest.mark.parametrize("open_files_go", [True, False])
def test_a_file_has_one_writer(open_files_go: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sole_writer, "REMOVES_OPEN_FILES", open_files_go)
    one, two = (PartialFile(tmp_path / "run.nc.partial") for _ in range(2))
    one.claim()
    with pytest.raises(FileExistsError, match="written by another run"):
        two.claim()
    one.release(remove=True)
    two.claim()
    two.release(remove=True)
    assert not list(tmp_path.iterdir())


def test_the_doctor_finds_all_that_is_needed_or_names_it(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for wanted, ends, words in (
        (["numpy>=2.0", "absent-thing>=9"], 1, "pip install 'absent-thing>=9'"),
        (["numpy>=2.0", "absent>=1; extra == 'view'"], 0, f"{lanes_of(None)} by default; "),
    ):
        monkeypatch.setattr(doctor_command, "requires", lambda name, lines=wanted: lines)
        assert main(["doctor"]) == ends
        assert words in capsys.readouterr().out
