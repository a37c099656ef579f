// Wrong in title, seed, box, rules, measure and output.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kBadBasics = std::to_array<BadScene>({
    {"a let that is no map", "let: 3", "scene.yaml:13:6: error: let: expected a map, found '3'"},
    {"a let of text", "let: {a: wide}",
     "scene.yaml:13:10: error: let.a: expected a number or an expression like '=2*a', found "
     "'wide'"},
    {"a let with a name that is none", "let: {2a: 3}",
     "scene.yaml:13:7: error: let.2a: a name has up to 64 letters, digits and '_', no digit first, "
     "and is no function or constant"},
    {"a let with the name of a function", "let: {sqrt: 3}",
     "scene.yaml:13:7: error: let.sqrt: a name has up to 64 letters, digits and '_', no digit "
     "first, and is no function or constant",
     Judge::parser},
    {"a let of a number in quotes", "let: {a: '5'}",
     "scene.yaml:13:10: error: let.a: expected a number or an expression like '=2*a', found '5' in "
     "quotes"},
    {"a let with the name of a key", "let: {seed: 3}",
     "scene.yaml:13:7: error: let.seed: a key of the scene has this name", Judge::parser},
    {"a let that uses a later one", "let: {a: =b, b: 3}",
     "scene.yaml:13:10: error: unknown name 'b' in '=b' (nothing stands before it under let)",
     Judge::parser},
    {"a constant as a name", "let: {_pi: 3}",
     "scene.yaml:13:7: error: let._pi: a name has up to 64 letters, digits and '_', no digit "
     "first, and is no function or constant",
     Judge::parser},
    {"a sign that belongs to no expression", "box: {width: =2%3, height: 20}\nlet: {w: 30}",
     "scene.yaml:4:14: error: cannot evaluate '=2%3': '%3' is not expected", Judge::parser},
    {"an unknown name", "box: {width: =widht + 1, height: 20}\nlet: {width: 30}",
     "scene.yaml:4:14: error: unknown name 'widht' in '=widht + 1' (known: width); did you mean "
     "'width'?",
     Judge::parser},
    {"an expression that does not end", "box: {width: 30, height: =2*(3+}",
     "scene.yaml:4:26: error: cannot evaluate '=2*(3+': Unexpected end of expression",
     Judge::parser},
    {"an expression of nothing",
     "seed: =", "scene.yaml:3:7: error: cannot evaluate '=': Expression is empty", Judge::parser},
    {"an expression of two numbers", R"(seed: "=1,2")",
     "scene.yaml:3:7: error: '=1,2': expected one number, found 2", Judge::parser},
    {"an infinite number", "seed: =1/0", "scene.yaml:3:7: error: '=1/0' is no finite number",
     Judge::parser},
    {"an expression that assigns", "seed: =_pi=3",
     "scene.yaml:3:7: error: cannot evaluate '=_pi=3': Unexpected operator \"=\" found",
     Judge::parser},
    {"a fraction where a whole number is due", "seed: =7/2",
     "scene.yaml:3:7: error: seed: expected a whole number from 0 to 18446744073709551615, found "
     "'3.5', the value of '=7/2'",
     Judge::parser},
    {"an unknown version", "clca: 2",
     "scene.yaml:1:7: error: clca: expected version 1 of the format, found '2'"},
    {"a version in quotes", R"(clca: "1")",
     "scene.yaml:1:7: error: clca: expected version 1 of the format, found '1' in quotes"},
    {"a title of several lines", R"(title: "two\nlines")",
     R"(scene.yaml:2:8: error: title: expected one line of text, found 'two\nlines')",
     Judge::parser},
    {"an empty title", R"(title: "")",
     "scene.yaml:2:8: error: title: expected 1 to 200 characters, found 0"},
    {"a list for a title", "title: [a, b]",
     "scene.yaml:2:8: error: title: expected text, found a list"},
    {"a title without text",
     "title:", "scene.yaml:2:1: error: title: expected text, found nothing"},
    {"a negative seed", "seed: -1",
     "scene.yaml:3:7: error: seed: expected a whole number from 0 to 18446744073709551615, "
     "found '-1'"},
    {"a seed beyond 64 bits", "seed: 18446744073709551616",
     "scene.yaml:3:7: error: seed: expected a whole number from 0 to 18446744073709551615, "
     "found '18446744073709551616'"},
    {"a seed with a fraction", "seed: 1.5",
     "scene.yaml:3:7: error: seed: expected a whole number from 0 to 18446744073709551615, "
     "found '1.5'"},
    {"a seed with an exponent", "seed: 1e3",
     "scene.yaml:3:7: error: seed: expected a whole number from 0 to 18446744073709551615, "
     "found '1e3'"},
    {"a hexadecimal seed", "seed: 0x10",
     "scene.yaml:3:7: error: seed: expected a whole number from 0 to 18446744073709551615, "
     "found '0x10'"},
    {"an octal seed", "seed: 010",
     "scene.yaml:3:7: error: seed: expected a whole number from 0 to 18446744073709551615, "
     "found '010'",
     Judge::parser},
    {"a beginning without a run", "begin: {step: last}",
     "scene.yaml:13:8: error: begin: key 'run' is missing"},
    {"a beginning at no step", "begin: {run: a, step: first}",
     "scene.yaml:13:23: error: begin.step: expected last or a whole number from 0 to "
     "1000000000000, found 'first'"},
    {"a beginning in a folder without a name", "begin: {run: \"\"}",
     "scene.yaml:13:14: error: begin.run: expected a path of up to 4096 bytes of UTF-8, found ''"},
    {"a beginning with half a hash", "begin: {run: a, state: \"12ab\"}",
     "scene.yaml:13:24: error: begin.state: expected 16 hexadecimal digits, found '12ab' in "
     "quotes"},
    {"a misspelt key at the top", "sede: 1",
     "scene.yaml:13:1: error: unknown key 'sede' (allowed: clca, let, title, seed, model, begin, "
     "box, "
     "species, rules, contact, voids, baxter, units, walls, sources, outlets, probes, lines, "
     "stages, "
     "measure, "
     "output); "
     "did you "
     "mean "
     "'seed'?"},
    {"a key of another kind of scene", "boltzmann: {particles: 10}",
     "scene.yaml:13:1: error: 'boltzmann' does not go with 'box': a scene of the Boltzmann "
     "equation has the keys clca, let, title, seed, boltzmann, output; one of grains has clca, "
     "let, title, "
     "seed, model, begin, box, species, rules, contact, voids, baxter, units, walls, sources, "
     "outlets, "
     "probes, "
     "lines, "
     "stages, "
     "measure, "
     "output"},
    {"a misspelt key", "box: {wdith: 100, height: 50}",
     "scene.yaml:4:7: error: unknown key 'wdith' in box (allowed: width, height, periodic); "
     "did you mean 'width'?"},
    {"a missing key", "box: {width: 100}", "scene.yaml:4:6: error: box: key 'height' is missing"},
    {"a list for a box", "box: [100, 50]",
     "scene.yaml:4:6: error: box: expected a map (allowed: width, height, periodic), found a list"},
    {"a box without width", "box: {width: 0, height: 50}",
     "scene.yaml:4:14: error: box.width: expected a number from 1 to 866025, found '0'"},
    {"a box of more than a million columns", "box: {width: 1000000, height: 50}",
     "scene.yaml:4:14: error: box.width: expected a number from 1 to 866025, found '1000000'"},
    {"a width in words", "box: {width: wide, height: 50}",
     "scene.yaml:4:14: error: box.width: expected a number from 1 to 866025, found 'wide'"},
    {"a width in quotes", R"(box: {width: "100", height: 50})",
     "scene.yaml:4:14: error: box.width: expected a number from 1 to 866025, found '100' in "
     "quotes"},
    {"an infinite width", "box: {width: .inf, height: 50}",
     "scene.yaml:4:14: error: box.width: expected a number from 1 to 866025, found '.inf'"},
    {"a width that is no number", "box: {width: .nan, height: 50}",
     "scene.yaml:4:14: error: box.width: expected a number from 1 to 866025, found '.nan'"},
    {"a width beyond all numbers", "box: {width: 1e400, height: 50}",
     "scene.yaml:4:14: error: box.width: expected a number from 1 to 866025, found '1e400'"},
    {"a width that is missing", "box: {width: , height: 50}",
     "scene.yaml:4:7: error: box.width: expected a number from 1 to 866025, found nothing"},
    {"yes for true", "box: {width: 100, height: 50, periodic: yes}",
     "scene.yaml:4:41: error: box.periodic: expected true or false, found 'yes'"},
    {"an inertia above 1", "rules: {inertia: 1.5}",
     "scene.yaml:6:18: error: rules.inertia: expected a number from 0 to 1, found '1.5'"},
    {"a misspelt rule",
     "rules:\n"
     "  inertai: 0.9",
     "scene.yaml:7:3: error: unknown key 'inertai' in rules (allowed: inertia, scatter, "
     "candidates, gravity, update_priority, ties); did you mean 'inertia'?"},
    {"a misspelt choice", "rules: {candidates: downwards}",
     "scene.yaml:6:21: error: rules.candidates: expected one of downward, all, found "
     "'downwards'; did you mean 'downward'?"},
    {"a direction that the lattice does not have", "rules: {gravity: left}",
     "scene.yaml:6:18: error: rules.gravity: expected one of down, up, up_right, down_right, "
     "down_left, up_left, found 'left'; did you mean 'up_left'?"},
    {"a misspelt direction", "rules: {gravity: downleft}",
     "scene.yaml:6:18: error: rules.gravity: expected one of down, up, up_right, down_right, "
     "down_left, up_left, found 'downleft'; did you mean 'down_left'?"},
    {"a class twice in the order of updates", "rules: {update_priority: [rest, rest, gravity]}",
     "scene.yaml:6:33: error: rules.update_priority: 'rest' is named twice; name each "
     "class once"},
    {"a class missing in the order of updates", "rules: {update_priority: [rest, gravity]}",
     "scene.yaml:6:26: error: rules.update_priority: expected 3 items, found 2"},
    {"an unknown class", "rules: {update_priority: [rest, inertia, graviti]}",
     "scene.yaml:6:42: error: rules.update_priority: expected one of rest, inertia, gravity, "
     "found 'graviti'; did you mean 'gravity'?"},
    {"rules that are not a map", "rules: default",
     "scene.yaml:6:8: error: rules: expected a map (allowed: inertia, scatter, candidates, "
     "gravity, update_priority, ties), found 'default'"},
    {"a measure twice", "measure: [profile, moved, profile]",
     "scene.yaml:11:27: error: measure: 'profile' is named twice"},
    {"a misspelt measure", "measure: [profil]",
     "scene.yaml:11:11: error: measure: expected one of profile, repose, runout, packing, "
     "moved, outflow, force, segregation, intruder, convection, axis_order, mixing, weight_paths, "
     "found "
     "'profil'; did you "
     "mean 'profile'?"},
    {"a measure outside a list", "measure: profile",
     "scene.yaml:11:10: error: measure: expected a list, found 'profile'; write [profile]"},
    {"a word that is no measure outside a list", "measure: none",
     "scene.yaml:11:10: error: measure: expected a list, found 'none'"},
    {"a number outside a list of four", "output: {frames: {view: 5}}",
     "scene.yaml:12:25: error: output.frames.view: expected a list, found '5'"},
    {"a derived measure that is a number", "measure: {ratio: 3}",
     "scene.yaml:11:18: error: measure.ratio: expected an expression like '=runout_99 / 87', found "
     "'3'"},
    {"a derived measure without a value", "measure: [runout, {ratio: {unit: 1}}]",
     "scene.yaml:11:27: error: measure.ratio: key 'value' is missing"},
    {"an expression of measures that ends too early", "measure: {ratio: =runout_99 /}",
     "scene.yaml:11:18: error: cannot evaluate '=runout_99 /': Unexpected end of expression",
     Judge::parser},
    {"a function of measures that there is not", "measure: {ratio: {value: =root(runout_99)}}",
     "scene.yaml:11:26: error: cannot evaluate '=root(runout_99)': 'root' is not a function",
     Judge::parser},
    {"two expressions for a measure", "measure: {ratio: {value: '=runout_99, runout_front'}}",
     "scene.yaml:11:26: error: '=runout_99, runout_front': expected one number, found 2",
     Judge::parser},
    {"a derived measure with the name of a function", "measure: {sqrt: =runout_99}",
     "scene.yaml:11:11: error: measure.sqrt: a name has up to 64 letters, digits and '_', no digit "
     "first, and is not that of a function or constant",
     Judge::parser},
    {"a derived measure twice", "measure: [{ratio: =runout_99}, {ratio: =runout_front}]",
     "scene.yaml:11:33: error: measure.ratio: it is named twice", Judge::parser},
    {"output of an unknown kind", "output: {movie: {every: 10}}",
     "scene.yaml:12:10: error: unknown key 'movie' in output (allowed: frames, view, series, "
     "fields, contacts, trajectory, checkpoint)"},
    {"a trajectory that is neither a map nor none", "output: {trajectory: 10}",
     "scene.yaml:12:22: error: output.trajectory: expected a map or none, found '10'"},
    {"a frame every 0 steps", "output: {trajectory: {every: 0}}",
     "scene.yaml:12:30: error: output.trajectory.every: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"a checkpoint without a time", "output: {checkpoint: {}}",
     "scene.yaml:12:22: error: output.checkpoint: expected every (steps), seconds or both"},
    {"a checkpoint every 0 steps", "output: {checkpoint: {every: 0}}",
     "scene.yaml:12:30: error: output.checkpoint.every: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"a checkpoint that is neither a map nor none", "output: {checkpoint: yes}",
     "scene.yaml:12:22: error: output.checkpoint: expected a map or none, found 'yes'"},
    {"a trajectory with a folder", "output: {trajectory: {folder: here}}",
     "scene.yaml:12:23: error: unknown key 'folder' in output.trajectory (allowed: every, "
     "contacts)"},
    {"frames that are neither a map nor none", "output: {frames: 10}",
     "scene.yaml:12:18: error: output.frames: expected a map or none, found '10'"},
    {"a picture without width", "output: {frames: {width: 0}}",
     "scene.yaml:12:26: error: output.frames.width: expected a whole number from 16 to 65536, "
     "found '0'"},
    {"a picture every 0 steps", "output: {frames: {every: 0}}",
     "scene.yaml:12:26: error: output.frames.every: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"a misspelt colouring", "output: {frames: {color_by: specis}}",
     "scene.yaml:12:29: error: output.frames.color_by: expected one of species, stage_layer, "
     "displacement, speed, spin, coordination, id, axis, force, pressure, found 'specis'; did you "
     "mean "
     "'species'?"},
    {"British spelling", "output: {frames: {colour_by: species}}",
     "scene.yaml:12:19: error: unknown key 'colour_by' in output.frames (allowed: every, "
     "width, height, color_by, range, layers, view, drawing, supersampling, caption, style, "
     "upright, "
     "force_scale, velocity_cell, velocity_scale, overlay); "
     "did you "
     "mean "
     "'color_by'?"},
    {"too much supersampling", "output: {frames: {supersampling: 8}}",
     "scene.yaml:12:34: error: output.frames.supersampling: expected a whole number from 1 to "
     "4, found '8'"},
    {"a view beside the box", "output: {view: [100, 0, 120, 20]}",
     "scene.yaml:12:16: error: output.view: nothing of the box, 100 wide and 50 high, lies in "
     "[100, 0, 120, 20]",
     Judge::parser},
    {"a view inside out", "output: {frames: {view: [10, 0, 5, 20]}}",
     "scene.yaml:12:25: error: output.frames.view: expected [left, bottom, right, top] with "
     "left < right and bottom < top, found [10, 0, 5, 20]",
     Judge::parser},
    {"a caption that is neither true nor false", "output: {frames: {caption: 1}}",
     "scene.yaml:12:28: error: output.frames.caption: expected true or false, found '1'"},
    {"a misspelt none", "output: {series: non}",
     "scene.yaml:12:18: error: output.series: expected a map or none, found 'non'"},
    {"forces without overlap", "output: {frames: {color_by: force}}",
     "scene.yaml:12:29: error: output.frames.color_by: no force without a wall that moves with "
     "passive: overlap",
     Judge::parser},
    {"an overlay of forces without overlap", "output: {frames: {overlay: forces}}",
     "scene.yaml:12:28: error: output.frames.overlay: no forces without a wall that moves with "
     "passive: overlap",
     Judge::parser},
    {"arrows without cycles", "output: {frames: {overlay: arrows}}",
     "scene.yaml:12:28: error: output.frames.overlay: no arrows without a stage that moves a wall "
     "with a wave or a shake, or that turns or shakes the vessel",
     Judge::parser},
    {"a colour bar that falls", "output: {frames: {color_by: displacement, range: [20, 10]}}",
     "scene.yaml:12:50: error: output.frames.range: expected [low, high] with low < high, found "
     "[20, 10]",
     Judge::parser},
    {"a colour bar of colours without one", "output: {frames: {range: [0, 10]}}",
     "scene.yaml:12:26: error: output.frames.range: there is no colour bar with color_by species",
     Judge::parser},
    {"the pressure of the automaton", "output: {frames: {color_by: pressure}}",
     "scene.yaml:12:29: error: output.frames.color_by: pressure goes with model: contact",
     Judge::parser},
    {"the axes of the automaton", "output: {frames: {color_by: axis}}",
     "scene.yaml:12:29: error: output.frames.color_by: axis goes with model: baxter",
     Judge::parser},
    {"the spin of the automaton", "output: {frames: {color_by: spin}}",
     "scene.yaml:12:29: error: output.frames.color_by: spin goes with model: contact",
     Judge::parser},
    {"a misspelt overlay", "output: {frames: {overlay: force}}",
     "scene.yaml:12:28: error: output.frames.overlay: expected one of none, forces, arrows, "
     "velocity, weight_inner, weight_outer, weight_pair, weight_q, found 'force'; did you mean "
     "'forces'?"},
    {"a velocity of nothing as the longest arrow", "output: {frames: {velocity_scale: 0}}",
     "scene.yaml:12:35: error: output.frames.velocity_scale: expected a number above 0 and up to "
     "1000000000, found '0'"},
    {"arrows smaller than sites", "output: {frames: {velocity_cell: 0.5}}",
     "scene.yaml:12:34: error: output.frames.velocity_cell: expected a number from 1 to 1000, "
     "found "
     "'0.5'"},
    {"one arrow for more than the box", "output: {frames: {velocity_cell: 500}}",
     "scene.yaml:12:34: error: output.frames.velocity_cell: expected 1 to 100, the longer side of "
     "the box, found 500",
     Judge::parser},
    {"cells of nothing", "output: {fields: {cell: 0.5}}",
     "scene.yaml:12:25: error: output.fields.cell: expected a number from 1 to 1000, found '0.5'"},
    {"fields every 0 steps", "output: {fields: {every: 0}}",
     "scene.yaml:12:26: error: output.fields.every: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"a misspelt key of fields", "output: {fields: {cells: 8}}",
     "scene.yaml:12:19: error: unknown key 'cells' in output.fields (allowed: cell, every); did "
     "you mean 'cell'?"},
    {"contacts without overlap", "output: {contacts: {every: 2}}",
     "scene.yaml:12:20: error: output.contacts: no contacts without a wall that moves with "
     "passive: overlap",
     Judge::parser},
    {"contacts that are neither a map nor none", "output: {contacts: 10}",
     "scene.yaml:12:20: error: output.contacts: expected a map or none, found '10'"},
});

}  // namespace

std::span<const BadScene> bad_basics() {
  return kBadBasics;
}

}  // namespace clca::scene::testing
