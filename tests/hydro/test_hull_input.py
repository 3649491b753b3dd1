"""Bad hulls and bad files are refused by name; good files give the same hull in every form."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hull_shapes import ascii_stl, box, joined, moved, wigley_mesh, write_binary_stl

from seacrane.errors import FileFormatError
from seacrane.hydro import Hull, OffsetTable, read_offset_table, read_stl

BOX = box(length=40.0, breadth=10.0, bottom=-4.0, top=3.0)


def triangles() -> np.ndarray:
    vertices, faces = wigley_mesh(100.0, 16.0, 6.0, 6)
    return vertices[faces]


def test_ascii_and_binary_stl_give_the_hull_of_the_mesh(tmp_path: Path) -> None:
    vertices, faces = wigley_mesh(100.0, 16.0, 6.0, 6)
    volume = Hull.from_mesh(vertices=vertices, faces=faces).hydrostatics.volume
    (tmp_path / "a.stl").write_text(ascii_stl(triangles()))
    write_binary_stl(str(tmp_path / "b.stl"), triangles())
    write_binary_stl(str(tmp_path / "c.stl"), triangles(), header=b"solid but binary all the same")
    write_binary_stl(str(tmp_path / "mm.stl"), 1000.0 * triangles())
    for name in ("a", "b", "c"):
        assert Hull.from_stl(tmp_path / f"{name}.stl").hydrostatics.volume == pytest.approx(volume, rel=1e-6)
    with pytest.raises(ValueError, match=r"in mm, perhaps.*scale=0\.001"):
        Hull.from_stl(tmp_path / "mm.stl")
    scaled = Hull.from_stl(tmp_path / "mm.stl", scale=0.001)
    assert scaled.hydrostatics.volume == pytest.approx(volume, rel=1e-6)
    assert "mm.stl" in scaled.source


def damaged(kind: str, folder: Path) -> Path:
    """A damaged STL file."""
    path = folder / f"{kind}.stl"
    text = ascii_stl(triangles())
    if kind == "truncated binary":
        write_binary_stl(str(path), triangles())
        path.write_bytes(path.read_bytes()[:-30])
    elif kind == "truncated text":
        path.write_text(text[: len(text) // 2].rsplit("\n", 1)[0] + "\n")
    elif kind == "word":
        path.write_text(text.replace("vertex -5", "vertex x-5", 1))
    elif kind == "two numbers":
        path.write_text("solid a\nfacet\nvertex 1 2\n")
    elif kind == "two vertices":
        path.write_text("solid a\nfacet\nvertex 1 2 3\nvertex 2 2 2\nendfacet\nendsolid\n")
    elif kind == "nan":
        path.write_text(text.replace("vertex -5.000000000e+01", "vertex nan", 1))
    elif kind == "empty solid":
        path.write_text("solid a\nendsolid a\n")
    else:
        path.write_bytes(b"")
    return path


@pytest.mark.parametrize(
    ("kind", "message"),
    [
        ("truncated binary", "truncated or of another kind"),
        ("truncated text", "truncated"),
        ("word", "line 4"),
        ("two numbers", "line 3.*three numbers"),
        ("two vertices", "line 5.*2 vertices"),
        ("nan", "not finite"),
        ("empty solid", "no triangles"),
        ("empty", "0 bytes"),
    ],
)
def test_a_damaged_stl_file_is_refused(kind: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=message):
        read_stl(damaged(kind, tmp_path))


def test_every_shortened_stl_file_is_refused(tmp_path: Path) -> None:
    """No prefix of a file is a smaller hull."""
    write_binary_stl(str(tmp_path / "whole.stl"), triangles()[:20])
    whole = (tmp_path / "whole.stl").read_bytes()
    for size in range(0, len(whole), 7):
        (tmp_path / "cut.stl").write_bytes(whole[:size])
        with pytest.raises(FileFormatError):
            read_stl(tmp_path / "cut.stl")


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    for read in (read_stl, read_offset_table):
        with pytest.raises(FileFormatError, match=r"none\.xyz"):
            read(tmp_path / "none.xyz")


@pytest.mark.parametrize("order", [1, -1])
def test_offset_file_forward_or_aft_with_comments(order: int, tmp_path: Path) -> None:
    stations = [(x, [(5.0, 2.0), (5.0, -4.0), (0.0, -4.0)]) for x in (-20.0, 0.0, 20.0)][::order]
    lines = ["# a barge", "x,y,z"]
    for x, points in stations:
        lines += [f"{x}, {y}, {z}" for y, z in points] + [""]
    (tmp_path / "barge.csv").write_text("\n".join(lines))
    hull = Hull.from_offsets(tmp_path / "barge.csv")
    assert hull.name == "barge"
    assert hull.hydrostatics.volume == pytest.approx(1600.0)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "0 sections"),
        ("1,2\n", "line 1.*three finite numbers"),
        ("x,y,z\n0,1,a\n", "line 2"),
        ("0,1,nan\n", "line 1"),
        ("0 1 2\n", "line 1"),
        ("0,5,0\n1,5,0\n0,5,-1\n", "line 3.*comes back"),
        ("0,5,0\n0,0,-4\n", "two or more stations"),
        ("0,5,0\n2,5,0\n1,5,0\n", "have to increase"),
        ("0,-5,0\n0,0,-4\n1,-5,0\n1,0,-4\n", "port half"),
    ],
)
def test_a_malformed_offset_file_is_refused(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "bad.csv").write_text(text)
    with pytest.raises(FileFormatError, match=rf"(?s)bad\.csv.*{message}"):
        read_offset_table(tmp_path / "bad.csv")


def test_a_station_under_water_is_refused() -> None:
    table = OffsetTable(x=[0.0, 10.0], sections=([[5.0, 2.0], [0.0, -4.0]], [[1.0, -1.0], [0.0, -4.0]]))
    with pytest.raises(ValueError, match=r"x = 10 m begins 1 m below the waterline"):
        Hull.from_offsets(table)
    with pytest.raises(ValueError, match="draught is -1"):
        Hull.from_offsets(table, draught=-1.0)


def without_a_face() -> tuple[np.ndarray, np.ndarray]:
    return BOX[0], BOX[1][[0, 1, 2, 3, 5]]


def with_a_turned_face() -> tuple[np.ndarray, np.ndarray]:
    faces = BOX[1].copy()
    faces[1] = faces[1, ::-1]
    return BOX[0], faces


@pytest.mark.parametrize(
    ("mesh", "message"),
    [
        (without_a_face(), "one face only: the surface is open"),
        (with_a_turned_face(), "normals disagree"),
        ((BOX[0], BOX[1][:, ::-1]), "normals point inwards"),
        (joined(BOX, BOX), "more than two faces"),
        (moved(BOX, 0.0, 1.0, 0.0), "off the plane y = 0"),
        (moved(BOX, 0.0, 0.0, 9.0), "nothing is below the waterline"),
        (moved(BOX, 0.0, 0.0, -9.0), "wholly under water"),
        (box(length=4.0, breadth=40.0, bottom=-4.0, top=1.0), "x is forward"),
        (box(length=4e4, breadth=1e4, bottom=-4e3, top=1.0), "in mm"),
        ((np.full_like(BOX[0], np.nan), BOX[1]), "finite coordinates"),
        ((BOX[0], BOX[1] + 1), "names vertex 8 of 8"),
        ((BOX[0], BOX[1].astype(float)), "integer indices"),
        ((BOX[0][:, :2], BOX[1]), r"\(n, 3\)"),
        ((BOX[0], BOX[1][:, :2]), r"\(n, 3\) or \(n, 4\)"),
    ],
)
def test_a_surface_that_is_no_hull_is_refused(mesh: tuple[np.ndarray, np.ndarray], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Hull.from_mesh(vertices=mesh[0], faces=mesh[1])


def test_an_opening_above_the_waterline_does_not_matter() -> None:
    hull = Hull.from_mesh(vertices=BOX[0], faces=BOX[1][:5])  # no deck
    assert hull.hydrostatics.volume == pytest.approx(1600.0)


def test_panels_given_directly_are_checked() -> None:
    good = Hull.from_mesh(vertices=BOX[0], faces=BOX[1])
    for panels, message in (
        (good.panels[1:], "not closed"),
        (good.panels[:, ::-1], "inwards"),
        (good.panels + np.array([0.0, 0.0, 1.0]), "reaches z = 1"),
        (good.panels[0], "shape"),
        (np.full_like(good.panels, np.inf), "not finite"),
        (good.panels * np.array([1.0, 1.0, 1e-300]), "not closed"),
        (good.panels * np.array([1.0, 0.0, 1.0]), "not closed"),
    ):
        with pytest.raises(ValueError, match=message):
            Hull(name="h", panels=panels, source="test")
    with pytest.raises(ValueError, match="read-only"):
        good.panels[0] = 0.0
    with pytest.raises(ValueError, match="2 or more"):
        good.remeshed(stations=1, girth=4)
    with pytest.raises(ValueError, match="moved by"):
        good.moved(np.nan)
