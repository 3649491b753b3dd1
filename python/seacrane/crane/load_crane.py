"""load_crane: a crane of any kind from its data file."""

from __future__ import annotations

from pathlib import Path

from seacrane.crane import data_file, jointed_file
from seacrane.crane.builder import KnuckleBoomCrane
from seacrane.crane.file_table import read_text, root_of
from seacrane.crane.jointed import JointedCrane
from seacrane.errors import FileFormatError
from seacrane.inputs.shown import shown

Crane = KnuckleBoomCrane | JointedCrane
SHIPPED = Path(__file__).resolve().parent.parent / "data" / "cranes"


def load_crane(path: str | Path) -> Crane:
    """Read a crane's data file, of whatever kind the file says.

    Parameters
    ----------
    path : path-like
        TOML with kind "knuckle-boom" (default), "jointed" or "urdf"; or the name of a crane that comes with
        seacrane, one of `shipped_cranes`.

    Returns
    -------
    KnuckleBoomCrane or JointedCrane
        For `Scene.add_crane`.

    Raises
    ------
    FileFormatError
        The file cannot be read, is malformed, or describes a crane that cannot work; the message names the
        item.
    """
    if str(path) in shipped_cranes():
        path = (
            data_file.DEFAULT_PATH if str(path) == data_file.DEFAULT_PATH.stem else SHIPPED / f"{path}.toml"
        )
    file = Path(path)
    text = read_text(file)
    kind = root_of(text, str(file)).values.get("kind", data_file.KIND)
    if kind == data_file.KIND:
        return KnuckleBoomCrane(data_file.parse(text, source=str(file)))
    if kind in (jointed_file.JOINTED, jointed_file.URDF):
        return JointedCrane(jointed_file.parse(text, source=str(file), folder=file.parent))
    known = f'"{data_file.KIND}", "{jointed_file.JOINTED}" or "{jointed_file.URDF}"'
    raise FileFormatError(f"{file}: kind is {shown(kind)}; write {known}.")


def shipped_cranes() -> list[str]:
    """Names of the cranes that come with seacrane."""
    return [data_file.DEFAULT_PATH.stem, *sorted(path.stem for path in SHIPPED.glob("*.toml"))]
