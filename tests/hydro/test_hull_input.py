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


def test_a_damaged_stl_file_is_refused(tmp_path: Path) -> None:
    """No prefix of a file is a smaller hull."""
    text, path = ascii_stl(triangles()), tmp_path / "hull.stl"
    for content, message in (
        (text[: len(text) // 2].rsplit("\n", 1)[0] + "\n", "truncated"), ("", "0 bytes"),
        (text.replace("vertex -5", "vertex x-5", 1), "line 4"), ("solid a\nendsolid a\n", "no triangles"),
        ("solid a\nfacet\nvertex 1 2\n", "line 3.*three numbers"),
        ("solid a\nfacet\nvertex 1 2 3\nvertex 2 2 2\nendfacet\nendsolid\n", "line 5.*2 vertices"),
        (text.replace("vertex -5.000000000e+01", "vertex nan", 1), "not finite"),
    ):  # fmt: skip
        path.write_text(content)
        with pytest.raises(FileFormatError, match=message):
            read_stl(path)
    write_binary_stl(str(path), triangles()[:20])
    whole = path.read_bytes()
    for size in range(0, len(whole), 7):
        path.write_bytes(whole[:size])
        with pytest.raises(FileFormatError):
            read_stl(path)
    for read in (read_stl, read_offset_table):
        with pytest.raises(FileFormatError, match=r"none\.xyz"):
            read(tmp_path / "none.xyz")


def test_offset_files_forward_or_aft_with_comments_and_malformed(tmp_path: Path) -> None:
    path = tmp_path / "barge.csv"
    for order in (1, -1):
        stations = [(x, [(5.0, 2.0), (5.0, -4.0), (0.0, -4.0)]) for x in (-20.0, 0.0, 20.0)][::order]
        lines = ["# a barge", "x,y,z"]
        for x, points in stations:
            lines += [f"{x}, {y}, {z}" for y, z in points] + [""]
        path.write_text("\n".join(lines))
        hull = Hull.from_offsets(path)
        assert hull.name == "barge" and hull.hydrostatics.volume == pytest.approx(1600.0)
    for text, message in (
        ("", "0 sections"), ("1,2\n", "line 1.*three finite"), ("x,y,z\n0,1,a\n", "line 2"),
        ("0,1,nan\n", "line 1"), ("0 1 2\n", "line 1"), ("0,5,0\n1,5,0\n0,5,-1\n", "line 3.*comes back"),
        ("0,5,0\n0,0,-4\n", "two or more"), ("0,5,0\n2,5,0\n1,5,0\n", "increase"),
        ("0,-5,0\n0,0,-4\n1,-5,0\n1,0,-4\n", "port half"),
    ):  # fmt: skip
        path.write_text(text)
        with pytest.raises(FileFormatError, match=rf"(?s)barge\.csv.*{message}"):
            read_offset_table(path)
    table = OffsetTable(x=[0.0, 10.0], sections=([[5.0, 2.0], [0.0, -4.0]], [[1.0, -1.0], [0.0, -4.0]]))
    for given, message in (({}, "x = 10 m begins 1 m below"), ({"draught": -1.0}, "draught is -1")):
        with pytest.raises(ValueError, match=message):
            Hull.from_offsets(table, **given)


TURNED = np.vstack([BOX[1][:1], BOX[1][1:2, ::-1], BOX[1][2:]])
NO_HULL: list[tuple[tuple[np.ndarray, np.ndarray], str]] = [
    ((BOX[0], BOX[1][[0, 1, 2, 3, 5]]), "the surface is open"), ((BOX[0], TURNED), "normals disagree"),
    ((BOX[0], BOX[1][:, ::-1]), "inwards"), (joined(BOX, BOX), "more than two faces"),
    (moved(BOX, 0.0, 1.0, 0.0), "off the plane y = 0"), (moved(BOX, 0.0, 0.0, 9.0), "nothing is below"),
    (moved(BOX, 0.0, 0.0, -9.0), "wholly under"), ((BOX[0], BOX[1] + 1), "names vertex 8 of 8"),
    (box(length=4.0, breadth=40.0, bottom=-4.0, top=1.0), "x is forward"),
    (box(length=4e4, breadth=1e4, bottom=-4e3, top=1.0), "in mm"),
    ((np.full_like(BOX[0], np.nan), BOX[1]), "finite"), ((BOX[0], BOX[1].astype(float)), "integer"),
    ((BOX[0][:, :2], BOX[1]), r"\(n, 3\)"), ((BOX[0], BOX[1][:, :2]), r"\(n, 3\) or \(n, 4\)"),
]  # fmt: skip


def test_a_surface_that_is_no_hull_is_refused() -> None:
    for (vertices, faces), message in NO_HULL:
        with pytest.raises(ValueError, match=message):
            Hull.from_mesh(vertices=vertices, faces=faces)
    open_above = Hull.from_mesh(vertices=BOX[0], faces=BOX[1][:5])  # no deck
    assert open_above.hydrostatics.volume == pytest.approx(1600.0)


def test_panels_given_directly_are_checked() -> None:
    good = Hull.from_mesh(vertices=BOX[0], faces=BOX[1])
    for panels, message in (
        (good.panels[1:], "not closed"), (good.panels[:, ::-1], "inwards"), (good.panels[0], "shape"),
        (good.panels + np.array([0.0, 0.0, 1.0]), "reaches z = 1"), (0.0 * good.panels + np.inf, "finite"),
        (good.panels * np.array([1.0, 1.0, 1e-300]), "not closed"),
    ):  # fmt: skip
        with np.errstate(invalid="ignore"), pytest.raises(ValueError, match=message):
            Hull(name="h", panels=panels, source="test")
    with pytest.raises(ValueError, match="read-only"):
        good.panels[0] = 0.0
    with pytest.raises(ValueError, match="2 or more"):
        good.remeshed(stations=1, girth=4)
    with pytest.raises(ValueError, match="moved by"):
        good.moved(np.nan)
