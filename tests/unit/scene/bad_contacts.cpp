// Wrong for the contact model, or for the other one.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kScenes = std::to_array<BadScene>({
    {"a misspelt model", "model: contct",
     "scene.yaml:6:8: error: model: expected one of automaton, contact, found 'contct'; did you "
     "mean 'contact'?"},
    {"a model that is a map", "model: {contact: {}}",
     "scene.yaml:6:8: error: model: expected one of automaton, contact, found a map"},
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
     "scene.yaml:13:10: error: contact: expected a map, found 'default'"},
    {"a misspelt key", "contact: {frictoin: 0.2}",
     "scene.yaml:13:11: error: unknown key 'frictoin' in contact (allowed: friction, "
     "wall_friction, rolling, rolling_friction, restitution, sweeps, resolution, fall_height); did "
     "you mean 'friction'?"},
    {"a negative friction", "contact: {friction: -0.1}",
     "scene.yaml:13:21: error: contact.friction: expected a number from 0 to 1000000000, found "
     "'-0.1'"},
    {"too much friction of walls", "contact: {wall_friction: 1.1e9}",
     "scene.yaml:13:26: error: contact.wall_friction: expected a number from 0 to 1000000000, "
     "found "
     "'1.1e9'"},
    {"a misspelt rolling", "contact: {rolling: resistence}",
     "scene.yaml:13:20: error: contact.rolling: expected one of none, resistance, free, found "
     "'resistence'; did you mean 'resistance'?"},
    {"a negative friction of rolling", "contact: {rolling_friction: -1}",
     "scene.yaml:13:29: error: contact.rolling_friction: expected a number from 0 to 1000000000, "
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
     "scene.yaml:7:46: error: walls.left.friction: expected a number from 0 to 1000000000, found "
     "'-1'"},
    {"rods, which do not roll",
     "species: {small: {shape: {hexagon: 1}}, large: {shape: {rod: {radius: 0, length: 2}}}}",
     "scene.yaml:5:41: error: species.large: only hexagons roll; give it the shape of one, or say "
     "'contact.rolling: none'",
     Judge::parser},
    {"a shape with as many sites as a hexagon that rolls freely",
     "species: {small: {shape: {rod: {radius: 0, length: 7}}}, large: {shape: {hexagon: 1}}}\n"
     "contact: {rolling: free}",
     "scene.yaml:5:11: error: species.small: only hexagons roll; give it the shape of one, or say "
     "'contact.rolling: none'",
     Judge::parser},
    {"a wall that moves",
     "walls: {plate: {box: [10, 40, 20, 42], motion: {direction: down, distance: 9}}}\n"
     "stages: [{name: first, sources: [spout], move: [plate]}]",
     "scene.yaml:7:40: error: walls.plate.motion: model contact moves no walls yet, model "
     "automaton "
     "does; remove it, or say 'model: automaton'",
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
  return kScenes;
}

}  // namespace clca::scene::testing
