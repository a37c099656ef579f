// Wrong walls, sources, outlets, probes and lines.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kBadGeometry = std::to_array<BadScene>({
    {"a wall called as a side of the box", "walls: {box.left: {box: [50, 0, 51, 50]}}",
     "scene.yaml:7:9: error: walls: a name has 1 to 64 of the characters A-Z a-z 0-9 _ -, found "
     "'box.left'"},
    {"a wall of three numbers", "walls: {right: {box: [50, 0, 51]}}",
     "scene.yaml:7:22: error: walls.right.box: expected 4 items, found 3"},
    {"a wall outside the box", "walls: {right: {box: [150, 0, 151, 50]}}",
     "scene.yaml:7:22: error: walls.right.box: no site of the box, 100 wide and 50 high, lies "
     "in [150, 0, 151, 50]",
     Judge::parser},
    {"a wall between two columns", "walls: {right: {box: [50.3, 0, 50.9, 50]}}",
     "scene.yaml:7:22: error: walls.right.box: no site of the box, 100 wide and 50 high, lies "
     "in [50.3, 0, 50.9, 50]",
     Judge::parser},
    {"a wall inside out", "walls: {right: {box: [51, 0, 50, 50]}}",
     "scene.yaml:7:22: error: walls.right.box: expected [left, bottom, right, top] with left "
     "< right and bottom < top, found [51, 0, 50, 50]",
     Judge::parser},
    {"a wall in two ways",
     "walls: {right: {box: [50, 0, 51, 50], line: {from: [0, 0], to: [1, 1]}}}",
     "scene.yaml:7:16: error: walls.right: expected exactly one of box, line, disc, ring, arc, "
     "picture, parts, found box and line"},
    {"a wall in no way", "walls: {right: {}}",
     "scene.yaml:7:16: error: walls.right: expected exactly one of box, line, disc, ring, arc, "
     "picture, parts, found none"},
    {"a line without an end", "walls: {slope: {line: {from: [0, 0]}}}",
     "scene.yaml:7:23: error: walls.slope.line: key 'to' is missing"},
    {"a line that is a point", "walls: {slope: {line: {from: [5, 5], to: [5, 5]}}}",
     "scene.yaml:7:42: error: walls.slope.line: from and to are the same point", Judge::parser},
    {"a line outside the box", "walls: {slope: {line: {from: [0, 60], to: [100, 80]}}}",
     "scene.yaml:7:23: error: walls.slope.line: no site of the box, 100 wide and 50 high, "
     "lies on it",
     Judge::parser},
    {"a line too thick", "walls: {slope: {line: {from: [0, 0], to: [50, 50], thickness: 1000}}}",
     "scene.yaml:7:63: error: walls.slope.line.thickness: expected a number from 0 to 100, "
     "found '1000'"},
    {"a point far away", "walls: {slope: {line: {from: [0, 0], to: [1e7, 50]}}}",
     "scene.yaml:7:43: error: walls.slope.line.to: expected a number from -1000000 to "
     "1000000, found '1e7'"},
    {"a disc without a radius", "walls: {rock: {disc: {centre: [5, 5]}}}",
     "scene.yaml:7:22: error: walls.rock.disc: key 'radius' is missing"},
    {"a disc of no size", "walls: {rock: {disc: {centre: [5, 5], radius: 0}}}",
     "scene.yaml:7:47: error: walls.rock.disc.radius: expected a number above 0 and up to "
     "1000000, found '0'"},
    {"a disc with a thickness", "walls: {rock: {disc: {centre: [5, 5], radius: 2, thickness: 1}}}",
     "scene.yaml:7:50: error: unknown key 'thickness' in walls.rock.disc (allowed: centre, "
     "radius)"},
    {"a disc outside the box", "walls: {rock: {disc: {centre: [50, -20], radius: 19}}}",
     "scene.yaml:7:22: error: walls.rock.disc: no site of the box, 100 wide and 50 high, lies on "
     "it",
     Judge::parser},
    {"a disc between the sites", "walls: {rock: {disc: {centre: [0.3, 0.5], radius: 0.5}}}",
     "scene.yaml:7:22: error: walls.rock.disc: no site of the box, 100 wide and 50 high, lies on "
     "it",
     Judge::parser},
    {"a ring that leaks", "walls: {drum: {ring: {centre: [50, 25], radius: 20, thickness: 0.9}}}",
     "scene.yaml:7:64: error: walls.drum.ring.thickness: expected a number from 1 to 100, found "
     "'0.9'"},
    {"a ring around the box", "walls: {drum: {ring: {centre: [50, 25], radius: 80}}}",
     "scene.yaml:7:22: error: walls.drum.ring: no site of the box, 100 wide and 50 high, lies on "
     "it",
     Judge::parser},
    {"a picture without pixels", "walls: {maze: {picture: {box: [0, 0, 9, 9]}}}",
     "scene.yaml:7:25: error: walls.maze.picture: expected exactly one of file, rows, found none"},
    {"a picture in two ways",
     "walls: {maze: {picture: {file: a.png, rows: [\"#\"], box: [0, 0, 9, 9]}}}",
     "scene.yaml:7:25: error: walls.maze.picture: expected exactly one of file, rows, found file "
     "and rows"},
    {"a picture of no rows", "walls: {maze: {picture: {rows: [], box: [0, 0, 9, 9]}}}",
     "scene.yaml:7:32: error: walls.maze.picture.rows: expected 1 to 1000000 items, found 0"},
    {"a picture of other characters",
     "walls: {maze: {picture: {rows: [\"#x\"], box: [0, 0, 9, 9]}}}",
     "scene.yaml:7:33: error: walls.maze.picture.rows: expected rows of one length of the "
     "characters # and ., found '#x' in quotes"},
    {"a picture with a ragged edge",
     "walls: {maze: {picture: {rows: [\"#.\", \"#\"], box: [0, 0, 9, 9]}}}",
     "scene.yaml:7:39: error: walls.maze.picture.rows: expected rows of one length of the "
     "characters # and ., found '#' in quotes",
     Judge::parser},
    {"a picture without a dark pixel in the box",
     "walls: {maze: {picture: {rows: [\"#.\"], box: [-20, 0, 20, 9]}}}",
     "scene.yaml:7:25: error: walls.maze.picture: no site of the box, 100 wide and 50 high, lies "
     "on it",
     Judge::parser},
    {"an arc without an end", "walls: {bowl: {arc: {centre: [50, 25], radius: 20, from: 180}}}",
     "scene.yaml:7:21: error: walls.bowl.arc: key 'to' is missing"},
    {"an arc that ends before it begins",
     "walls: {bowl: {arc: {centre: [50, 25], radius: 20, from: 10, to: 10}}}",
     "scene.yaml:7:21: error: walls.bowl.arc: expected from < to, less than 360 degrees apart, "
     "found 10 to 10; a whole circle is a ring",
     Judge::parser},
    {"an arc all around",
     "walls: {bowl: {arc: {centre: [50, 25], radius: 20, from: -180, to: 180}}}",
     "scene.yaml:7:21: error: walls.bowl.arc: expected from < to, less than 360 degrees apart, "
     "found -180 to 180; a whole circle is a ring",
     Judge::parser},
    {"an arc to beyond a turn",
     "walls: {bowl: {arc: {centre: [50, 25], radius: 20, from: 0, to: 361}}}",
     "scene.yaml:7:65: error: walls.bowl.arc.to: expected a number from -360 to 360, found '361'"},
    {"an arc outside the box",
     "walls: {bowl: {arc: {centre: [50, 0], radius: 20, from: 185, to: 355}}}",
     "scene.yaml:7:21: error: walls.bowl.arc: no site of the box, 100 wide and 50 high, lies on "
     "it",
     Judge::parser},
    {"walls in a list", "walls: [{box: [0, 0, 1, 50]}]",
     "scene.yaml:7:8: error: walls: expected a map, found a list"},
    {"a source without a place", "sources: {spout: {rate: 0.5, count: 9}}",
     "scene.yaml:8:18: error: sources.spout: expected exactly one of at, region, found none"},
    {"a source in two places", "sources: {spout: {at: [20, 40], region: [0, 0, 9, 9], rate: 0.5}}",
     "scene.yaml:8:18: error: sources.spout: expected exactly one of at, region, found at and "
     "region"},
    {"a source outside the box", "sources: {spout: {at: [20, 60], rate: 0.5, count: 9}}",
     "scene.yaml:8:23: error: sources.spout.at: expected a point in the box, 100 wide and 50 "
     "high, found [20, 60]",
     Judge::parser},
    {"a source half outside the box",
     "sources: {spout: {region: [20, 40, 30, 60], rate: 0.5, count: 9}}",
     "scene.yaml:8:27: error: sources.spout.region: expected a region in the box, 100 wide "
     "and 50 high, found [20, 40, 30, 60]",
     Judge::parser},
    {"a source of no rate", "sources: {spout: {at: [20, 40], rate: 0, count: 9}}",
     "scene.yaml:8:39: error: sources.spout.rate: expected a number from 1e-06 to 1000, found "
     "'0'"},
    {"a source of a rate without bound", "sources: {spout: {at: [20, 40], rate: 1001, count: 9}}",
     "scene.yaml:8:39: error: sources.spout.rate: expected a number from 1e-06 to 1000, found "
     "'1001'"},
    {"a source without rate", "sources: {spout: {at: [20, 40]}}",
     "scene.yaml:8:18: error: sources.spout: key 'rate' is missing"},
    {"a source of no particles", "sources: {spout: {at: [20, 40], rate: 1, count: 0}}",
     "scene.yaml:8:49: error: sources.spout.count: expected a whole number from 1 to "
     "2147483647, found '0'"},
    {"a source of an unknown species",
     "sources: {spout: {at: [20, 40], rate: 1, count: 9, species: {smal: 1}}}",
     "scene.yaml:8:62: error: sources.spout.species: unknown species 'smal' (known: small, "
     "large); did you mean 'small'?",
     Judge::parser},
    {"a source of species of no weight",
     "sources: {spout: {at: [20, 40], rate: 1, count: 9, species: {small: 0}}}",
     "scene.yaml:8:61: error: sources.spout.species: expected a weight above 0", Judge::parser},
    {"a negative weight",
     "sources: {spout: {at: [20, 40], rate: 1, count: 9, species: {small: -1}}}",
     "scene.yaml:8:69: error: sources.spout.species.small: expected a whole number from 0 to "
     "1000000, found '-1'"},
    {"a source that no stage opens",
     "sources: {spout: {at: [20, 40], rate: 1, count: 9}, other: {at: [30, 40], rate: 1, "
     "count: 9}}",
     "scene.yaml:8:53: error: sources.other is not used; name it under sources in a stage",
     Judge::parser},
    {"an outlet without a region", "outlets: {drain: {}}",
     "scene.yaml:9:18: error: outlets.drain: key 'region' is missing"},
    {"an outlet outside the box", "outlets: {drain: {region: [0, -20, 100, -10]}}",
     "scene.yaml:9:27: error: outlets.drain.region: no site of the box, 100 wide and 50 high, "
     "lies in [0, -20, 100, -10]",
     Judge::parser},
    {"a probe that is a map", "probes: {neck: {region: [0, 0, 10, 10]}}",
     "scene.yaml:13:16: error: probes.neck: expected a list, found a map"},
    {"a probe that reaches out of the box", "probes: {neck: [0, 0, 101, 10]}",
     "scene.yaml:13:16: error: probes.neck: expected a region in the box, 100 wide and 50 high, "
     "found "
     "[0, 0, 101, 10]",
     Judge::parser},
    {"a probe between two columns", "probes: {neck: [1, 0, 1.5, 10]}",
     "scene.yaml:13:16: error: probes.neck: no site of the box, 100 wide and 50 high, lies in [1, "
     "0, "
     "1.5, 10]",
     Judge::parser},
    {"a name that cannot be one", "probes: {the neck: [0, 0, 10, 10]}",
     "scene.yaml:13:10: error: probes: a name has 1 to 64 of the characters A-Z a-z 0-9 _ -, found "
     "'the neck'"},
    {"probes without rows", "probes: {neck: [0, 0, 10, 10]}\noutput: {series: none}",
     "scene.yaml:13:9: error: probes: nothing would be written; they have rows at the steps of "
     "output.series: set it, or remove them",
     Judge::parser},
    {"a line that is a list", "lines: {throat: [0, 0, 10, 10]}",
     "scene.yaml:13:17: error: lines.throat: expected a map (allowed: from, to, parts), found a "
     "list"},
    {"a line without an end to it", "lines: {throat: {from: [0, 5]}}",
     "scene.yaml:13:17: error: lines.throat: key 'to' is missing"},
    {"a line with a width", "lines: {throat: {from: [0, 5], to: [9, 5], width: 2}}",
     "scene.yaml:13:44: error: unknown key 'width' in lines.throat (allowed: from, to, parts)"},
    {"a line that begins below the box", "lines: {throat: {from: [0, -1], to: [9, 5]}}",
     "scene.yaml:13:24: error: lines.throat.from: expected a point in the box, 100 wide and 50 "
     "high, found [0, -1]",
     Judge::parser},
    {"a line that ends beside the box", "lines: {throat: {from: [0, 5], to: [101, 5]}}",
     "scene.yaml:13:36: error: lines.throat.to: expected a point in the box, 100 wide and 50 high, "
     "found [101, 5]",
     Judge::parser},
    {"a line to the place where it begins", "lines: {throat: {from: [9, 5], to: [9, 5.5]}}",
     "scene.yaml:13:36: error: lines.throat.to: expected a point at least 1 lattice spacing away "
     "from [9, 5], found [9, 5.5]",
     Judge::parser},
    {"a line to nowhere", "lines: {throat: {from: [9, 5], to: [9, .nan]}}",
     "scene.yaml:13:40: error: lines.throat.to: expected a number from -1000000 to 1000000, found "
     "'.nan'"},
    {"a line of no parts", "lines: {throat: {from: [0, 5], to: [9, 5], parts: 0}}",
     "scene.yaml:13:51: error: lines.throat.parts: expected a whole number from 1 to 1000, found "
     "'0'"},
    {"a line of too many parts", "lines: {throat: {from: [0, 5], to: [9, 5], parts: 1001}}",
     "scene.yaml:13:51: error: lines.throat.parts: expected a whole number from 1 to 1000, found "
     "'1001'"},
    {"a line whose name cannot be one", "lines: {the throat: {from: [0, 5], to: [9, 5]}}",
     "scene.yaml:13:9: error: lines: a name has 1 to 64 of the characters A-Z a-z 0-9 _ -, found "
     "'the throat'"},
    {"lines that nothing would observe",
     "lines: {throat: {from: [0, 5], to: [9, 5]}}\noutput: {series: none}",
     "scene.yaml:13:8: error: lines: nothing would be written; they are observed at the steps of "
     "output.series: set it, or remove them",
     Judge::parser},
});

}  // namespace

std::span<const BadScene> bad_geometry() {
  return kBadGeometry;
}

}  // namespace clca::scene::testing
