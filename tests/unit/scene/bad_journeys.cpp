// Walls that come, move and go as they cannot, or meet on their way.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kBadJourneys = std::to_array<BadScene>({
    {"a motion that no stage uses",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}}",
     "scene.yaml:7:9: error: walls.plate is not used; name it under move in a stage",
     Judge::parser},
    {"a wall whose name is a number", "walls: {12: {box: [10, 40, 20, 42]}}",
     "scene.yaml:7:9: error: walls: the name 12 is the number of a particle in tables of contacts; "
     "give it a letter",
     Judge::parser},
    {"a moved wall without motion", "stages: [{name: first, sources: [spout], move: [right]}]",
     "scene.yaml:10:49: error: stages.first.move: wall 'right' has no motion", Judge::parser},
    {"a wall that is there already",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}, gate: {box: "
     "[50, 0, 51, 50]}}\n"
     "stages:\n"
     "  - {name: first, sources: [spout], move: [plate], insert: [gate]}\n"
     "  - {name: second, insert: [gate]}",
     "scene.yaml:12:29: error: stages.second.insert: wall 'gate' is there since stage 'first'",
     Judge::parser},
    {"a wall that comes and goes at once",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}, gate: {box: "
     "[50, 0, 51, 50]}}\n"
     "stages:\n"
     "  - {name: first, sources: [spout], move: [plate], remove: [gate], insert: [gate]}",
     "scene.yaml:11:61: error: stages.first.remove: wall 'gate' is under insert too",
     Judge::parser},
    {"a wall that is gone again",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}, gate: {box: "
     "[50, 0, 51, 50]}}\n"
     "stages:\n"
     "  - {name: first, sources: [spout], move: [plate], insert: [gate]}\n"
     "  - {name: second, remove: [gate]}\n"
     "  - {name: third, remove: [gate]}",
     "scene.yaml:13:28: error: stages.third.remove: wall 'gate' is gone since stage 'second'",
     Judge::parser},
    {"a move of a wall that is gone",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}, gate: {box: "
     "[50, 0, 51, 50]}}\n"
     "stages:\n"
     "  - {name: first, sources: [spout], move: [plate], remove: [gate]}\n"
     "  - {name: second, remove: [plate], move: [plate]}",
     "scene.yaml:12:44: error: stages.second.move: wall 'plate' is gone since stage 'second'",
     Judge::parser},
    {"a move of a wall that is yet to come",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}, gate: {box: "
     "[50, 0, 51, 50]}}\n"
     "stages:\n"
     "  - {name: first, sources: [spout], move: [plate]}\n"
     "  - {name: second, insert: [plate]}",
     "scene.yaml:11:44: error: stages.first.move: wall 'plate' is not there before stage 'second' "
     "inserts it",
     Judge::parser},
    {"an inserted wall that is not there",
     "stages: [{name: first, sources: [spout], insert: [rigth]}]",
     "scene.yaml:10:51: error: stages.first.insert: unknown wall 'rigth' (known: left, right); did "
     "you mean 'right'?",
     Judge::parser},
    {"moved walls outside a list", "stages: [{name: first, sources: [spout], move: right}]",
     "scene.yaml:10:48: error: stages.first.move: expected a list, found 'right'; write [right]"},
    {"a moved wall twice in one list",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate, plate]}]",
     "scene.yaml:10:56: error: stages.first.move: 'plate' is named twice"},
    {"cycles without a cycle",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate], until: {cycles: 3}}]",
     "scene.yaml:10:64: error: stages.first.until: no wall of this stage goes to and fro; name one "
     "with a wave or a shake under move",
     Judge::parser},
    {"cycles of walls that are held",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {shake: {amplitude: 2}}}, gate: {box: [50, 0, "
     "51, 50]}}\n"
     "stages:\n"
     "  - {name: first, sources: [spout], move: [plate], until: {cycles: 3}}\n"
     "  - {name: second, until: {cycles: 3}}",
     "scene.yaml:12:27: error: stages.second.until: no wall of this stage goes to and fro; name "
     "one with a wave or a shake under move",
     Judge::parser},
    {"cycles of a shake that waits for a rest that never comes",
     "rules: {candidates: all}\n"
     "walls: {plate: {box: [10, 40, 20, 42], motion: {shake: {amplitude: 2}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate], until: {cycles: 3}}]",
     "scene.yaml:10:64: error: stages.first.until: wall 'plate' waits until all is settled, which "
     "never comes with rules.candidates: all; give its shake a wait in steps, or give max_steps",
     Judge::parser},
    {"0 cycles",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {shake: {amplitude: 2}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate], until: {cycles: 0}}]",
     "scene.yaml:10:73: error: stages.first.until.cycles: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"a bound below the cycles asked for",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {wave: {amplitude: 2, period: 14}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate], until: {cycles: 3}, max_steps: 41}]",
     "scene.yaml:10:88: error: stages.first.max_steps: 41 is less than the 42 steps of until",
     Judge::parser},
    {"cycles without end",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {wave: {amplitude: 2, period: 14}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate], until: {cycles: 100000000000}}]",
     "scene.yaml:10:64: error: stages.first.until: it takes more than 1000000000000 steps",
     Judge::parser},
    {"a rest that never comes, since a wall shakes",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {shake: {amplitude: 2}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:10:10: error: stages.first.until: never comes to rest while wall 'plate' goes to "
     "and fro; end the stage after cycles or steps, or give max_steps",
     Judge::parser},
    {"a rest that never comes, since a wall waves",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {wave: {amplitude: 2, period: 14}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate], until: settled}]",
     "scene.yaml:10:64: error: stages.first.until: never comes to rest while wall 'plate' goes to "
     "and fro; end the stage after cycles or steps, or give max_steps",
     Judge::parser},
    {"a moving wall that never comes",
     "walls: {plate: {box: [10, 90, 20, 92], motion: {direction: down, distance: 40}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:16: error: walls.plate: no site of the box, 100 wide and 50 high, lies on its "
     "way",
     Judge::parser},
    {"a moving wall that goes away",
     "walls: {plate: {line: {from: [10, 60], to: [20, 60]}, motion: {direction: up, distance: "
     "40}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:16: error: walls.plate: no site of the box, 100 wide and 50 high, lies on its "
     "way",
     Judge::parser},
    {"a moving wall that runs into a standing one",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 30}}, floor: "
     "{box: [0, 0, 100, 12]}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:16: error: walls.plate: its way meets the standing wall 'floor'; shorten the "
     "distance or amplitude, or move one of them elsewhere",
     Judge::parser},
    {"a moving wall that meets one inserted later",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 30}}, floor: "
     "{box: [0, 0, 100, 12]}}\n"
     "stages:\n"
     "  - {name: first, sources: [spout], move: [plate]}\n"
     "  - {name: second, insert: [floor], move: [plate]}",
     "scene.yaml:7:16: error: walls.plate: its way meets the standing wall 'floor'; shorten the "
     "distance or amplitude, or move one of them elsewhere",
     Judge::parser},
    {"two walls that run into each other",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 20}}, ram: {box: "
     "[10, 10, 20, 12], motion: {shake: {amplitude: 18}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate, ram], until: {cycles: 1}}]",
     "scene.yaml:7:16: error: walls.plate: its way meets that of wall 'ram'; shorten a distance or "
     "amplitude, or move one of them elsewhere",
     Judge::parser},
    {"two walls of one motion on the same sites",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}, ram: {box: "
     "[15, 40, 25, 42], motion: {direction: down, distance: 9}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate, ram]}]",
     "scene.yaml:7:16: error: walls.plate: shares sites with wall 'ram', which has the same "
     "motion; make "
     "them parts of one wall, or move one of them elsewhere",
     Judge::parser},
    {"a wall that slides across the seam into another",
     "box: {width: 100, height: 50, periodic: true}\n"
     "walls: {plate: {box: [95, 20, 100, 22], motion: {direction: up_right, distance: 15}}, post: "
     "{box: [6, 20, 8, 40]}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:16: error: walls.plate: its way meets the standing wall 'post'; shorten the "
     "distance or amplitude, or move one of them elsewhere",
     Judge::parser},
});

}  // namespace

std::span<const BadScene> bad_journeys() {
  return kBadJourneys;
}

}  // namespace clca::scene::testing
