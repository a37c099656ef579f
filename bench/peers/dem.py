"""A scene by discrete elements (LAMMPS): grains where the scene of clca puts them, one run, its numbers.

Lengths are lattice spacings, gravity 1, masses areas. README.md says what the parameters are.
"""
import dataclasses
import math
import os
import pathlib
import random
import shutil
import subprocess

import h5py
import numpy as np

from beds import COLUMN, FLOOR, LEFT

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
STIFFNESS = 2e4  # m g / d of the small discs
TANGENTIAL, ROLLING = 2 / 7, 0.3  # stiffness, over that along the normal
RESTITUTION = 0.4
FRICTION, ROLLING_FRICTION = 0.4, 0.5
STEPS = 20  # in the time that two small discs touch
# At rest: kinetic energy per grain below this many m g d (means of mass and diameter), at so many checks in a row, so many times sqrt(d/g) apart.
REST, REST_CHECKS, REST_INTERVAL = 1e-6, 3, 0.5
ONE_THREAD = dict(os.environ, OMP_NUM_THREADS="1")


@dataclasses.dataclass(frozen=True)
class Case:
    """A scene of clca with what `--set` changes in it, and the deck that is run with its grains."""

    name: str
    scene: str
    deck: str
    overrides: tuple  # with stages no longer than it takes until all grains are there
    numbers: object  # what is taken from a run, by quantity
    rolling: str = "resistance"
    friction: float = FRICTION
    rolling_friction: float = ROLLING_FRICTION
    restitution: float = RESTITUTION
    stiffness: float = STIFFNESS
    seeds: int = 4
    fall_height: float = 0  # of clca, where time counts: it sets the length of its step
    source: tuple = ()  # left, bottom, right, top of what emits the grains; else fills
    frame: float = 2.5  # time between frames
    most: float = 2000  # time until a bed counts as settled at the latest
    variables: dict = dataclasses.field(default_factory=dict)  # of its deck
    centre: tuple = (0, 0)  # of the coordinates of its deck

    @property
    def step(self):
        """Of clca."""
        return 0.4 / math.sqrt(2 * self.fall_height)


@dataclasses.dataclass(frozen=True)
class Grains:
    """Of a run of clca, in the order in which they appear."""

    radii: dict  # of the discs, by type: 1 small, 2 large
    types: np.ndarray
    places: np.ndarray
    steps: np.ndarray  # of the stage in which they appear
    stages: np.ndarray
    right: float  # face of the right side of the box

    @property
    def mass(self):
        """Mean of all grains."""
        return np.mean([math.pi * self.radii[kind] ** 2 for kind in self.types])

    @property
    def diameter(self):
        """Mean of both types."""
        return 2 * np.mean(list(self.radii.values()))


@dataclasses.dataclass
class Run:
    """What a deck has left."""

    case: Case
    grains: Grains
    folder: pathlib.Path
    variables: dict

    def frames(self, name):
        """Of a dump."""
        for part in (self.folder / name).read_text().split("ITEM: TIMESTEP\n")[1:]:
            head, _, rows = part.partition("ITEM: ATOMS")
            table = np.array([row.split() for row in rows.splitlines()[1:]], dtype=float).reshape(-1, 5)
            yield Frame(int(head.split()[0]) * self.variables["dt"], table[:, 0].astype(int), table[:, 1].astype(int), table[:, 2:4], table[:, 4])

    def frame(self, name):
        return next(self.frames(name))


@dataclasses.dataclass
class Frame:
    time: float
    ids: np.ndarray
    types: np.ndarray
    positions: np.ndarray
    radii: np.ndarray

    @property
    def discs(self):
        return [(x, y, radius) for (x, y), radius in zip(self.positions, self.radii)]

    @property
    def species(self):
        return np.where(self.types == 1, "small", "large")


def grains_of(clca, case, seed, folder):
    """Where and when the scene puts its grains."""
    command = [clca, "run", ROOT / "scenes" / f"{case.scene}.yaml", "-o", folder, "--quiet", "--threads", "1"]
    for override in ("output={trajectory: {every: 10}}", "measure=[]", *case.overrides, f"seed={seed}"):
        command += ["--set", override]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    with h5py.File(folder / "trajectory.h5") as file:
        columns = int(file["scene/lattice"][0])
        sizes, centres = file["scene/kinds/size"][:], file["scene/kinds/centre"][:]
        frames = {name: file[f"frames/{name}"][:] for name in ("step", "stage", "origins")}
        ids, sites = file["origins/id"][:], file["origins/site"][:]
        kinds = dict(zip(file["particles/id"][:], file["particles/kind"][:]))
    frame = np.repeat(np.arange(len(frames["step"])), frames["origins"])
    _, first = np.unique(ids, return_index=True)  # rows of the frame in which a grain appears
    kind = np.array([kinds[one] for one in ids[first]])
    column, row = sites[first].T
    begins = {stage: frames["step"][frames["stage"] == stage][0] for stage in set(frames["stage"])}
    stages = frames["stage"][frame[first]]
    return Grains(
        radii={kind: math.sqrt(size * COLUMN / math.pi) for kind, size in zip((1, 2), sorted(set(sizes)))},
        types=np.where(sizes[kind] == sizes.min(), 1, 2),
        places=np.stack([COLUMN * column, row + 0.5 * (column % 2)], axis=1) + centres[kind],
        steps=frames["step"][frame[first]] - [begins[stage] for stage in stages], stages=stages, right=LEFT + columns * COLUMN)


def apart(places, radii, right):
    """Hexagons that touch are discs that overlap, by up to 6 % of a diameter: moved off each other and off the sides."""
    reach = radii[:, None] + radii
    near = np.hypot(*(places[:, None] - places).transpose(2, 0, 1)) < reach + 2 * radii.min()
    one, other = np.nonzero(np.triu(near, 1))
    reach = reach[one, other]
    for _ in range(1000):
        ways = places[other] - places[one]
        distances = np.hypot(*ways.T)
        short = np.maximum(0, reach - distances)
        if short.max(initial=0) < 1e-6:
            break
        push = ways * (short / distances / 2)[:, None]
        np.add.at(places, other, push)
        np.add.at(places, one, -push)
        places[:, 0] = np.clip(places[:, 0], LEFT + radii, right - radii)
    return places


def write_grains(path, case, grains, seed, chosen, values):
    """Commands for those of a stage: all at once or, if a source emits them, each in its time.

    What is emitted begins anywhere within half a spacing to either side of its site, as in clca.
    """
    offset = random.Random(seed)
    radii = np.array([grains.radii[kind] for kind in grains.types])[chosen]
    places, now = grains.places[chosen], 0
    if not case.source:
        places = apart(places, radii, values["right"]) - case.centre
    with open(path, "w", encoding="utf-8") as file:
        for kind, radius, (x, y), step in zip(grains.types[chosen], radii, places, grains.steps[chosen]):
            if not case.source:
                file.write(f"create_atoms {kind} single {x:.9g} {y:.9g} 0 units box\n")
                continue
            at = f"{step * case.step / values['dt']:.0f}"
            file.write(f'if "$(step) < {at}" then "run {at} upto post no"\n' if step > now else "")
            now = step
            x = np.clip(x + offset.uniform(-0.5, 0.5), LEFT + radius, values["right"] - radius)
            file.write(f"variable type string {kind}\nvariable x string {x:.9g}\nvariable y string {y:.9g}\ninclude ${{decks}}/grain.lmp\n")
        file.write("include ${decks}/discs.lmp\n")


def variables(case, grains, seed):
    """What the decks leave open but for files."""
    small = grains.radii[1]
    mass = math.pi * small**2
    stiffness = case.stiffness * mass / (2 * small)
    dt = math.pi * math.sqrt(mass / 2 / stiffness) / STEPS
    low, high = grains.places.min(axis=0) - case.centre, grains.places.max(axis=0) - case.centre
    return {
        "decks": HERE / "decks", "space_left": min(0, low[0]) - 40, "space_right": max(grains.right, high[0]) + 40, "space_bottom": min(0, low[1]) - 60, "space_top": high[1] + 40,
        "radius1": small, "radius2": grains.radii[2], "skin": 0.3 * small,
        "stiffness": stiffness, "tangential": TANGENTIAL * stiffness, "damping": tsuji(case.restitution), "friction": case.friction,
        "rolling": case.rolling, "rolling_stiffness": ROLLING * stiffness, "rolling_friction": case.rolling_friction,
        "rolling_damping": ratio(case.restitution) * math.sqrt(mass / 2 * ROLLING * stiffness),
        "floor": FLOOR, "left": LEFT, "right": grains.right, "count": len(grains.types),
        "dt": dt, "check": max(1, round(REST_INTERVAL * math.sqrt(grains.diameter) / dt)), "frame": round(case.frame / dt),
        "rest_energy": REST * grains.mass * grains.diameter, "rest_checks": REST_CHECKS, "most": case.most, **case.variables,
        **(source_of(case, grains) if case.source else {}),
        "seed": seed, "short": max(1, round(0.05 * math.sqrt(grains.diameter) / dt))}


def source_of(case, grains):
    """Its region, as far as a disc of a type has room beside the sides."""
    left, bottom, right, top = map(float, case.source)
    return {"source_bottom": bottom, "source_top": top,
            **{f"source_left{kind}": max(left, LEFT + radius) for kind, radius in grains.radii.items()},
            **{f"source_right{kind}": min(right, grains.right - radius) for kind, radius in grains.radii.items()}}


def ratio(restitution):
    """Damping over half the critical one, of a spring and a dashpot that lose contact where they began it."""
    lost = -math.log(restitution)
    return 2 * lost / math.hypot(math.pi, lost)


def tsuji(restitution):
    """What LAMMPS has to be told: it takes the damping of a Hertzian contact for any (`damping tsuji`)."""
    def damping(e):
        return 1.2728 - 4.2783 * e + 11.087 * e**2 - 22.348 * e**3 + 27.467 * e**4 - 18.022 * e**5 + 4.8218 * e**6
    low, high = 0.0, 1.0
    while high - low > 1e-9:
        middle = (low + high) / 2
        low, high = (middle, high) if damping(middle) > ratio(restitution) else (low, middle)
    return low


def run(clca, case, seed, folder):
    """A run of a case, in a folder that it empties; its numbers."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    grains = grains_of(clca, case, seed, folder / "clca")
    values = variables(case, grains, seed)
    command = ["lmp", "-in", HERE / "decks" / f"{case.deck}.lmp", "-log", "none", "-screen", folder / "log", "-var", "out", folder]
    for number, stage in enumerate(sorted(set(grains.stages))):
        path = folder / f"grains-{number}"
        write_grains(path, case, grains, seed, grains.stages == stage, values)
        command += ["-var", "grains" if number == 0 else "refill", path]
    for name, value in values.items():
        command += ["-var", name, value if isinstance(value, (str, pathlib.Path)) else repr(float(value)) if isinstance(value, float) else str(value)]
    if subprocess.run(command, env=ONE_THREAD, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode != 0:
        raise SystemExit(f"{case.name} {seed}: " + "; ".join((folder / "log").read_text().splitlines()[-2:]))
    return case.numbers(Run(case, grains, folder, values)), values


def version():
    """Of LAMMPS."""
    said = subprocess.run(["lmp", "-h"], capture_output=True, text=True, check=True).stdout
    return next(line for line in said.splitlines() if "Simulator" in line or " - " in line).partition(" - ")[2]
