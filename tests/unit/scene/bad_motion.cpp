// Walls of wrong parts and wrong motions.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kBadMotion = std::to_array<BadScene>({
    {"a wall of no parts", "walls: {tray: {parts: []}}",
     "scene.yaml:7:23: error: walls.tray.parts: expected 1 to 1000 items, found 0"},
    {"a wall of parts and a box",
     "walls: {tray: {box: [0, 0, 9, 9], parts: [{box: [0, 0, 9, 9]}]}}",
     "scene.yaml:7:15: error: walls.tray: expected exactly one of box, line, disc, ring, arc, "
     "picture, parts, found box and parts"},
    {"a part in two ways",
     "walls: {tray: {parts: [{box: [0, 0, 9, 9]}, {box: [0, 0, 9, 9], line: {from: [0, 0], to: [9, "
     "9]}}]}}",
     "scene.yaml:7:45: error: walls.tray.parts.1: expected exactly one of box, line, disc, ring, "
     "arc, "
     "picture, found box and line"},
    {"a part that is a rectangle", "walls: {tray: {parts: [[0, 0, 9, 9]]}}",
     "scene.yaml:7:24: error: walls.tray.parts.0: expected a map (allowed: box, line, disc, ring, "
     "arc, picture), found a list"},
    {"a motion of a part",
     "walls: {tray: {parts: [{box: [0, 0, 9, 9], motion: {shake: {amplitude: 1}}}]}}",
     "scene.yaml:7:44: error: unknown key 'motion' in walls.tray.parts.0 (allowed: box, line, "
     "disc, ring, arc, picture)"},
    {"a part outside the box",
     "walls: {tray: {parts: [{box: [0, 0, 9, 9]}, {box: [0, 60, 9, 69]}]}}",
     "scene.yaml:7:51: error: walls.tray.parts.1.box: no site of the box, 100 wide and 50 high, "
     "lies in [0, 60, 9, 69]",
     Judge::parser},
    {"a line outside the box as a part",
     "walls: {tray: {parts: [{line: {from: [0, 60], to: [9, 69]}}]}}",
     "scene.yaml:7:31: error: walls.tray.parts.0.line: no site of the box, 100 wide and 50 high, "
     "lies on it",
     Judge::parser},
    {"a passive wall that stands", "walls: {plate: {box: [10, 40, 20, 42], passive: overlap}}",
     "scene.yaml:7:49: error: walls.plate.passive: only a wall that moves has it; give the wall a "
     "motion, or leave it out"},
    {"paths of weight where particles overlap",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}, passive: "
     "overlap}}\nstages: [{name: first, sources: [spout], move: [plate]}]\n"
     "measure: [weight_paths]",
     "scene.yaml:11:11: error: measure: no paths of weight with a wall that moves with passive: "
     "overlap",
     Judge::parser},
    {"a misspelt passive",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}, passive: "
     "rigit}}",
     "scene.yaml:7:89: error: walls.plate.passive: expected one of rigid, overlap, found 'rigit'; "
     "did you mean 'rigid'?"},
    {"a motion that is a word",
     "walls: {plate: {box: [10, 40, 20, 42], motion: down}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:48: error: walls.plate.motion: expected a map (allowed: direction, period, "
     "distance, wave, shake, path), found 'down'"},
    {"a motion of nothing",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:48: error: walls.plate.motion: motion without bound; give distance, or one of "
     "wave, shake, path"},
    {"a drive without bound",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, period: 4}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:48: error: walls.plate.motion: motion without bound; give distance, or one of "
     "wave, shake, path"},
    {"a drive without direction",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {distance: 40}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:48: error: walls.plate.motion: key 'direction' is missing"},
    {"a drive of 0 sites",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 0}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:76: error: walls.plate.motion.distance: expected a whole number from 1 to "
     "1000000, found '0'"},
    {"a drive too far",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 1000001}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:76: error: walls.plate.motion.distance: expected a whole number from 1 to "
     "1000000, found '1000001'"},
    {"a drive every 0 steps",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, period: 0, distance: 4}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:74: error: walls.plate.motion.period: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"a direction that the lattice does not have",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: left, distance: 4}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:60: error: walls.plate.motion.direction: expected one of down, up, up_right, "
     "down_right, down_left, up_left, found 'left'; did you mean 'up_left'?"},
    {"a misspelt key of a motion",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distence: 4}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:66: error: unknown key 'distence' in walls.plate.motion (allowed: direction, "
     "period, distance, wave, shake, path); did you mean 'distance'?"},
    {"a drive and a wave",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 4, wave: "
     "{amplitude: 1, period: 9}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:48: error: walls.plate.motion: expected either distance and period, or one of "
     "wave, shake, path, found distance and wave"},
    {"a period beside a shake",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {period: 4, shake: {amplitude: 1}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:48: error: walls.plate.motion: expected either distance and period, or one of "
     "wave, shake, path, found period and shake"},
    {"a shake and a path",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {shake: {amplitude: 1}, path: [[1, 1]]}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:48: error: walls.plate.motion: expected either distance and period, or one of "
     "wave, shake, path, found shake and path"},
    {"a wave without a period",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {wave: {amplitude: 2}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:55: error: walls.plate.motion.wave: key 'period' is missing"},
    {"a wave of no amplitude",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {wave: {amplitude: 0, period: 9}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:67: error: walls.plate.motion.wave.amplitude: expected a whole number from 1 to "
     "10000, found '0'"},
    {"a wave of an unknown form",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {wave: {form: saw, amplitude: 2, period: "
     "9}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:62: error: walls.plate.motion.wave.form: expected one of sine, triangle, found "
     "'saw'"},
    {"a sine that is too fast",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {wave: {amplitude: 2, period: 13}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:78: error: walls.plate.motion.wave.period: expected at least 14 steps for a "
     "sine of amplitude 2, which moves one site a step at most, found '13'",
     Judge::parser},
    {"a triangle that is too fast",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {wave: {form: triangle, amplitude: 2, period: "
     "7}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:94: error: walls.plate.motion.wave.period: expected at least 8 steps for a "
     "triangle of amplitude 2, which moves one site a step at most, found '7'",
     Judge::parser},
    {"a wave too wide",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {wave: {amplitude: 10001, period: 100000}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:67: error: walls.plate.motion.wave.amplitude: expected a whole number from 1 to "
     "10000, found '10001'"},
    {"a shake of 0",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {shake: {amplitude: 0}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:68: error: walls.plate.motion.shake.amplitude: expected a whole number from 1 "
     "to 1000000, found '0'"},
    {"a shake without amplitude",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {shake: {wait: settled}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:56: error: walls.plate.motion.shake: key 'amplitude' is missing"},
    {"a misspelt wait",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {shake: {amplitude: 2, wait: setled}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:77: error: walls.plate.motion.shake.wait: expected settled or a whole number "
     "from 1 to 1000000000000, found 'setled'; did you mean 'settled'?"},
    {"a wait of 0 steps",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {shake: {amplitude: 2, wait: 0}}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:77: error: walls.plate.motion.shake.wait: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"a path of no points",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {path: []}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:55: error: walls.plate.motion.path: expected 1 to 100000 items, found 0"},
    {"a point of three numbers",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {path: [[1, 1, 1]]}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:56: error: walls.plate.motion.path: expected 2 items, found 3"},
    {"a path that begins at step 0",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {path: [[0, 1]]}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:57: error: walls.plate.motion.path: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"a path that goes back in time",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {path: [[5, 1], [5, 2]]}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:65: error: walls.plate.motion.path: expected a step after 5, found '5'",
     Judge::parser},
    {"half a site",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {path: [[5, 0.5]]}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:60: error: walls.plate.motion.path: expected a whole number from -1000000 to "
     "1000000, found '0.5'"},
    {"a path that is steep from the start",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {path: [[2, 3]]}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:56: error: walls.plate.motion.path: from [0, 0] to [2, 3] is steeper than one "
     "site a step",
     Judge::parser},
    {"a path that is steep on the way down",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {path: [[9, 5], [12, 1]]}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:64: error: walls.plate.motion.path: from [9, 5] to [12, 1] is steeper than one "
     "site a step",
     Judge::parser},
});

}  // namespace

std::span<const BadScene> bad_motion() {
  return kBadMotion;
}

}  // namespace clca::scene::testing
