"""Reads exports with readers that are not ours and compares them with the run's trajectory.

Everything that is expected is worked out here, from the sites in trajectory.h5.
"""

import json
import shlex
import xml.etree.ElementTree as xml
from collections import Counter
from pathlib import Path

import gsd.hoomd
import gsd.pygsd
import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

PITCH = np.sqrt(3) / 2
MOVES = np.array([(0, 1), (PITCH, 0.5), (PITCH, -0.5), (0, -1), (-PITCH, -0.5), (-PITCH, 0.5), (0, 0)])


def place(sites):
    """Places of sites (column, row) in the plane, in lattice spacings."""
    sites = np.asarray(sites, dtype=int).reshape(-1, 2)
    return np.stack([PITCH * sites[:, 0], sites[:, 1] + 0.5 * (sites[:, 0] & 1)], axis=1)


def sites_from(site, parts):
    """Sites at axial vectors (up-right, up) from a site."""
    columns = site[0] + parts[:, 0]
    rows = site[1] + parts[:, 1] + (columns >> 1) - (site[0] >> 1)
    return np.stack([columns, rows], axis=1)


def body_area(parts):
    """Six small triangles around each site, and the middle one of each unit triangle with a bond."""
    sites = {tuple(part) for part in parts}
    middles = 0
    for x, q in {(x - i, q - j) for x, q in sites for i in (0, 1) for j in (0, 1)}:
        for corners in (((x, q), (x + 1, q), (x, q + 1)), ((x + 1, q + 1), (x + 1, q), (x, q + 1))):
            middles += sum(corner in sites for corner in corners) >= 2
    return (6 * len(sites) + middles) * np.sqrt(3) / 16


class Run:
    """The trajectory of a run, frame by frame, as columns of the particles present; in metres with `units`, with a
    density in kilograms and newtons, too. Where a stage ends and the next one begins there is one frame.
    """

    def __init__(self, folder):
        units = json.loads((Path(folder) / "run.json").read_text()).get("units", {})
        self.spacing = units.get("spacing", 1)
        self.site_mass, self.site_weight = units.get("site_mass", 1), units.get("site_weight")
        file = h5py.File(Path(folder) / "trajectory.h5", "r")
        scene = file["scene"]
        self.columns, self.rows, periodic = (int(value) for value in scene["lattice"][:])
        self.periodic = bool(periodic)
        self.period = self.columns * PITCH * self.spacing
        self.height = (self.rows + 0.5) * self.spacing
        self.species = [name.decode() for name in scene["species"][:]]
        self.kind_species = scene["kinds/species"][:]
        self.kinds = self.sets(scene["kinds"])
        self.walls = self.sets(scene["walls"])
        self.is_contact = "velocity" in file["particles"]
        self.has_contacts = "contacts" in file
        self.time_step = units.get("time_step", 1)
        self.sizes = np.array([len(parts) for parts in self.kinds])
        self.radius = np.sqrt([len(parts) * np.sqrt(3) / (2 * np.pi) for parts in self.kinds])
        origins = {}
        self.frames = []
        for number in range(len(file["frames/step"])):
            frame = self.frame(file, number, origins)
            if not self.frames or frame["step"] > self.frames[-1]["step"]:
                self.frames.append(frame)

    @staticmethod
    def sets(group):
        sites = group["sites"][:].reshape(-1, 2)
        return [sites[f : f + n] for f, n in zip(group["first"][:].astype(int), group["size"][:])]

    def frame(self, file, number, origins):
        def rows(kind, first, count):
            begin = int(file["frames/" + first][number])
            end = begin + int(file["frames/" + count][number])
            return {name: data[begin:end] for name, data in file[kind].items()}

        for one, site in zip(*(rows("origins", "first_origin", "origins")[k] for k in ("id", "site"))):
            origins[one] = site
        table = rows("particles", "first", "particles")
        sites = [sites_from(s, self.kinds[k]) for s, k in zip(table["site"].astype(int), table["kind"])]
        frame = {
            "step": int(file["frames/step"][number]),
            "id": table["id"],
            "kind": table["kind"],
            "velocity": table["velocity"] * self.spacing / self.time_step if self.is_contact else MOVES[table["move"]],
            "spin": table["spin"] / self.radius[table["kind"]] / self.time_step if self.is_contact else None,
            "displacement": place(table["site"]) - place([origins[i] for i in table["id"]]),
            "centre": np.array([place(s).mean(axis=0) for s in sites]).reshape(-1, 2),
            "walls": self.walls_of(file, number),
        }
        frame["image"] = np.floor((frame["centre"][:, 0] + PITCH / 2) / self.period) * self.periodic
        frame["centre"][:, 0] -= frame["image"] * self.period
        frame["sites"] = [place(s) - (i * self.period, 0) for s, i in zip(sites, frame["image"])]
        frame["force"] = self.forces(sites, frame["walls"])
        frame["mass"] = self.site_mass * self.sizes[table["kind"]]
        frame["diameter"] = 2 * self.radius[table["kind"]]
        if self.has_contacts:
            self.add_contacts(frame, rows("contacts", "first_contact", "contacts"))
        for name in ("centre", "displacement", "diameter"):
            frame[name] = frame[name] * self.spacing
        frame["sites"] = [sites * self.spacing for sites in frame["sites"]]
        return frame

    def add_contacts(self, frame, contacts):
        """Each contact with its line and its force; by particle the sum of normal forces."""
        weight = 1 if self.site_weight is None else self.site_weight * self.sizes[frame["kind"]].mean()
        place_of = {one: place for place, one in enumerate(frame["id"])}
        frame["contacts"] = []
        for upper, other, normal, branch, force in zip(
            *(contacts[k] for k in ("upper", "other", "normal", "branch", "force"))
        ):
            along, across = weight * force
            frame["force"][place_of[upper]] += along
            if other >= 0:
                frame["force"][place_of[other]] += along
            end = frame["centre"][place_of[upper]]
            vector = along * normal + across * np.array([-normal[1], normal[0]])
            frame["contacts"].append(
                {
                    "upper": upper,
                    "other": other,
                    "line": self.spacing * np.array([end - branch, end]),
                    "force": vector,
                    "normal_force": along,
                    "tangential_force": across,
                }
            )

    def walls_of(self, file, number):
        """Sites in the box of each wall that is there."""
        result = {}
        for wall, home in enumerate(self.walls):
            if file["walls/present"][number, wall]:
                down = np.array([0, -1]) * abs(int(file["walls/offset"][number, wall]))
                now = home + down  # in the scenes of this test, walls move down
                result[wall] = now[(now[:, 1] >= 0) & (now[:, 1] < self.rows)]
        return result

    def forces(self, sites, walls):
        """Sites that each particle shares with other particles and walls."""
        everything = [tuple(s) for body in list(sites) + list(walls.values()) for s in body]
        owners = Counter(everything)
        return np.array([sum(owners[tuple(s)] - 1 for s in body) for body in sites], dtype=float)


def same(found, expected, what, tolerance=None):
    """Tolerance: of numbers of 32 bits, the largest of which counts."""
    found, expected = np.asarray(found, dtype=float), np.asarray(expected, dtype=float)
    assert found.shape == expected.shape, f"{what}: {found.shape} instead of {expected.shape}"
    if tolerance is None:
        tolerance = 1e-6 * np.abs(expected).max(initial=1e-30)
    assert np.allclose(found, expected, rtol=0, atol=tolerance), f"{what} differs"


def on_found_side(run, frame, x):
    """A particle right on the seam may stand on either side of it: the one where it was found."""
    from_seam = (frame["centre"][:, 0] + PITCH / 2 * run.spacing) / run.period
    on_seam = run.periodic & (abs(from_seam - np.round(from_seam)) < 1e-9)
    side = on_seam * np.round((x - frame["centre"][:, 0]) / run.period)
    shift = np.stack([side * run.period, 0 * side], axis=1)
    return {
        **frame,
        "centre": frame["centre"] + shift,
        "image": frame["image"] - side,
        "sites": [sites + by for sites, by in zip(frame["sites"], shift)],
    }


def in_plane(vectors):
    vectors = np.asarray(vectors).reshape(-1, 3)
    assert not vectors[:, 2].any(), "leaves the plane"
    return vectors[:, :2]


def polygon_area(corners):
    x, y = np.asarray(corners, dtype=float)[:, :2].T
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


def inside(corners, point):
    x, y = np.asarray(corners, dtype=float)[:, :2].T
    x2, y2 = np.roll(x, -1), np.roll(y, -1)
    crosses = (y > point[1]) != (y2 > point[1])
    at = x + (point[1] - y) * (x2 - x) / np.where(crosses, y2 - y, 1)
    return (crosses & (at > point[0])).sum() % 2 == 1


def check_gsd(run, file):
    with open(file, "rb") as stream, gsd.hoomd.open(file, "rb") as by_library:
        for trajectory in (by_library, gsd.hoomd.HOOMDTrajectory(gsd.pygsd.GSDFile(stream))):
            assert trajectory.file.schema == "hoomd" and trajectory.file.schema_version == (1, 4)
            assert trajectory.file.gsd_version >= (1, 0)
            assert len(trajectory) == len(run.frames), "number of frames"
            for found, expected in zip(trajectory, run.frames):
                check_gsd_frame(run, found, expected)


def check_gsd_frame(run, found, expected):
    particles = found.particles
    size = np.array([run.period, run.height])
    assert found.configuration.step == expected["step"] and found.configuration.dimensions == 2
    same(found.configuration.box, [*size, run.spacing, 0, 0, 0], "box")
    assert particles.N == len(expected["id"]), "particles"
    position = in_plane(particles.position)
    assert (abs(position) <= size / 2 + 1e-4).all(), "a particle is outside of the box"
    middle = size / 2 - np.array([PITCH / 2, 0.5]) * run.spacing
    expected = on_found_side(run, expected, (position + middle)[:, 0])
    same(position, expected["centre"] - middle, "position")
    same(particles.typeid, expected["kind"], "typeid")
    same(in_plane(particles.velocity), expected["velocity"], "velocity")
    same(np.reshape(particles.image, (-1, 3))[:, 0], expected["image"], "image")
    same(found.log["particles/id"], expected["id"], "id")
    same(in_plane(found.log["particles/displacement"]), expected["displacement"], "displacement")
    same(found.log["particles/force"], expected["force"], "force")
    assert ("particles/angular_velocity" in found.log) == run.is_contact
    if run.is_contact:
        same(found.log["particles/angular_velocity"], expected["spin"], "angular velocity")
    same(particles.mass, expected["mass"], "mass")
    same(particles.diameter, expected["diameter"], "diameter")
    check_bonds(run, found, expected)
    names = [name.split("@")[0] for name in particles.types]
    assert names == [run.species[species] for species in run.kind_species], names
    assert len(particles.type_shapes) == len(run.kinds)
    for shape, parts in zip(particles.type_shapes, run.kinds):
        assert shape["type"] == "Polygon" and shape["rounding_radius"] == 0
        same(polygon_area(shape["vertices"]), body_area(parts) * run.spacing**2, "area of a type")
        sites = run.spacing * place(sites_from((0, 0), parts))
        for site in sites - sites.mean(axis=0):
            assert inside(shape["vertices"], site), "a site is outside of its type"


def check_bonds(run, found, expected):
    pairs = [contact for contact in expected.get("contacts", []) if contact["other"] >= 0]
    assert found.bonds.N == len(pairs), "bonds"
    if pairs:
        assert found.bonds.types == ["contact"]
        ids = [(contact["upper"], contact["other"]) for contact in pairs]
        same(found.log["bonds/id"], ids, "ids of bonds")
        same(expected["id"][found.bonds.group], ids, "particles of bonds")
        same(in_plane(found.log["bonds/force"]), [contact["force"] for contact in pairs], "force of bonds")
        for name in ("normal_force", "tangential_force"):
            same(found.log[f"bonds/{name}"], [contact[name] for contact in pairs], name)


def check_xyz(run, file):
    lines = iter(Path(file).read_text().splitlines())
    for expected in run.frames:
        count = int(next(lines))
        comment = dict(word.split("=", 1) for word in shlex.split(next(lines)))
        properties = "species:S:1:pos:R:3:id:I:1:velo:R:3:displacement:R:3:load:R:1:mass:R:1:radius:R:1"
        assert comment["Properties"] == properties + ":angular_velocity:R:1" * run.is_contact
        assert int(comment["Step"]) == expected["step"]
        same(float(comment["Time"]), expected["step"] * run.time_step, "time", 1e-9)
        assert comment["pbc"] == ("T F F" if run.periodic else "F F F")
        same(comment["Lattice"].split(), [run.period, 0, 0, 0, run.height, 0, 0, 0, run.spacing], "Lattice")
        same(comment["Origin"].split(), run.spacing * np.array([-PITCH / 2, -0.5, -0.5]), "Origin")
        assert count == len(expected["id"]), "particles"
        table = [next(lines).split() for _ in range(count)]
        species = [run.species[run.kind_species[kind]] for kind in expected["kind"]]
        assert [row[0] for row in table] == species, "species"
        numbers = np.array([row[1:] for row in table], dtype=float).reshape(count, 13 + run.is_contact)
        position = in_plane(numbers[:, 0:3])
        same(position, on_found_side(run, expected, position[:, 0])["centre"], "pos")
        same(numbers[:, 3], expected["id"], "id")
        same(in_plane(numbers[:, 4:7]), expected["velocity"], "velo")
        same(in_plane(numbers[:, 7:10]), expected["displacement"], "displacement")
        same(numbers[:, 10], expected["force"], "force")
        same(numbers[:, 11], expected["mass"], "mass")
        same(numbers[:, 12], expected["diameter"] / 2, "radius")
        if run.is_contact:
            same(numbers[:, 13], expected["spin"], "angular velocity")
    assert next(lines, None) is None, "more frames than there are"


def read_polygons(file):
    reader = vtkXMLPolyDataReader()
    assert reader.CanReadFile(str(file)), f"{file} is no file of VTK"
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    points = vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.empty((0, 3))
    polygons = []
    for cell in range(data.GetNumberOfCells()):
        ids = data.GetCell(cell).GetPointIds()
        polygons.append(points[[ids.GetId(i) for i in range(ids.GetNumberOfIds())]])
    return data, polygons


def texts(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def check_vtp(run, file):
    datasets = [entry.attrib for entry in xml.parse(file).getroot().iter("DataSet")]
    particles = [entry for entry in datasets if entry["part"] == "0"]
    assert len(particles) == len(run.frames), "number of frames"
    times = [float(entry["timestep"]) for entry in particles]
    same(times, [frame["step"] * run.time_step for frame in run.frames], "times", 1e-9)
    for entry, expected in zip(particles, run.frames):
        check_vtp_particles(run, Path(file).parent / entry["file"], expected)
    walls = [entry for entry in datasets if entry["part"] == "1"]
    assert len(walls) == (len(run.frames) if run.walls else 0)
    assert [entry["timestep"] for entry in walls] in ([], [entry["timestep"] for entry in particles])
    for entry, expected in zip(walls, run.frames):
        check_vtp_walls(run, Path(file).parent / entry["file"], expected)
    beside = Path(file).with_name(Path(file).stem + "-contacts.pvd")
    assert beside.exists() == run.has_contacts
    if run.has_contacts:
        contacts = [entry.attrib for entry in xml.parse(beside).getroot().iter("DataSet")]
        assert [entry["timestep"] for entry in contacts] == [entry["timestep"] for entry in particles]
        for entry, expected in zip(contacts, run.frames):
            check_vtp_contacts(Path(file).parent / entry["file"], expected["contacts"])


def check_vtp_particles(run, file, expected):
    data, polygons = read_polygons(file)
    assert len(polygons) == len(expected["id"]), "particles"
    assert texts(data, "species_names") == run.species
    column = lambda name: vtk_to_numpy(data.GetCellData().GetArray(name))
    if not polygons:
        return
    same(column("id"), expected["id"], "id")
    same(column("species"), run.kind_species[expected["kind"]], "species")
    same(in_plane(column("velocity")), expected["velocity"], "velocity")
    same(in_plane(column("displacement")), expected["displacement"], "displacement")
    for name in ("force", "mass", "diameter"):
        same(column(name), expected[name], name)
    assert bool(data.GetCellData().HasArray("angular_velocity")) == run.is_contact
    if run.is_contact:
        same(column("angular_velocity"), expected["spin"], "angular velocity")
    expected = on_found_side(run, expected, np.array([polygon[:, 0].mean() for polygon in polygons]))
    for polygon, kind, sites in zip(polygons, expected["kind"], expected["sites"]):
        same(
            polygon_area(in_plane(polygon)),
            body_area(run.kinds[kind]) * run.spacing**2,
            "area of a particle",
            1e-3 * run.spacing**2,
        )
        assert all(inside(polygon, site) for site in sites), "a site is outside of its particle"


def check_vtp_contacts(file, expected):
    data, lines = read_polygons(file)
    assert len(lines) == len(expected), "contacts"
    column = lambda name: vtk_to_numpy(data.GetCellData().GetArray(name))
    if not lines:
        return
    same([in_plane(line) for line in lines], [contact["line"] for contact in expected], "lines")
    for name in ("upper", "other"):
        assert column(name).tolist() == [contact[name] for contact in expected], name
    same(in_plane(column("force")), [contact["force"] for contact in expected], "force of contacts")
    for name in ("normal_force", "tangential_force"):
        same(column(name), [contact[name] for contact in expected], name)


def check_vtp_walls(run, file, expected):
    data, polygons = read_polygons(file)
    numbers = vtk_to_numpy(data.GetCellData().GetArray("wall")) if polygons else np.empty(0)
    assert set(numbers) == {wall for wall, sites in expected["walls"].items() if len(sites)}, "walls"
    for wall, sites in expected["walls"].items():
        axial = np.stack([sites[:, 0], sites[:, 1] - (sites[:, 0] >> 1)], axis=1)
        area = sum(polygon_area(polygon) for polygon, n in zip(polygons, numbers) if n == wall)
        same(area, body_area(axial) * run.spacing**2, "area of a wall", 1e-2 * run.spacing**2)


def check_h5md(run, file):
    """What version 1.1 of the specification requires, and the numbers."""
    with h5py.File(file, "r") as h5:
        assert h5["h5md"].attrs["version"].tolist() == [1, 1]
        assert h5["h5md/author"].attrs["name"] and h5["h5md/creator"].attrs["version"]
        assert h5["h5md/creator"].attrs["name"] == b"clca"
        grains = h5["particles/grains"]
        assert grains["box"].attrs["dimension"] == 3
        boundary = [b"periodic" if run.periodic else b"none", b"none", b"none"]
        assert grains["box"].attrs["boundary"].tolist() == boundary
        steps = [frame["step"] for frame in run.frames]
        elements = [
            grains[name] for name in (*grains, "box/edges") if name not in ("box", "diameter", "mass", "species")
        ]
        assert len(elements) == 6 + run.periodic + run.is_contact
        for element in elements:
            assert element["value"].shape[0] == len(steps)
            for shared in ("step", "time"):
                assert element[shared] == grains["position"][shared], f"{element.name}: another {shared}"
        assert np.issubdtype(grains["position/step"].dtype, np.integer)
        assert grains["position/step"][:].tolist() == steps
        same(grains["position/time"], np.array(steps) * run.time_step, "time", 1e-9)
        same(grains["box/edges/value"], [[run.period, run.height, run.spacing]] * len(steps), "edges")
        assert grains["id/value"].fillvalue == -1
        for number, expected in enumerate(run.frames):
            check_h5md_frame(run, {e.name.split("/")[3]: e["value"][number] for e in elements}, expected)
        names = {number: name for name, number in h5py.check_enum_dtype(grains["species"].dtype).items()}
        for expected in run.frames:
            found = [names[number] for number in grains["species"][:][expected["id"]]]
            assert found == [run.species[run.kind_species[kind]] for kind in expected["kind"]]
            for name in ("mass", "diameter"):
                same(grains[name][:][expected["id"]], expected[name], name)
        check_descriptions(h5)


def check_h5md_frame(run, found, expected):
    there = found["id"] != -1
    assert np.flatnonzero(there).tolist() == found["id"][there].tolist() == expected["id"].tolist(), "id"
    assert np.isnan(found["position"][~there]).all()
    position = in_plane(found["position"][there])
    expected = on_found_side(run, expected, position[:, 0])
    same(position, expected["centre"], "position")
    for name in ("velocity", "displacement"):
        same(in_plane(found[name][there]), expected[name], name)
    same(found["load"][there], expected["force"], "load")
    if run.is_contact:
        same(found["angular_velocity"][there], expected["spin"], "angular velocity")
    if run.periodic:
        same(in_plane(found["image"][there])[:, 0], expected["image"], "image")


def check_descriptions(h5):
    def check(name, item):
        if isinstance(item, h5py.Dataset):
            assert item.attrs["units"] and item.attrs["description"], f"{name} does not say what it is"

    h5.visititems(check)


CHECKS = {"gsd": check_gsd, "vtp": check_vtp, "xyz": check_xyz, "h5md": check_h5md}
