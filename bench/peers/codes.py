"""Runs of the wall-removal test: by clca, LAMMPS, LIGGGHTS and Box2D, with what they took."""
import dataclasses
import json
import math
import os
import pathlib
import subprocess
import time

import beds

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SCENE = ROOT / "scenes" / "wall-removal.yaml"
LEFT_MARGIN = -10
TICK = 1 / os.sysconf("SC_CLK_TCK")
STAGES = ("settling", "collapse")
ONE_THREAD = dict(os.environ, OMP_NUM_THREADS="1")

PROGRAMS = {"lammps": "lmp", "liggghts": "liggghts", "box2d": str(ROOT / "build/release/bench/clca_box2d")}
# What `clca run` has to set for each of its models.
MODELS = {
    "automaton": {},
    "contact": {"model": "contact"},
    "preview": {"model": "contact", "contact.resolution": 0.8, "contact.restitution": 0},
}
FRICTION = 0.4
ROLLING_FRICTION = {"none": 0, "resistance": 0.5}
# At rest: kinetic energy per particle below this many m g d (means of mass and diameter), at so many
# checks in a row, so many times sqrt(d/g) apart.
REST = 1e-6
REST_CHECKS = 3
REST_INTERVAL = 0.5


@dataclasses.dataclass(frozen=True)
class Setting:
    """Of a contact."""

    stiffness: float  # of the spring, over the weight of the bed per unit of width
    steps: float  # in the time that two small discs touch
    damping: float  # of two small discs, over the critical one
    skin: float  # of neighbour lists, spacings


@dataclasses.dataclass
class Outcome:
    """Of one run; seconds and steps by stage, those that were begun."""

    finished: bool = True
    wall: dict = dataclasses.field(default_factory=dict)
    cpu: dict = dataclasses.field(default_factory=dict)
    steps: dict = dataclasses.field(default_factory=dict)
    process_wall: float = 0.0
    process_cpu: float = 0.0
    heights: list = None
    runout: float = None
    overlap: float = None  # that 99 of 100 contacts of the settled bed stay below


def timed(command):
    """Wall and processor seconds of a command that has to succeed."""
    begin = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=ONE_THREAD)
    said = process.stderr.read()  # warnings, the same each time
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"run: {' '.join(map(str, command))} has failed: {said}")
    return time.monotonic() - begin, usage.ru_utime + usage.ru_stime


def clca_command(clca, folder, overrides):
    command = [clca, "run", SCENE, "-o", folder, "--quiet", "--threads", "1"]
    for key, value in overrides.items():
        command += ["--set", f"{key}={value}"]
    return command


def export_rain(clca, geometry, seed, folder):
    """The fill of the scene as a file for read_data; its path."""
    overrides = geometry.overrides(seed) | {
        "output": "{trajectory: {every: 1000000}}", "measure": "[]",
        "stages.packing.until.steps": 1, "stages.flow.until.steps": 1}
    timed(clca_command(clca, folder / "rain", overrides))
    timed([clca, "export", folder / "rain", "--format", "xyz", "-o", folder / "rain.xyz", "--to", "0"])
    lines = (folder / "rain.xyz").read_text().splitlines()
    count = int(lines[0])
    top = 2 * 460 * geometry.scale
    with open(folder / "rain.data", "w") as file:
        file.write(f"The fill of {SCENE.name}, seed {seed}\n\n{count} atoms\n2 atom types\n\n"
                   f"{LEFT_MARGIN} {300 * geometry.scale} xlo xhi\n{LEFT_MARGIN} {top} ylo yhi\n"
                   "-3 3 zlo zhi\n\nAtoms\n\n")
        for line in lines[2:2 + count]:
            name, x, y, _, number = line.split()[:5]
            kind = list(beds.SITES).index(name) + 1
            file.write(f"{int(number) + 1} {kind} {2 * beds.RADII[name]:.9f} 1 {x} {y} 0\n")
    return folder / "rain.data"


def can(code, rolling):
    """Whether a code or a model of clca has this kind of rolling."""
    return rolling == "none" or code in ("lammps", "contact", "preview")


def run_clca(clca, model, rolling, geometry, seed, folder, for_seconds):
    """Best of as many runs as go into `for_seconds`, at least three, with nothing written or measured.

    Wall seconds are the program's own, of its steps. Processor seconds are those of the process less
    those of one that does a step of each stage; on a busy machine they are the ones to trust.
    """
    bare = geometry.overrides(seed) | MODELS[model] | {"output": "{checkpoint: none}", "measure": "[]"}
    if model != "automaton":
        bare["contact.rolling"] = rolling
    settling = bare | {"stages.flow.until.steps": 1}
    variants = {"whole": bare, "settling": settling, "none": settling | {"stages.packing.until.steps": 1}}
    steps, walls, cpus = ({name: [] for name in variants} for _ in range(3))
    begin = time.monotonic()
    while len(walls["whole"]) < 3 or time.monotonic() - begin < for_seconds:
        for name, overrides in variants.items():
            wall, cpu = timed(clca_command(clca, folder / "clca", overrides))
            walls[name].append(wall)
            cpus[name].append(cpu)
            steps[name].append(json.loads((folder / "clca" / "run.json").read_text())["step_seconds"])
    steps, walls, cpus = ({name: min(values) for name, values in one.items()} for one in (steps, walls, cpus))
    timed(clca_command(clca, folder / "clca", bare | {"measure": "[profile, runout]"}))
    last = json.loads((folder / "clca" / "run.json").read_text())
    rows = (folder / "clca" / "profile-flow.csv").read_text().splitlines()
    return Outcome(
        wall={"settling": steps["settling"], "collapse": steps["whole"] - steps["settling"]},
        cpu={"settling": cpus["settling"] - cpus["none"], "collapse": cpus["whole"] - cpus["settling"]},
        steps={stage: one["steps"] for stage, one in zip(STAGES, last["stages"])},
        process_wall=walls["whole"], process_cpu=cpus["whole"],
        heights=[float(row.split(",")[2]) for row in rows[1:]],
        runout=last["stages"][-1]["measures"]["runout_99"])


def variables(geometry, setting, rolling):
    """What the decks leave open but for files."""
    stiffness = setting.stiffness * geometry.weight
    mass = math.pi * beds.RADII["small"] ** 2 / 2  # effective, of two small discs
    frequency = math.sqrt(stiffness / mass)
    damping = 2 * setting.damping * frequency
    step = math.pi / frequency / setting.steps
    diameter = beds.mean_diameter()
    return {
        "stiffness": stiffness, "tangential": 2 / 7 * stiffness,
        "damping": damping, "slight_damping": damping / 20, "friction": FRICTION,
        "rolling_friction": ROLLING_FRICTION[rolling], "rolling_damping": damping / 2 * mass,
        "floor": beds.FLOOR, "left": beds.LEFT, "wall": geometry.wall,
        "dt": step, "skin": setting.skin,
        "check": max(1, round(REST_INTERVAL * math.sqrt(diameter) / step)),
        "rest_energy": REST * beds.mean_mass() * diameter, "rest_checks": REST_CHECKS}


def cpu_seconds(pid):
    """User and system time of a process that is alive."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) * TICK


def peer_command(code, geometry, setting, rolling, rain, folder):
    if code == "box2d":
        numbers = (beds.FLOOR, beds.LEFT, geometry.wall, FRICTION, beds.mean_diameter(),
                   REST * beds.mean_mass() * beds.mean_diameter(), REST_CHECKS)
        return [PROGRAMS[code], rain, folder / code, *map(str, numbers)]
    command = ["stdbuf", "-oL", PROGRAMS[code], "-in", HERE / f"in.{code}", "-log", "none"]
    for name, value in variables(geometry, setting, rolling).items():
        command += ["-var", name, repr(value)]
    return command + ["-var", "rain", rain, "-var", "out", folder / code]


def run_peer(code, geometry, setting, rolling, rain, folder, most_seconds):
    """Both stages until they are at rest, or until they have taken `most_seconds` of processor time."""
    command = peer_command(code, geometry, setting, rolling, rain, folder)
    begin = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=ONE_THREAD)
    outcome = follow(process, most_seconds)
    outcome.process_wall = time.monotonic() - begin
    if outcome.finished:
        start, end = (read_dump(folder / f"{code}.{stage}") for stage in STAGES)
        outcome.heights = beds.profile(end, 300 * geometry.scale)
        outcome.runout = beds.runout_99(start, end)
        found = beds.overlaps(start)
        outcome.overlap = found[int(0.99 * len(found))]
    return outcome


def follow(process, most_seconds):
    """Reads what a peer prints at the beginning and end of a stage; kills it after `most_seconds` of processor time."""
    outcome = Outcome()
    stage, last = None, ""
    for line in process.stdout:
        now, cpu = time.monotonic(), cpu_seconds(process.pid)
        words = line.split()
        last = line.strip() or last
        if words[:1] == ["begin"]:
            stage, wall_begin, cpu_begin = words[1], now, cpu
        elif words[:1] == ["ERROR:"] or words[:1] == ["ERROR"]:
            break
        if stage and stage not in outcome.steps:
            outcome.wall[stage], outcome.cpu[stage] = now - wall_begin, cpu - cpu_begin
        if words[:1] == ["end"]:
            outcome.steps[stage] = int(words[2]) - sum(outcome.steps.values())
        if cpu > most_seconds and "collapse" not in outcome.steps:
            outcome.finished = False
            process.kill()
            break
    process.stdout.close()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    outcome.process_cpu = usage.ru_utime + usage.ru_stime
    if outcome.finished and (process.returncode != 0 or "collapse" not in outcome.steps):
        raise SystemExit(f"run: {process.args[2]} has failed: {last}")
    return outcome


def read_dump(path):
    """The discs of the last frame of a dump of id, x, y, radius."""
    rows = path.read_text().rpartition("ITEM: ATOMS")[2].splitlines()[1:]
    return [tuple(map(float, row.split()[1:4])) for row in rows]
