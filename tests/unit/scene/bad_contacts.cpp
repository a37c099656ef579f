// Wrong for the contact model, or for the other one.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kBadContacts = std::to_array<BadScene>({
    {"a time step of a stage", "stages: [{name: first, contact: {resolution: 0.1}}]",
     "scene.yaml:10:34: error: unknown key 'resolution' in stages.first.contact (allowed: "
     "friction, "
     "wall_friction, rolling_friction, restitution); did you mean 'restitution'?"},
    {"a resolution without a time step", "contact: {resolution: 0.01, fall_height: 1000000}",
     "scene.yaml:13:10: error: contact: a resolution of 0.01 and a fall height of 1000000 give no "
     "time step: gravity would be 5e-11 lattice spacings per step squared, and may be 9.54e-07 to "
     "0.25",
     Judge::parser},
    {"a misspelt model", "model: contct",
     "scene.yaml:6:8: error: model: expected one of automaton, contact, voids, baxter, found "
     "'contct'; did "
     "you "
     "mean 'contact'?"},
    {"a model that is a map", "model: {contact: {}}",
     "scene.yaml:6:8: error: model: expected one of automaton, contact, voids, baxter, found a "
     "map"},
    {"the void model without voids", "model: voids\nspecies: {small: {shape: {hexagon: 1}}}",
     "scene.yaml:5:11: error: species.small: grains of model voids have one site, these have 7; "
     "give it 'shape: {hexagon: 0}'",
     Judge::parser},
    {"a wall that moves among voids",
     "model: voids\nspecies: {small: {shape: {hexagon: 0}}}\nwalls: {left: {box: [0, 0, 1, 50], "
     "motion: {direction: up, distance: 5, period: 1}}}\n"
     "stages: [{name: first, sources: [spout], move: [left]}]",
     "scene.yaml:7:44: error: walls.left.motion: model voids has no walls that move, model "
     "automaton does; remove it, or say 'model: automaton'",
     Judge::parser},
    {"grains with an axis and seven sites",
     "model: baxter\nspecies: {small: {shape: {hexagon: 1}}}",
     "scene.yaml:5:11: error: species.small: grains of model baxter have one site, these have 7; "
     "give it 'shape: {hexagon: 0}'",
     Judge::parser},
    {"a wall that moves among grains with an axis",
     "model: baxter\nspecies: {small: {shape: {hexagon: 0}}}\nwalls: {left: {box: [0, 0, 1, 50], "
     "motion: {direction: up, distance: 5, period: 1}}}\n"
     "stages: [{name: first, sources: [spout], move: [left]}]",
     "scene.yaml:7:44: error: walls.left.motion: model baxter has no walls that move, model "
     "automaton does; remove it, or say 'model: automaton'",
     Judge::parser},
    {"half a power", "model: baxter\nbaxter: {power: 0.5}",
     "scene.yaml:13:17: error: baxter.power: expected a whole number from 0 to 6, found '0.5'"},
    {"energies of the automaton", "model: automaton\nbaxter: {power: 1}",
     "scene.yaml:13:1: error: baxter: only model baxter has it; remove it, or say 'model: baxter'"},
    {"more than a weight straight above voids", "model: voids\nvoids: {straight: 1.5}",
     "scene.yaml:13:19: error: voids.straight: expected a number from 0 to 1, found '1.5'"},
    {"voids of the contact model", "voids: {straight: 0.5}",
     "scene.yaml:13:1: error: voids: only model voids has it; remove it, or say 'model: voids'"},
    {"a sieve of the contact model", "species: {small: {shape: {hexagon: 1}, sieve: 0.5}}",
     "scene.yaml:5:40: error: species.small.sieve: only model voids has it; remove it, or say "
     "'model: voids'",
     Judge::parser},
    {"rules", "rules:\n  inertia: 0.9",
     "scene.yaml:13:1: error: rules: only model automaton has it; remove it, or say 'model: "
     "automaton'"},
    {"a contact block of the automaton", "model: automaton\ncontact: {friction: 0.2}",
     "scene.yaml:13:1: error: contact: only model contact has it; remove it, or say 'model: "
     "contact'"},
    {"friction of a wall of the automaton",
     "model: automaton\nwalls: {left: {box: [0, 0, 1, 50], friction: 0.2}}",
     "scene.yaml:7:36: error: walls.left.friction: only model contact has it; remove it, or say "
     "'model: contact'",
     Judge::parser},
    {"a word for the block", "contact: default",
     "scene.yaml:13:10: error: contact: expected a map (allowed: friction, wall_friction, rolling, "
     "rolling_friction, restitution, sweeps, resolution, fall_height), found 'default'"},
    {"a misspelt key", "contact: {frictoin: 0.2}",
     "scene.yaml:13:11: error: unknown key 'frictoin' in contact (allowed: friction, "
     "wall_friction, rolling, rolling_friction, restitution, sweeps, resolution, fall_height); did "
     "you mean 'friction'?"},
    {"a negative friction", "contact: {friction: -0.1}",
     "scene.yaml:13:21: error: contact.friction: expected a number from 0 to 16384, found "
     "'-0.1'"},
    {"too much friction of walls", "contact: {wall_friction: 16384.5}",
     "scene.yaml:13:26: error: contact.wall_friction: expected a number from 0 to 16384, "
     "found '16384.5'"},
    {"a misspelt rolling", "contact: {rolling: resistence}",
     "scene.yaml:13:20: error: contact.rolling: expected one of none, resistance, free, found "
     "'resistence'; did you mean 'resistance'?"},
    {"a negative friction of rolling", "contact: {rolling_friction: -1}",
     "scene.yaml:13:29: error: contact.rolling_friction: expected a number from 0 to 16384, "
     "found '-1'"},
    {"no loss in a collision", "contact: {restitution: 1}",
     "scene.yaml:13:24: error: contact.restitution: expected a number from 0 to 0.99, found '1'"},
    {"no sweeps", "contact: {sweeps: 0}",
     "scene.yaml:13:19: error: contact.sweeps: expected a whole number from 2 to 64, found '0'"},
    {"too many sweeps", "contact: {sweeps: 66}",
     "scene.yaml:13:19: error: contact.sweeps: expected a whole number from 2 to 64, found '66'"},
    {"an odd number of sweeps", "contact: {sweeps: 3}",
     "scene.yaml:13:19: error: contact.sweeps: expected an even number, as every second sweep goes "
     "backwards, found '3'"},
    {"a resolution that is too fine", "contact: {resolution: 0.001}",
     "scene.yaml:13:23: error: contact.resolution: expected a number from 0.01 to 1, found "
     "'0.001'"},
    {"a fall from nowhere", "contact: {fall_height: 0}",
     "scene.yaml:13:24: error: contact.fall_height: expected a number above 0 and up to 1000000, "
     "found '0'"},
    {"a fall from too high", "contact: {fall_height: 1000001}",
     "scene.yaml:13:24: error: contact.fall_height: expected a number above 0 and up to 1000000, "
     "found '1000001'"},
    {"a fall from below", "contact: {fall_height: -5}",
     "scene.yaml:13:24: error: contact.fall_height: expected auto or a number above 0 and up to "
     "1000000, found '-5'"},
    {"a misspelt auto", "contact: {fall_height: aut}",
     "scene.yaml:13:24: error: contact.fall_height: expected auto or a number above 0 and up to "
     "1000000, found 'aut'; did you mean 'auto'?"},
    {"a negative friction of a wall", "walls: {left: {box: [0, 0, 1, 50], friction: -1}}",
     "scene.yaml:7:46: error: walls.left.friction: expected a number from 0 to 16384, found "
     "'-1'"},
    {"units of the automaton", "model: automaton\nunits: {spacing: 1 mm}",
     "scene.yaml:13:1: error: units: only model contact has it; remove it, or say 'model: "
     "contact'"},
    {"a length with a unit where a spacing has none", "walls: {left: {box: [0, 0, 1 mm, 50]}}",
     "scene.yaml:7:28: error: walls.left.box: expected lattice spacings, as in a scene without "
     "units, found '1 mm'; 'units: {spacing: 1 mm}' says how long a spacing is",
     Judge::parser},
    {"a length of an unknown unit",
     "units: {spacing: 1 mm}\nwalls: {left: {box: [0, 0, 1 in, 50]}}",
     "scene.yaml:7:28: error: walls.left.box: expected lattice spacings, or a length with one of "
     "the units m, cm, mm, um, found '1 in'"},
    {"a length of an unknown unit where a spacing has none",
     "walls: {left: {box: [0, 0, 1 in, 50]}}",
     "scene.yaml:7:28: error: walls.left.box: expected lattice spacings, as in a scene without "
     "units, found '1 in'; 'units: {spacing: 1 mm}' says how long a spacing is"},
    {"a length in kilometres", "units: {spacing: 1 mm}\nbox: {width: 1 km, height: 1001 m}",
     "scene.yaml:4:14: error: box.width: expected lattice spacings, or a length with one of the "
     "units m, cm, mm, um, found '1 km'"},
    {"a length beyond what it may be", "units: {spacing: 1 mm}\nbox: {width: 50, height: 1001 m}",
     "scene.yaml:4:26: error: box.height: expected a number from 1 to 1000000, found '1001000', "
     "the value of '1001 m'",
     Judge::parser},
    {"a length below 0", "units: {spacing: 1 mm}\nbox: {width: -5 cm, height: 50}",
     "scene.yaml:4:14: error: box.width: expected a number from 1 to 866025, found '-50', the "
     "value of '-5 cm'",
     Judge::parser},
    {"units without a spacing", "units: {gravity: 9.81}",
     "scene.yaml:13:8: error: units: key 'spacing' is missing"},
    {"an unknown unit", "units: {spacing: 1 furlong}",
     "scene.yaml:13:18: error: units.spacing: expected a length from 1e-09 m to 1000 m, a number "
     "with one of the units m, cm, mm, um, as in 1 mm, found '1 furlong'"},
    {"a negative spacing", "units: {spacing: -1 mm}",
     "scene.yaml:13:18: error: units.spacing: expected a length from 1e-09 m to 1000 m, a number "
     "with one of the units m, cm, mm, um, as in 1 mm, found '-1 mm'"},
    {"a spacing without a unit", "units: {spacing: 0.001}",
     "scene.yaml:13:18: error: units.spacing: expected a length from 1e-09 m to 1000 m, a number "
     "with one of the units m, cm, mm, um, as in 1 mm, found '0.001'"},
    {"a unit alone", "units: {spacing: mm}",
     "scene.yaml:13:18: error: units.spacing: expected a length from 1e-09 m to 1000 m, a number "
     "with one of the units m, cm, mm, um, as in 1 mm, found 'mm'"},
    {"a spacing of nothing", "units: {spacing: 0 mm}",
     "scene.yaml:13:18: error: units.spacing: expected a length from 1e-09 m to 1000 m, a number "
     "with one of the units m, cm, mm, um, as in 1 mm, found '0 mm'",
     Judge::parser},
    {"a spacing of more than a kilometre", "units: {spacing: 1001 m}",
     "scene.yaml:13:18: error: units.spacing: expected a length from 1e-09 m to 1000 m, a number "
     "with one of the units m, cm, mm, um, as in 1 mm, found '1001 m'",
     Judge::parser},
    {"a list of spacings", "units: {spacing: [1 mm]}",
     "scene.yaml:13:18: error: units.spacing: expected a length from 1e-09 m to 1000 m, a number "
     "with one of the units m, cm, mm, um, as in 1 mm, found a list"},
    {"gravity that points up", "units: {spacing: 1 mm, gravity: -9.81}",
     "scene.yaml:13:33: error: units.gravity: expected a number from 1e-06 to 1000000, found "
     "'-9.81'"},
    {"grains without mass", "units: {spacing: 1 mm, density: 0}",
     "scene.yaml:13:33: error: units.density: expected a number from 1e-09 to 1000000000, found "
     "'0'"},
    {"forces on walls in the automaton", "model: automaton\noutput: {series: {forces: true}}",
     "scene.yaml:12:19: error: output.series.forces: only model contact has it; remove it, or say "
     "'model: contact'",
     Judge::parser},
    {"a misspelt key of units", "units: {spacing: 1 mm, gravty: 9.81}",
     "scene.yaml:13:24: error: unknown key 'gravty' in units (allowed: spacing, gravity, density); "
     "did you "
     "mean 'gravity'?"},
    {"a time of the automaton",
     "model: automaton\nstages: [{name: first, sources: [spout], until: {time: 1}}]",
     "scene.yaml:10:50: error: stages.first.until.time: only model contact has it; remove it, or "
     "say 'model: contact'",
     Judge::parser},
    {"a time of nothing", "stages: [{name: first, sources: [spout], until: {time: 0}}]",
     "scene.yaml:10:56: error: stages.first.until.time: expected a number above 0 and up to "
     "1000000000, found '0'"},
    {"a time of too many steps",
     "units: {spacing: 1 um, gravity: 1e6}\n"
     "stages: [{name: first, sources: [spout], until: {time: 1e6}}]",
     "scene.yaml:10:49: error: stages.first.until: it takes more than 1000000000000 "
     "steps",
     Judge::parser},
    {"fewer steps than a time takes",
     "contact: {fall_height: 80}\n"
     "stages: [{name: first, sources: [spout], until: {time: 1}, max_steps: 31}]",
     "scene.yaml:10:71: error: stages.first.max_steps: 31 is less than the 32 steps of until",
     Judge::parser},
    {"rods, which do not roll",
     "species: {small: {shape: {hexagon: 1}}, large: {shape: {rod: {radius: 0, length: 2}}}}",
     "scene.yaml:5:41: error: species.large: only hexagons and discs roll; give it the shape of "
     "one, "
     "or say 'contact.rolling: none'",
     Judge::parser},
    {"a shape with as many sites as a hexagon that rolls freely",
     "species: {small: {shape: {rod: {radius: 0, length: 7}}}, large: {shape: {hexagon: 1}}}\n"
     "contact: {rolling: free}",
     "scene.yaml:5:11: error: species.small: only hexagons and discs roll; give it the shape of "
     "one, "
     "or say 'contact.rolling: none'",
     Judge::parser},
    {"a wall that lets overlap",
     "walls: {plate: {box: [10, 40, 20, 42], passive: overlap, motion: {direction: down, distance: "
     "9}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:49: error: walls.plate.passive: model contact lets nothing overlap yet, model "
     "automaton does; remove it, or say 'model: automaton'",
     Judge::parser},
    {"a vessel of the automaton",
     "model: automaton\nstages: [{name: first, sources: [spout], vessel: {tilt: 5}}]",
     "scene.yaml:10:42: error: stages.first.vessel: only model contact has it; remove it, or say "
     "'model: "
     "contact'",
     Judge::parser},
    {"contacts in a trajectory of the automaton",
     "model: automaton\noutput: {trajectory: {contacts: true}}",
     "scene.yaml:12:23: error: output.trajectory.contacts: only model contact has it; remove it, "
     "or say 'model: contact'",
     Judge::parser},
    {"upright pictures of the automaton", "model: automaton\noutput: {frames: {upright: true}}",
     "scene.yaml:12:19: error: output.frames.upright: only model contact has it; remove it, or say "
     "'model: contact'",
     Judge::parser},
    {"a force scale of the automaton", "model: automaton\noutput: {frames: {force_scale: 9}}",
     "scene.yaml:12:32: error: output.frames.force_scale: goes with model: contact or an overlay "
     "of "
     "weight",
     Judge::parser},
    {"paths of weight in a vessel that tilts",
     "stages: [{name: first, sources: [spout], vessel: {tilt: 5}}]\nmeasure: [weight_paths]",
     "scene.yaml:11:11: error: measure: no paths of weight in a vessel that tilts or moves",
     Judge::parser},
    {"an overlay of weight in a vessel that tilts",
     "stages: [{name: first, sources: [spout], vessel: {tilt: 5}}]\n"
     "output: {frames: {overlay: weight_q}}",
     "scene.yaml:12:28: error: output.frames.overlay: no paths of weight in a vessel that tilts or "
     "moves",
     Judge::parser},
    {"no force as the widest line", "output: {frames: {force_scale: 0}}",
     "scene.yaml:12:32: error: output.frames.force_scale: expected a number above 0 and up to "
     "1000000000, found '0'"},
    {"a vessel that does nothing", "stages: [{name: first, sources: [spout], vessel: {}}]",
     "scene.yaml:10:50: error: stages.first.vessel: expected exactly one of tilt, "
     "rotate, shake, found none"},
    {"a vessel that tilts and turns",
     "stages: [{name: first, sources: [spout], vessel: {tilt: 5, rotate: {rate: 1}}}]",
     "scene.yaml:10:50: error: stages.first.vessel: expected exactly one of tilt, "
     "rotate, shake, found tilt and rotate"},
    {"a vessel that stands on more than its head",
     "stages: [{name: first, sources: [spout], vessel: {tilt: 181}}]",
     "scene.yaml:10:57: error: stages.first.vessel.tilt: expected a number from -180 "
     "to 180, found '181'"},
    {"a tilt without its rate",
     "stages: [{name: first, sources: [spout], vessel: {tilt: {to: 5}}}]",
     "scene.yaml:10:57: error: stages.first.vessel.tilt: key 'rate' is missing"},
    {"a vessel that turns without a rate",
     "stages: [{name: first, sources: [spout], vessel: {rotate: {centre: [1, 2]}}}]",
     "scene.yaml:10:59: error: stages.first.vessel.rotate: key 'rate' is missing"},
    {"a vessel that does not turn",
     "stages: [{name: first, sources: [spout], vessel: {rotate: {rate: 0}}}]",
     "scene.yaml:10:66: error: stages.first.vessel.rotate.rate: expected a rate other "
     "than 0",
     Judge::parser},
    {"a vessel that turns too fast",
     "stages: [{name: first, sources: [spout], vessel: {rotate: {rate: 900}}, until: {steps: 9}}]",
     "scene.yaml:10:50: error: stages.first.vessel: a vessel turns too fast; a step "
     "takes 0.04 √(spacing/gravity)",
     Judge::parser},
    {"a vessel that is shaken too fast",
     "stages: [{name: first, sources: [spout], until: {steps: 9},\n"
     "  vessel: {shake: {gamma: 900, amplitude: 1e-3}}}]",
     "scene.yaml:11:11: error: stages.first.vessel: a vessel is shaken too fast or "
     "not at all; a step takes 0.04 √(spacing/gravity)",
     Judge::parser},
    {"a vessel that is shaken without an amplitude",
     "stages: [{name: first, sources: [spout], vessel: {shake: {gamma: 2}}}]",
     "scene.yaml:10:58: error: stages.first.vessel.shake: key 'amplitude' is missing"},
    {"a vessel that is shaken round about",
     "stages: [{name: first, sources: [spout], until: {steps: 9},\n"
     "  vessel: {shake: {gamma: 2, amplitude: 3, direction: round}}}]",
     "scene.yaml:11:55: error: stages.first.vessel.shake.direction: expected one of "
     "vertical, horizontal, found 'round'"},
    {"a periodic box in which two grains may touch on both sides",
     "box: {width: 51, height: 50, periodic: true}\n"
     "species: {small: {shape: {hexagon: 1}}, large: {shape: {hexagon: 15}}}",
     "scene.yaml:4:14: error: box.width: 60 columns, and in a periodic box of less than 64 two "
     "grains may touch on both sides, which model contact does not take; make the width 55.4 or "
     "more",
     Judge::parser},
    {"a vessel that turns until it rests",
     "stages: [{name: first, sources: [spout], vessel: {rotate: {rate: 0.1}}}]",
     "scene.yaml:10:10: error: stages.first.until: never comes to rest while the "
     "vessel turns; end the stage after cycles or steps, or give max_steps",
     Judge::parser},
    {"a periodic vessel that turns",
     "box: {width: 51, height: 50, periodic: true}\n"
     "stages: [{name: first, sources: [spout], until: {steps: 9}, vessel: {rotate: {rate: 1}}}]",
     "scene.yaml:10:78: error: stages.first.vessel.rotate: a periodic box has no centre to turn "
     "about; say 'periodic: false'",
     Judge::parser},
    {"cycles of a vessel that tilts",
     "stages: [{name: first, sources: [spout], until: {cycles: 9}, vessel: {tilt: 4}}]",
     "scene.yaml:10:49: error: stages.first.until: no wall of this stage goes to and "
     "fro, and its vessel neither turns nor is shaken; name one with a wave or a "
     "shake under move",
     Judge::parser},
    {"a deposition in a vessel that is tilted",
     "stages: [{name: first, sources: [spout], vessel: {tilt: 4}}, {name: second, fill: {\n"
     "  method: deposition, region: [0, 0, 50, 50], counts: {small: 3}}}]",
     "scene.yaml:10:83: error: stages.second.fill: deposition needs a vessel that "
     "stands upright; use 'method: random'",
     Judge::parser},
    {"a window of no steps", "output: {contacts: {window: 0}}",
     "scene.yaml:12:29: error: output.contacts.window: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"samples beyond the window", "output: {contacts: {window: 5, every: 6}}",
     "scene.yaml:12:39: error: output.contacts.every: expected 1 to 5, the steps of "
     "output.contacts.window, found 6",
     Judge::parser},
});

}  // namespace

std::span<const BadScene> bad_contacts() {
  return kBadContacts;
}

}  // namespace clca::scene::testing
