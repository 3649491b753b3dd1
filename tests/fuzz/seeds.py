"""Writes the smallest valid file of each kind into the corpus: python tests/fuzz/seeds.py."""

from __future__ import annotations

import dataclasses
import json
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import netCDF4
import numpy as np

sys.path.extend(map(str, Path(__file__).resolve().parents[1].glob("*/")))
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import group_cases
from group_cases import written_pair
from lift_examples import EVERY_TABLE
from orcaflex_writer import model
from test_elements import every_load
from test_hydro_bemio import bemio_values
from test_hydro_bemio import written as bemio_file
from test_hydro_capytaine import layout
from test_hydro_mafredo import dhyd
from test_hydro_nemoh import DAMAGE as NEMOH_DAMAGE
from test_hydro_nemoh import write_project
from test_meshes import glb, gltf_of_box
from test_scene_file import every_kind
from veres_writer import VeresRun

from fuzz.netcdf_spec import spec_of
from fuzz.targets import CORPUS
from seacrane import Scene, cases, simulate
from seacrane.crane.data_file import DEFAULT_PATH
from seacrane.description import file as scene_file
from seacrane.hydro import HydroDatabase, motion_response, shipped_database
from seacrane.hydro.data.drift_coefficients import DriftCoefficients
from seacrane.inputs.hdf5_structure import HEAP
from seacrane.result import Result

G = 9.80665


def put(target: str, name: str, content: bytes) -> None:
    (CORPUS / target).mkdir(parents=True, exist_ok=True)
    (CORPUS / target / name).write_bytes(content)


def small_hull() -> HydroDatabase:
    """Two frequencies and three headings of the shipped hull."""
    base = shipped_database()
    hull = dataclasses.replace(
        base,
        omega=base.omega[[20, 40]],
        heading=base.heading[[0, 9, 18]],
        added_mass=rounded(base.added_mass[[20, 40]]),
        damping=rounded(base.damping[[20, 40]]),
        force=base.force[[0, 9, 18]][:, [20, 40]].round(0),
        g=G,
        memory=None,
        trusted_band=None,
    )
    return dataclasses.replace(hull, motion_rao=motion_response(hull))


def rounded(matrix: np.ndarray) -> np.ndarray:
    """Three digits: shorter cases."""
    return np.array([float(f"{value:.3g}") for value in matrix.ravel()]).reshape(matrix.shape)


def veres_seeds(folder: Path) -> None:
    run = VeresRun(heading_deg=np.array([0.0, 90.0]), omega=np.array([0.5, 1.1]))
    run.write(folder)
    for suffix in (".re7", ".re8", ".re1", ".re2"):
        put("veres", f"box{suffix}", (folder / f"box{suffix}").read_bytes())
    put("veres", "box.hyd", HYD.encode())
    for version, speeds in ((1, (0.0,)), (2, (0.0, 4.0))):
        dataclasses.replace(run, version=version, speeds=speeds).write(folder)
        for suffix in (".re7", ".re8", ".re1", ".re2"):
            put(f"veres-{suffix[1:]}", f"version-{version}-speeds-{len(speeds)}",
                (folder / f"box{suffix}").read_bytes())  # fmt: skip


HYD = """\
Length between perpendiculars    (m)     60.000
Breadth                          (m)     14.000
Draught, midship                 (m)      5.000
Displacement                (tonnes)    4300.00       4301.21*
Vertical center of gravity,      VCG      6.000*
Longitudinal center of gravity,  LCG     28.000        28.514*
Transverse metacentric height,   GMt                    1.422*
Roll radius of gyration,         r44      5.050*
"""


def wamit_seeds() -> None:
    periods, headings = (6.0, 12.0), (0.0, 90.0)
    scale = np.array([8e3, 1.1e4, 1.7e4, 8e5, 9e6, 1e7])
    pairs = [(i, j) for i in range(6) for j in range(6) if i == j or (i, j) in ((0, 4), (4, 0))]

    def entry(i: int, j: int, size: float) -> float:
        return size * float(np.sqrt(scale[i] * scale[j])) * (1.0 if i == j else 0.1)

    radiation = [f"{p:.6E} {i + 1} {j + 1} {entry(i, j, 1.0):.6E}" for p in (-1.0, 0.0) for i, j in pairs]
    radiation += [
        f"{p:.6E} {i + 1} {j + 1} {entry(i, j, 1.0):.6E} {entry(i, j, 0.1):.6E}"
        for p in periods
        for i, j in pairs
    ]
    waves = [
        f"{p:.6E} {b:.6E} {i + 1} {5.0 + i:.6E} {90.0:.6E} {0.0:.6E} {5.0 + i:.6E}"
        for p in periods
        for b in headings
        for i in range(6)
    ]
    restoring = [
        f"{i + 1} {j + 1} {float(i == j and 2 <= i < 5) * scale[i]:.6E}" for i in range(6) for j in range(6)
    ]
    mass = "\n".join(" ".join(f"{v:.8g}" for v in row) for row in np.diag([9e7, 9e7, 9e7, 3e10, 4e11, 4e11]))
    zero = "\n".join(["0 0 0 0 0 0"] * 6)
    put("wamit", "box.1", ("\n".join(radiation) + "\n").encode())
    put("wamit", "box.3", ("\n".join(waves) + "\n").encode())
    put("wamit", "box.4", ("\n".join(waves) + "\n").encode())
    put("wamit", "box.hst", ("\n".join(restoring) + "\n").encode())
    put(
        "wamit",
        "box.frc",
        f"box\n1 0 1 1 0 0 0 0 1\n1025.0\n0.0 0.0 2.5\n1\n{mass}\n1\n{zero}\n0\n0\n".encode(),
    )
    put("wamit", "box.cfg", b"IALTFRC=2\nIPERIO=1\n")
    put("wamit", "box.out", LISTING.encode())
    put("wamit-frc", "radii", b"box\n1 0 1 2 0 0 0 0 1\n2.5\n15.0 0 0\n0 60.0 0\n0 0 60.0\n0\n")
    put("wamit-frc", "no-mass", b"box\n1 0 1 1 0 0 0 0 1\n1025.0\n0 0 2.5\n0\n0\n0\n0\n")


LISTING = """\
                        WAMIT  Version 6.314
 Input from Geometric Data File:         box.gdf
 Box
 Gravity:     9.80665                Length scale:        1.00000
 Water depth:        infinite       Water density:     1025.00000
 Total panels:    4750  Waterline panels:    246       Symmetry:   Y=0
 XBODY =    0.0000 YBODY =    0.0000 ZBODY =    0.0000 PHIBODY =   0.0
 Volumes (VOLX,VOLY,VOLZ):           92309.5      92313.2      92314.5
 Center of Buoyancy (Xb,Yb,Zb):     3.925910     0.000000    -4.815541
 Center of Gravity  (Xg,Yg,Zg):     3.930000     0.000000     2.500000
 Wave period (sec) =  6.000000E+00
 Wave period (sec) =  1.200000E+01

 End of the listing
"""


def orcaflex_seeds(hull: HydroDatabase) -> None:
    """JSON is YAML; the same model in OrcaFlex's own layout is the second seed."""
    from orcaflex_writer import text_of

    document = model(hull, phase=(1.0, 0.0, 0.0))
    put("orcaflex", "model", json.dumps(short(document)).encode())
    put("orcaflex-text", "model", text_of(short(document)).encode())


def series_seeds() -> None:
    """Records of loggers: decimal commas under a line of units, and time stamps with a second clock."""
    time = np.arange(60) * 0.1
    columns = [time, np.sin(time), 0.1 * np.cos(time), 2.0 * np.sin(time), np.cos(time), 359.5 + np.sin(time)]
    rows = [[f"{value:.4f}" for value in row] for row in zip(*columns, strict=True)]
    head = "Time (s);Surge_m;Heave [m];Roll (deg);Pitch [deg];Heading [deg]"
    comma = "\n".join(";".join(row).replace(".", ",") for row in rows)
    put("series", "commas", f"Logger 7\n{head}\n{comma}\n".encode())
    bare = "time\theave\troll\ns\tcm\tdeg\n# begins\n"
    some = [[row[0], row[2], row[3]] for row in rows]
    put("series", "units-below", (bare + "\n".join("\t".join(row) for row in some)).encode("utf-16"))
    some[20][1], some[30][2], some[40][1] = "", "90", "NaN"
    del some[50:52]
    put("series", "gaps", ("time_s heave_m roll_deg\n" + "\n".join(" ".join(r) for r in some[:20])).encode())
    put("series", "mended", ("time_s,heave_m,roll_deg\n" + "\n".join(",".join(r) for r in some)).encode())
    stamps = [f"2026-03-01T12:00:{float(row[0]):06.3f}Z,{float(row[0]) * 1.1:.3f}," for row in rows]
    lines = [stamp + ",".join(row[1:]) for stamp, row in zip(stamps, rows, strict=True)]
    named = "utc,clock [s]," + ",".join(head.split(";")[1:])
    put("motion-record", "stamps", (named + "\n" + "\n".join(lines) + "\n").encode("latin-1"))
    late = [[f"{float(row[0]) + 3.0 * (i > 30):.2f}", *row[1:]] for i, row in enumerate(rows)]
    put("motion-record", "jump", (head + "\n" + "\n".join(";".join(row) for row in late)).encode())
    degrees = head.replace("Heave [m]", "Heave [deg]")
    put("motion-record", "units", (degrees + "\n" + "\n".join(";".join(row) for row in rows)).encode())
    put(
        "motion-record",
        "radians",
        (head.replace("deg", "rad") + "\n" + "\n".join(map(";".join, rows))).encode(),
    )


def short(value: Any) -> Any:
    """The same document with numbers of five digits, infinity as a word."""
    if isinstance(value, dict):
        return {key: short(item) for key, item in value.items()}
    if isinstance(value, list):
        return [short(item) for item in value]
    if not isinstance(value, float):
        return value
    return float(f"{value:.5g}") if np.isfinite(value) else "Infinity"


def hull_seeds() -> None:
    outline = {-10.0: 1.0, 0.0: 3.0, 10.0: 1.0}
    rows = [f"{x},{y},{z}" for x, b in outline.items() for y, z in ((b, 2.0), (b, -2.0), (0.0, -2.0))]
    put("offsets", "boat", ("x,y,z\n" + "\n".join(rows) + "\n").encode())
    corners = np.array([(x, y, z) for x in (-5.0, 5.0) for y in (-2.0, 2.0) for z in (-1.0, 1.0)])
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    triangles = [corners[[q[0], q[i], q[i + 1]]] for q in quads for i in (1, 2)]
    lines = ["solid box"]
    for triangle in triangles:
        vertices = "\n".join("vertex " + " ".join(f"{v:g}" for v in point) for point in triangle)
        lines.append(f"facet normal 0 0 0\nouter loop\n{vertices}\nendloop\nendfacet")
    put("stl", "ascii", ("\n".join([*lines, "endsolid box"]) + "\n").encode())
    record = np.zeros(len(triangles), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    record["v"] = triangles
    put("stl", "binary", b"box".ljust(80) + len(triangles).to_bytes(4, "little") + record.tobytes())


def model_seeds(folder: Path) -> None:
    box = gltf_of_box(translation=[0.0, 0.0, 1.0])
    put("gltf", "box", json.dumps(box).encode())
    put("gltf-bytes", "box", glb(folder / "box.glb", box).read_bytes())


def scene_seeds(folder: Path) -> None:
    scene_file.save_scene(every_kind(), folder / "scene.json")
    data = json.loads((folder / "scene.json").read_bytes())
    put("scene", "every-kind", json.dumps(data).encode())
    zero = np.zeros((2, 3, 6)).tolist()
    headings = [0.0, 3.0]
    hull = data["waves"]["hulls"][0]
    hull |= {"force_by_heading": {"heading": headings, "real": zero, "imaginary": zero}, "drift": zero[0]}
    hull |= {"drift_by_heading": {"heading": headings, "real": zero}}
    put("scene", "hull-of-all-headings", json.dumps(data).encode())
    data["vessels"][0]["memory"] = {"step": 0.1, "kernel": np.zeros((3, 6, 6)).tolist()}
    data["waves"]["current"] = {"depth": [0.0, 20.0], "speed": [1.0, 0.5], "direction_deg": [30.0, 40.0]}
    put("scene", "convolution-and-current", json.dumps(data).encode())
    put("scene", "every-load", json.dumps(scene_file.described(every_load())).encode())


def nemoh_seeds(folder: Path) -> None:
    """A sound set of files in one folder, and one file for each refusal."""
    write_project(shipped_database().select(omega=[5, 20], heading=[0, 9]), folder / "ship")
    for file in sorted(path for path in (folder / "ship").rglob("*") if path.is_file()):
        put("nemoh", file.name, file.read_bytes())
    for number, (file, change, _) in enumerate(NEMOH_DAMAGE):
        if change is not None:
            text = (CORPUS / "nemoh" / Path(file).name).read_text()
            put(f"nemoh-{Path(file).stem.lower()}", f"damage-{number}", change(text).encode())


def group_seeds(folder: Path) -> None:
    """Two hulls as each code writes them: sound sets, a listing alone, and files of one refusal each."""
    group = written_pair(hull=shipped_database().select(omega=[5, 20], heading=[0, 9]))
    for name in ("wamit", "nemoh"):
        (folder / f"{name}-group").mkdir()
    for file in sorted(group_cases.wamit_files(group, folder / "wamit-group").iterdir()):
        put("wamit-group", f"box{file.suffix}", file.read_bytes())
    listing = (folder / "wamit-group" / "pair.out").read_text()
    put("wamit-listing", "box", listing.encode())
    put(
        "wamit-listing",
        "haskind",
        listing.replace("DIFFRACTION", "HASKIND").replace("feeder.gdf", "").encode(),
    )
    put("wamit-listing", "no-forces", listing.split("   DIFFRACTION")[0].encode())
    put("wamit-listing", "no-period", listing.replace("Wave period", "Wave").encode())
    put("wamit-listing", "no-gravity", listing.replace("Length scale:  1.0", "Length scale:  -1.0").encode())
    put(
        "wamit-listing",
        "words",
        listing.replace("Volumes (VOLX,VOLY,VOLZ):  1", "Volumes (VOLX,VOLY,VOLZ):  1.1.").encode(),
    )
    project = group_cases.nemoh_folder(group, folder / "nemoh-group")
    for file in sorted(path for path in project.rglob("*") if path.is_file()):
        put("nemoh-group", file.name, file.read_bytes())
    control = (project / "Nemoh.cal").read_text()
    put("nemoh-group-nemoh", "points", control.replace("38.0", "39.0", 1).encode())
    put("nemoh-group-nemoh", "bodies", control.replace("2 ! Number", "3 ! Number").encode())
    put(
        "nemoh-group-kh_1",
        "unlike",
        (project / "Mesh" / "Kh_1.dat").read_text().replace("E+07", "E+09").encode(),
    )
    radiation = (project / "Results" / "RadiationCoefficients.tec").read_text()
    put("nemoh-group-radiationcoefficients", "short", radiation[: radiation.rindex("Zone")].encode())
    volume = (project / "Mesh" / "Hydrostatics_1.dat").read_text()
    put("nemoh-group-hydrostatics_1", "negative", volume.replace("t = ", "t = -").encode())
    put("capytaine-group", "pair", spec_of(group_cases.capytaine_file(group, folder)))
    silent = group_cases.capytaine_dataset(group).drop_vars(("rotation_center", "draught"))
    silent.drop_vars("inertia_matrix").to_netcdf(folder / "silent.nc")
    put("capytaine-group", "silent", spec_of(folder / "silent.nc"))
    silent.isel(radiating_dof=slice(0, 11)).to_netcdf(folder / "short.nc")
    put("capytaine-group", "short", spec_of(folder / "short.nc"))
    put("capytaine-group-bytes", "pair", (folder / "pair.nc").read_bytes())
    put("bemio-group", "pair", spec_of(group_cases.bemio_file(group, folder)))
    put("bemio-group-bytes", "pair", (folder / "pair.h5").read_bytes())


def bemio_seeds(folder: Path) -> None:
    """A sound file, and one for each refusal."""
    base = shipped_database().select(omega=[5, 20], heading=[0, 9])
    part, body = "simulation_parameters", "body1/hydro_coeffs"
    changes: dict[str, dict[str, Any]] = {
        "ship": {},
        "two-bodies": {"body2/dof": 6.0},
        "scaled": {f"{part}/scaled": 1.0},
        "no-water": {f"{part}/rho": 0.0},
        "two-gravities": {f"{part}/g": np.ones(2)},
        "no-frequencies": {f"{part}/w": None},
        "short-frequencies": {f"{part}/w": np.ones(1)},
        "no-added-mass": {f"{body}/added_mass/all": None},
        "not-finite": {f"{body}/radiation_damping/all": np.full((6, 6, 2), np.nan)},
    }
    for name, change in changes.items():
        values = bemio_values(base) | {f"{part}/water_depth": np.inf} | change
        path = bemio_file({k: v for k, v in values.items() if v is not None}, folder / "ship.h5")
        put("bemio", name, spec_of(path))
    for name, depth in (("ship", b"infinite"), ("words", b"deep")):
        path = bemio_file(bemio_values(base) | {f"{part}/water_depth": depth}, folder / "ship.h5")
        put("bemio-bytes", name, path.read_bytes())


def netcdf_seeds(folder: Path, hull: HydroDatabase) -> None:
    drift = DriftCoefficients(heading=hull.heading, omega=hull.omega, coefficient=np.ones((3, 2, 6)))
    full = dataclasses.replace(hull, drift=drift, memory=small_memory(), trusted_band=(0.5, 1.0))
    for name, database in (("plain", hull), ("full", full)):
        database.save(folder / "hull.nc")
        put("database", name, spec_of(folder / "hull.nc"))
        put("database-bytes", name, (folder / "hull.nc").read_bytes())
    data = layout().isel(omega=[0, 3, 7, -1], wave_direction=[0, 4])
    data.to_netcdf(folder / "ship.nc")
    put("capytaine", "ship", spec_of(folder / "ship.nc"))
    put("capytaine-bytes", "ship", (folder / "ship.nc").read_bytes())
    bemio_seeds(folder)
    nemoh_seeds(folder)
    group_seeds(folder)
    path = dhyd(hull, folder, phase_origin=(1.0, 0.0))
    put("mafredo", "ship", spec_of(path))
    put("mafredo-bytes", "ship", path.read_bytes())
    result = simulate(cases.case1(), t_end=1.0, dt_out=0.5)
    result.save(folder / "run.nc")
    put("result", "run", spec_of(folder / "run.nc"))
    pendulum().save(folder / "small.nc")
    put("result", "small", spec_of(folder / "small.nc"))
    put("result-bytes", "small", (folder / "small.nc").read_bytes())
    hostile_hdf5(folder)
    put("result-bytes", "run", (folder / "run.nc").read_bytes())


def hostile_hdf5(folder: Path) -> None:
    """The smallest files of what HDF5 allows and no NetCDF writer makes."""
    text = h5py.string_dtype()

    def packed(file: h5py.File) -> None:
        file.create_dataset("a", (4,), text, chunks=(2,), compression="gzip")

    def folded(file: h5py.File) -> None:
        made = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        made.set_chunk((4,))
        made.set_deflate(1)
        made.set_deflate(1)
        h5py.h5d.create(file.id, b"a", h5py.h5t.IEEE_F64LE, h5py.h5s.create_simple((4,)), made)

    kinds: dict[str, Callable[[h5py.File], Any]] = {
        "itself": lambda file: file.__setitem__("a", file["/"]),
        "link": lambda file: file.__setitem__("a", h5py.SoftLink("/b")),
        "deep": lambda file: file.create_group("/".join("abcdefghijkl")),
        "elsewhere": lambda file: file.create_dataset("a", (1,), "f8", external=[("b", 0, 8)]),
        "ragged": lambda file: file.create_dataset("a", (2,), h5py.vlen_dtype("f8")),
        "ragged-attribute": lambda file: h5py.h5a.create(
            file.id, b"a", h5py.h5t.vlen_create(h5py.h5t.IEEE_F64LE), h5py.h5s.create_simple((2,))
        ),
        "texts": lambda file: file.create_dataset("a", (2,), text).__setitem__(0, "b"),
        "texts-in-chunks": lambda file: file.create_dataset("a", (2,), text, chunks=(2,)).__setitem__(0, "b"),
        "text-attributes": lambda file: file.attrs.create("a", ["b", "c"], dtype=text),
        "large": lambda file: file.create_dataset("a", (2**31,), "f8", chunks=(8,)),
        "large-chunk": lambda file: file.create_dataset("a", (1,), "f8", maxshape=(None,), chunks=(2**28,)),
        "packed-texts": packed,
        "folded-twice": folded,
    }
    for name, fill in kinds.items():
        with h5py.File(folder / name, "w", libver="latest") as file:
            fill(file)
        put("result-bytes", name, (folder / name).read_bytes())
    damaged = bytearray((CORPUS / "result-bytes" / "texts").read_bytes())
    heap = damaged.index(HEAP)
    damaged[heap + 16 : heap + 32] = bytes(16)
    put("result-bytes", "damaged-heap", damaged)
    with h5py.File(folder / "block", "w", userblock_size=512):
        pass
    put("result-bytes", "user-block", (folder / "block").read_bytes())
    for name, size in (("classic", 2), ("classic-large", 2**28)):
        with netCDF4.Dataset(folder / name, "w", format="NETCDF3_64BIT_OFFSET") as file:
            file.set_fill_off()
            file.createDimension("time", size)
            for variable in ("time", "a", "b"):
                file.createVariable(variable, "f8", ("time",))
        with (folder / name).open("rb") as written:
            put("result-bytes", name, written.read(400))


def pendulum() -> Result:
    """Few channels, outputs and events: a case of it is written ten times as fast as one of a crane."""
    scene = Scene(name="pendulum")
    scene.add_body(name="bob", mass=1.0, inertia=np.eye(3), position=(0.0, 0.0, 0.0))
    scene.add_joint(name="slide", kind="prismatic", first="ground", second="bob")
    scene.add_end_stop(joint="slide", minimum=-1.0)
    full = simulate(scene, t_end=1.0, dt_out=0.5)
    channels = {name: full[name] for name in ("position", "energy_balance")}
    coords = {dim: full.coords[dim] for dim in ("body", "axis")}
    return dataclasses.replace(full, channels=channels, extremes={}, coords=coords)


def small_memory() -> Any:
    """The first block of the shipped memory."""
    memory = shipped_database().memory
    assert memory is not None
    return dataclasses.replace(memory, blocks=memory.blocks[:1], rows=memory.rows[:2])


def main() -> None:
    hull = small_hull()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        veres_seeds(folder)
        model_seeds(folder)
        scene_seeds(folder)
        netcdf_seeds(folder, hull)
    wamit_seeds()
    orcaflex_seeds(hull)
    hull_seeds()
    series_seeds()
    put("crane", "shipped", DEFAULT_PATH.read_bytes())
    put("lift", "every-table", EVERY_TABLE.encode())
    put("lift", "case3", DEFAULT_PATH.with_name("lifts").joinpath("case3.toml").read_bytes())
    t = np.arange(16) * 0.5
    record = {
        "time": t.tolist(),
        "elevation": np.sin(t).round(3).tolist(),
        "direction_deg": 30.0,
        "taper": 0.1,
    }
    put(
        "measured",
        "record",
        json.dumps({**record, "minimum_omega": 0.5, "maximum_omega": 3.0, "name": "buoy"}).encode(),
    )


if __name__ == "__main__":
    main()
