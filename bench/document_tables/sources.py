"""What is taken from a run of the contact model for a table, by name. A function of a scene returns these numbers; one that needs more than the run
returns such a function. Angles are in degrees."""

import math

import numpy as np

DIAMETER = 8.2  # mean of hexagons of radius 3 and 5
PROFILE = np.arange(5, 126) / 50  # x/L0 at which profiles are compared with those of discrete elements
SPACING = 0.25e-3  # of silo-beverloo, metres
MASS = {1: {"small": 7, "large": 19}, 3: {"small": 37, "large": 91}}  # of the species in sites, by the radius of small hexagons


def masses(frame, small):
    return np.where(frame.species == "small", MASS[small]["small"], MASS[small]["large"])


def turned(places, degrees):
    """Anticlockwise."""
    x, y = places.T
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=1)


def of_stage(run, name):
    return [frame for frame in run.frames if frame.stage == name]


def angles(run, frames):
    """Of the vessel in frames."""
    return np.interp([frame.step for frame in frames], run.series["step"], np.unwrap(run.series["vessel_angle_deg"], period=360))


def slope(places, width, half):
    """Of a straight line through the highest of places in strips from -half to half."""
    places = places[abs(places[:, 0]) < half]
    strips = np.floor((places[:, 0] + half) / width)
    highest = np.array([max(places[strips == strip], key=lambda place: place[1]) for strip in np.unique(strips)])
    return math.degrees(math.atan(np.polyfit(*highest.T, 1)[0]))


def sites(radius):
    """Of a hexagon."""
    return 3 * radius * (radius + 1) + 1


def mean_diameter(radii):
    """Of as many hexagons of each radius, by the discs of their areas."""
    return np.mean([math.sqrt(sites(radius) * math.sqrt(12) / math.pi) for radius in radii])


def deposit(width):
    """Of a column so wide that has collapsed."""
    def numbers(run):
        packing, flow = run.measures["packing"], run.measures["flow"]
        end, profile, series = run.frames[-1], run.table("profile-flow"), run.series[run.series["stage"] == "flow"]
        height = packing["height_mean"]
        times = (series["time"] - series["time"][0]) / math.sqrt(2 * height)
        energy = series["kinetic_energy"]
        return {"H0/L0": height / width, "run-out": flow["runout_99"] / width, "slope": flow["repose_right_deg"], "moved": flow["moved_share"],
                "packing": packing["packing_fraction"], "growth of rain": 100 * packing["energy_growth"], "growth": 100 * flow["energy_growth"],
                "steps": run.stages["flow"].steps, "shift": np.average(end.displacements[:, 0], weights=masses(end, 1)) / width,
                "slow after": times[energy > max(energy) / 100][-1], "last move": times[series["moving"] > 0][-1],
                **{at: np.interp(at * width, profile["x"], profile["height_end"]) / width for at in (0.1, 0.5, 1, 1.5, 2, 2.5, 3)},
                "profile": np.interp(PROFILE * width, profile["x"], profile["height_end"]) / width}
    return numbers


def not_stopped(width):
    """What counts where grains roll on until the box ends."""
    def numbers(run):
        all_numbers = deposit(width)(run)
        return {key: all_numbers[key] for key in ("H0/L0", "moved", "packing")}
    return numbers


def later_moves(run):
    """Whether a grain has moved in these stages."""
    return {stage: bool((run.series["moving"][run.series["stage"] == stage] > 0).any()) for stage in ("bed", "heap")}


def outflow_unit(radii=(3, 5)):
    """m sqrt(g / d) in sites a second, m the mean mass."""
    return np.mean([sites(radius) for radius in radii]) * math.sqrt(9.81 / (mean_diameter(radii) * SPACING))


def outflow(radii=(3, 5)):
    """Of a silo, unless it has clogged."""
    def numbers(run):
        discharge = run.measures["discharge"]
        clogged = bool(discharge["clogged"])
        return {"clogged": clogged, **({} if clogged else {"outflow": discharge["outflow_sites_per_time"] / outflow_unit(radii)})}
    return numbers


def clogging(run):
    """How many grains have left and whether the orifice clogged then; this of those runs that could."""
    discharge = run.measures["discharge"]
    clogged = bool(discharge["clogged"])
    return {"clogged": clogged, "left": (discharge["discharged"], clogged)}


def outflow_by_height(run):
    """While the surface is within 4 d of so many d above the orifice. Surface: mean of the highest centres in strips 2 d wide, and half a d."""
    frames = of_stage(run, "discharge")
    heights = []
    for frame in frames:
        x, y = frame.positions.T
        highest = np.zeros(20)
        np.maximum.at(highest, np.minimum((x / 16.4).astype(int), 19), y)
        heights.append((highest.mean() - 64) / DIAMETER + 0.5)
    heights, times = np.array(heights), np.array([frame.time for frame in frames])
    out = np.interp(times, run.series["time"], run.series["discharged_sites"])
    numbers = {}
    for height in (14, 25, 37, 43, 54, 62, 74, 98, 110):
        near = abs(heights - height) < 4
        if heights.min() < height - 3 and heights.max() > height + 3:
            numbers[height] = np.polyfit(times[near], out[near], 1)[0] / outflow_unit()
    return numbers


def silo(diameters):
    """With an orifice of so many d."""
    def numbers(run):
        table = run.table("lines-discharge")
        line = table[(table["line"] == "orifice") & (abs(table["x"] - 164) < diameters * DIAMETER / 8)]
        speed = np.average(line["v_across"], weights=line["particles"])
        return {**outflow()(run), "speed": abs(speed), "by fall": abs(speed) / math.sqrt(9.81 * diameters * DIAMETER * SPACING),
                "filling": np.mean(line["filling"])}
    return numbers


def weight(run):
    """On floor and sides, of the weight of all grains; stress across over stress down, of the whole bed; its height in d."""
    walls = {row["wall"]: row for row in run.table("walls-rest")}
    sides = [walls["box.left"], walls["box.right"]]
    stress, packing = run.table("stress-rest"), run.measures["rest"]["packing_fraction"]
    return {"floor": run.measures["rest"]["load_floor"], "steps": run.stages["filling"].steps,
            "friction": abs(sum(side["force_y"] for side in sides)) / (0.4 * sum(abs(side["force_x"]) for side in sides)),
            "K": stress["xx"].sum() / stress["yy"].sum(), "height": run.particles * 64 * math.sqrt(0.75) / (packing * 328 * DIAMETER)}


def load(run):
    """On the floor, of the weight of all grains."""
    return {"floor": run.measures["rest"]["load_floor"]}


def balance(run):
    """Of forces and weight: of the bed, and of a grain, mean."""
    walls = {row["wall"]: row["force_y"] for row in run.table("walls-rest")}
    carried = -sum(walls[f"box.{side}"] for side in ("floor", "left", "right"))
    return {**load(run), "carried": carried / run.particles, "residual": run.table("loads-rest")["residual"].mean()}


def load_in_time(run):
    """The same by thousands of steps after the bed had settled."""
    rest = run.series[run.series["stage"] == "rest"]
    share = -rest["force_y.box.floor"] / (rest["particles"] * 64)
    return {5: share[5], 35: share[35], "growth": share[35] - share[5]}


def plate(run):
    return {stage: next(row["force_y"] for row in run.table(f"walls-{stage}") if row["wall"] == "plate")
            for stage in ("half", "one", "two", "three", "four", "five")}


def in_drum(frame, angle):
    """Places from the middle of the drum, masses, centre of mass, its direction, and the slope of the surface between half the radius to either side."""
    places, mass = turned(frame.positions - 83, angle), masses(frame, 1)
    middle = np.average(places, axis=0, weights=mass)
    surface = direction = math.degrees(math.atan2(middle[0], -middle[1]))
    for _ in range(5):
        surface += slope(turned(places, -surface), 5, 40)
    return places, mass, middle, direction, surface


def drum(run):
    """After half a turn; and by turns the share of small grains within a quarter of the radius from the centre of mass."""
    frames, shots = of_stage(run, "turn"), []
    for frame, angle in zip(frames, angles(run, frames)):
        places, mass, middle, direction, surface = in_drum(frame, angle)
        core = mass[np.hypot(*(places - middle).T) < 20]
        shots.append((angle / 360, surface, direction, core[core == MASS[1]["small"]].sum() / core.sum()))
    turns, surface, direction, core = np.array(shots).T
    late = turns > 0.5
    return {"surface": surface[late].mean(), "centre": direction[late].mean(), "least": direction[late].min(), "most": direction[late].max(),
            "in time": direction[late].std(), **{at: core[abs(turns - at) <= 0.05].mean() for at in (0.05, 0.5, 1, 1.5, 1.95)}}


def standing_drum(run):
    frame = run.frames[-1]
    *_, direction, surface = in_drum(frame, *angles(run, [frame]))
    return {"surface": surface, "centre": direction}


def standing_box(run):
    """Slope of the surface against the level, over the middle 60 % of its width."""
    frame = run.frames[-1]
    places = turned(frame.positions, *angles(run, [frame]))
    left, right = places[:, 0].min(), places[:, 0].max()
    return {"surface": slope(places - ((left + right) / 2, 0), 10, 0.3 * (right - left))}


def tilted(run):
    """Tilt when a share of the grains has moved by a diameter, and slopes of the surface before and after."""
    frames, shots = of_stage(run, "tilt"), []
    tilt = angles(run, frames)
    for frame in frames:
        tops = np.array([max(outline, key=lambda corner: corner[1]) for outline in frame.outlines]) - (130, 0)
        shots.append((np.mean(np.hypot(*frame.displacements.T) > DIAMETER), slope(tops, 10, 0.3 * 260)))
    moved, surface = np.array(shots).T
    surface = abs(surface + tilt)
    failure = {share: tilt[np.argmax(moved >= share)] for share in (0.05, 0.1, 0.2)}
    return {**failure, "before": surface[tilt <= failure[0.1]].max(),
            "after": surface[(tilt >= failure[0.1]) & (tilt <= failure[0.1] + 3)].min(), "rest": surface[-1]}


def chute(run):
    """The layer ends at the highest part of the line that is filled half as much as the middle."""
    line = run.table("lines-flow")
    last = np.flatnonzero(line["filling"] > np.median(line["filling"][5:15]) / 2)[-1]
    line = line[:last + 1]
    y, speed = line["position"], line["v_across"]
    inner = slice(4, -4)
    if abs(speed[-1]) < 0.05:
        return {"surface": 0.0}
    power = np.polyfit(np.log(1 - y[inner] / (y[-1] + 1)), np.log(1 - speed[inner] / speed[-1]), 1)[0]
    return {"surface": speed[-1], "mean": np.average(speed, weights=line["filling"]), "n": power, "filling": line["filling"][inner].mean(),
            "depth": y[-1] + 1, "slip": speed[3] / speed[-1]}


def chute_of_test(run):
    """As tests/physics/contact_chute_test.cpp: the line ends 60 above the bed."""
    line = run.table("lines-flow")[:30]
    y, speed = line["position"], line["v_across"]
    inner = slice(4, -4)
    return {"surface": speed[-1], "n": np.polyfit(np.log(1 - y[inner] / y[-1]), np.log(1 - speed[inner] / speed[-1]), 1)[0]}


def heap(run):
    """Its flanks, where they are straight enough to have a slope."""
    slopes = {side: run.measures["pouring"][f"repose_{side}_deg"] for side in ("left", "right", "angle")}
    return {side: slope for side, slope in slopes.items() if not math.isnan(slope)}


def nut(run):
    table = run.table("cycles")
    table = table[table["stage"] == "shaking"]
    height = dict(zip(table["cycle"].astype(int), table["intruder_height_rel"]))
    up = [cycle for cycle, at in height.items() if at >= 1]
    return {**{cycle: height[cycle] for cycle in (100, 200, 300)}, "top": bool(up), "packing": run.measures["shaking"]["packing_fraction"],
            **({"until": float(up[0])} if up else {})}


def rise(run, low, high):
    """In d a cycle, mean over the cells with centres from a height on: of the middle third, and within 2 d of either side."""
    cells = run.table("convection-shaking")
    cells = cells[(cells["y"] >= low) & (cells["y"] <= high)]
    from_middle = abs(cells["x"] - 101)
    return [np.average(cells["dy"][part], weights=cells["weight"][part]) / DIAMETER
            for part in (from_middle < 202 / 6, from_middle > 101 - 2 * DIAMETER)]


def convection(run):
    """Rise inside less that at the walls: in the bed below the surface, and of all cells."""
    inside, wall = rise(run, 0, 112)
    return {"bed": inside - wall, "all": run.measures["shaking"]["convection_centre_minus_wall"] / DIAMETER}


def convection_at(height):
    """The same by height, in rows of cells 16 high."""
    def numbers(run):
        return dict(zip(("inside", "wall"), rise(run, height - 8, height + 8)))
    return numbers


def of_rotation(frames, small, fast, far, spacing=1.0):
    """Sums over states, of the grains that are there in all of them; spins: angular velocity times radius. Grains faster than `fast` spacings a step
    move; paths are those of grains that get farther than `far`. `spacing`: in the unit of lengths of velocities."""
    ids = np.array(sorted(set.intersection(*(set(frame.ids.tolist()) for frame in frames))))
    rows = [np.searchsorted(frame.ids, ids) for frame in frames]
    mass = masses(frames[0], small)[rows[0]]
    radius = np.sqrt(mass * math.sqrt(0.75) / math.pi)  # of discs of the same area
    velocities = [frame.velocities[row] / spacing for frame, row in zip(frames, rows)]
    spins = [frame.angular_velocities[row] * radius for frame, row in zip(frames, rows)]
    energies = [(mass @ (velocity ** 2).sum(axis=1), mass @ spin ** 2 / 2) for velocity, spin in zip(velocities, spins)]
    fast *= frames[-1].step / frames[-1].time
    sums = dict.fromkeys(("rotation", "kinetic", "spin", "signed", "speed", "pairs", "opposite", "product", "squares", "slip", "bare", "holding"),
                         0.0)
    path, turn, net = np.zeros((3, len(mass)))
    strongest = max(sum(energy) for energy in energies)
    for frame, velocity, spin, energy in zip(frames, velocities, spins, energies):
        if sum(energy) < strongest / 100:
            continue
        sums["rotation"] += energy[1]
        sums["kinetic"] += sum(energy)
        speed = np.hypot(*velocity.T)
        moving = speed > fast
        sums["spin"] += abs(spin[moving]).sum()
        sums["signed"] += spin[moving].sum()
        sums["speed"] += speed[moving].sum()
        contacts = frame.contacts
        contacts = contacts[np.isin(contacts["upper"], ids) & np.isin(contacts["other"], ids) & (contacts["force"][:, 0] > 0)]
        upper, other = (np.searchsorted(ids, contacts[body]) for body in ("upper", "other"))
        both = moving[upper] & moving[other]
        contacts, upper, other = contacts[both], upper[both], other[both]
        tangent = np.stack([-contacts["normal"][:, 1], contacts["normal"][:, 0]], axis=1)
        bare = ((velocity[upper] - velocity[other]) * tangent).sum(axis=1)
        sums["pairs"] += len(contacts)
        sums["opposite"] += (spin[upper] * spin[other] < 0).sum()
        sums["product"] += (spin[upper] * spin[other]).sum()
        sums["squares"] += (spin[upper] ** 2 + spin[other] ** 2).sum() / 2
        sums["bare"] += abs(bare).sum()
        sums["slip"] += abs(bare - spin[upper] - spin[other]).sum()
        sums["holding"] += (abs(contacts["force"][:, 1]) < 0.99 * 0.4 * contacts["force"][:, 0]).sum()
    places = [frame.displacements[row] for frame, row in zip(frames, rows)]
    for before, frame, place, later, spin in zip(frames, frames[1:], places, places[1:], spins):
        rolled = spin * (frame.time - before.time)
        path += np.hypot(*(later - place).T)
        turn += abs(rolled)
        net += rolled
    gone = path > far
    degrees = np.degrees(1 / radius[gone])
    rolls = sums["spin"] > 0
    return {"energy": sums["rotation"] / sums["kinetic"], "spin": sums["spin"] / sums["speed"], "turning": np.median(turn[gone] * degrees),
            "rolled": turn[gone].sum() / path[gone].sum(), "net turn": np.median(abs(net[gone]) * degrees),
            "net rolled": abs(net[gone]).sum() / path[gone].sum(), "slip": sums["slip"] / sums["bare"], "holding": sums["holding"] / sums["pairs"],
            **({"signs": sums["signed"] / sums["spin"], "opposite": sums["opposite"] / sums["pairs"],
                "correlation": sums["product"] / sums["squares"]} if rolls else {})}


def rotation(run):
    """Of the collapse of 540 grains, by its states 20 steps apart, while kinetic energy is above 1 % of its most."""
    flow = run.measures["flow"]
    return {**of_rotation(of_stage(run, "flow"), 1, 0.0075, 3), "slope": flow["repose_right_deg"], "run-out": flow["runout_99"] / 72}


def rotation_in_silo(run):
    """From step 3,000 to 5,000 of the discharge, unless it has clogged by then."""
    frames = of_stage(run, "discharge")
    frames = [frame for frame in frames if frame.step >= frames[0].step + 3000]
    if len(frames[-10].ids) == len(frames[-1].ids):
        return {}
    return of_rotation(frames, 3, 0.005, 6, SPACING)
