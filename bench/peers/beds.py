"""Beds of discs between a left side, a floor and a wall: geometry and measures.

Lengths are lattice spacings, masses areas (density 1), gravity 1. A disc is (x, y, radius).
"""
import dataclasses
import math

COLUMN = math.sqrt(3) / 2  # from one column of the lattice to the next
SITES = {"small": 7, "large": 19}  # of hexagons of radius 1 and 2
# A disc has the area of its hexagon: the column then weighs as much, and stands as high.
RADII = {name: math.sqrt(sites * COLUMN / math.pi) for name, sites in SITES.items()}
FLOOR = -0.5  # the faces of the walls, half a site before them
LEFT = -COLUMN / 2


@dataclasses.dataclass(frozen=True)
class Geometry:
    """scenes/wall-removal.yaml at any size; `narrow` is the width of the column at 540 particles."""

    particles: int
    narrow: float

    @property
    def scale(self):
        return math.sqrt(self.particles / 540)

    @property
    def wall(self):
        """x of the face of the wall that is taken away."""
        return math.ceil(self.narrow * self.scale / COLUMN) * COLUMN - COLUMN / 2

    @property
    def width(self):
        """L0: of the column, from face to face."""
        return self.wall - LEFT

    @property
    def weight(self):
        """Of the bed, per unit of width: the pressure on the floor."""
        return self.particles * mean_mass() / self.width

    def overrides(self, seed):
        """What `clca run` has to set in the scene."""
        height = 460 * self.scale
        wall = self.narrow * self.scale
        half = self.particles // 2
        return {
            "seed": seed,
            "box.width": 300 * self.scale,
            "box.height": height,
            "walls.right.box": [wall, 0, wall + 1, height],
            "stages.packing.fill.region": [0, 0, wall, height],
            "stages.packing.fill.counts.small": half,
            "stages.packing.fill.counts.large": self.particles - half,
        }


def mean_mass():
    return COLUMN * sum(SITES.values()) / len(SITES)


def mean_diameter():
    return 2 * sum(RADII.values()) / len(RADII)


def profile(discs, end):
    """Height of the highest disc above the floor at each column of the lattice up to x = `end`."""
    heights = [0.0] * (int(end / COLUMN) + 1)
    for x, y, radius in discs:
        first = max(0, math.ceil((x - radius) / COLUMN))
        for column in range(first, min(len(heights), math.floor((x + radius) / COLUMN) + 1)):
            chord = math.sqrt(max(0.0, radius**2 - (column * COLUMN - x) ** 2))
            heights[column] = max(heights[column], y + chord - FLOOR)
    return heights


def slope(heights):
    """Slope of the right flank in degrees, as docs/scene-format.md defines `repose`; None without."""
    top = max(heights)
    plateau = [i for i, height in enumerate(heights) if height >= 0.80 * top]
    middle = sum(plateau) / len(plateau)
    flank = [(i * COLUMN, height) for i, height in enumerate(heights)
             if i > middle and 0.15 * top <= height < 0.80 * top]
    if len(flank) < 5:
        return None
    mean_x = sum(x for x, _ in flank) / len(flank)
    mean_h = sum(h for _, h in flank) / len(flank)
    fall = -sum((x - mean_x) * (h - mean_h) for x, h in flank)
    return math.degrees(math.atan(fall / sum((x - mean_x) ** 2 for x, _ in flank)))


def runout_99(start, end):
    """How far the place that 99 % of the area does not pass lies beyond the outermost disc at the start."""
    slices = 8  # of a disc, upright
    areas = []
    for x, _, radius in end:
        for i in range(slices):
            offset = radius * ((2 * i + 1) / slices - 1)
            areas.append((x + offset, radius * math.sqrt(radius**2 - offset**2)))
    areas.sort(reverse=True)
    beyond = 0.01 * sum(area for _, area in areas)
    for x, area in areas:
        beyond -= area
        if beyond < 0:
            return x - max(x + radius for x, _, radius in start)
    raise AssertionError("the areas of all slices are more than one part in a hundred of them")


def overlaps(discs):
    """Overlap of each pair in contact over the mean of their diameters, ascending."""
    cell = 2 * RADII["large"]
    cells = {}
    for i, (x, y, _) in enumerate(discs):
        cells.setdefault((int(x // cell), int(y // cell)), []).append(i)
    found = []
    for (column, row), here in cells.items():
        near = [j for dc in (-1, 0, 1) for dr in (-1, 0, 1)
                for j in cells.get((column + dc, row + dr), ())]
        for i in here:
            x, y, radius = discs[i]
            for j in near:
                reach = radius + discs[j][2]
                distance = math.hypot(x - discs[j][0], y - discs[j][1]) if j < i else reach
                if distance < reach:
                    found.append((reach - distance) / reach)
    return sorted(found)
