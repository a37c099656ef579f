#pragma once
// Parsers for the parts of a scene. All throw SceneError.

#include "clca/lattice/lattice.hpp"
#include "clca/scene/boltzmann.hpp"
#include "clca/scene/scene.hpp"
#include "scene/value.hpp"

namespace clca::scene {

std::string read_title(const Value& value);
Box read_box(const Value& value);
lattice::Lattice lattice_of(const Box& box);

/// The shape and how it was given.
struct ReadShape {
  ShapeSpec spec;
  lattice::Shape shape;
};
ReadShape read_shape(const Value& value, const std::string& path);
std::vector<Species> read_species(const Value& value, const Box& box);
automaton::Rules read_rules(const Value& value);
contact::Parameters read_contact(const Value& value);
Units read_units(const Value& value);

/// [left, bottom, right, top], not empty.
lattice::Rectangle read_rectangle(const Value& value, const std::string& path);
/// A rectangle that holds at least one site of the box.
lattice::Rectangle read_region(const Value& value, const std::string& path, const Box& box);
/// `[left, bottom, right, top]`
std::string shown(const lattice::Rectangle& edges);
/// [x, y]
Eigen::Vector2d read_point(const Value& value, const std::string& path);
/// True when no site of the lattice lies in the rectangle; costs nothing.
bool holds_no_site(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle);

grains::WallMotion read_motion(const Value& value, const std::string& path);

// These take the part of the scene parsed so far: its box and all names referred to.
std::vector<Wall> read_walls(const Value& value, const Scene& scene);
std::vector<Source> read_sources(const Value& value, const Scene& scene);
std::vector<Outlet> read_outlets(const Value& value, const Scene& scene);
std::vector<Stage> read_stages(const Value& value, const Scene& scene);

VesselMotion read_vessel(const Value& value, const std::string& path, const Box& box);

class KeyedMap;
/// The end of a stage that has been read as far as what it moves.
Until read_until(const Value& value, const std::string& path, const Stage& stage,
                 const Scene& scene);
/// The maximum steps of a stage parsed so far; rejects ends that can never come.
std::uint64_t read_max_steps(const KeyedMap& fields, const Stage& stage, const Scene& scene);

/// The steps of stages until a time, once all that the time step follows from has been read.
/// `list` is what the stages were read from.
void count_steps(Scene& scene, const Value& list);

std::vector<Measure> read_measures(const Value& value);
Output read_output(const Value& value, const Scene& scene);
/// True where a part of the output is left out, or said to be `none`.
bool is_none(const Value* value);

/// The block `boltzmann`, into the scene.
void read_boltzmann(const Value& value, BoltzmannScene& scene);
/// What is to be written, once the block has been read; `output` is null where nothing is said.
void read_boltzmann_output(const Value* output, const Value& block, BoltzmannScene& scene);

/// Across stages: names are unique, and walls come, move and go in an order that can be. `list` is
/// what the stages were read from.
void check_history(const Scene& scene, const Value& list);
/// Checks what the model supports, for a scene parsed up to its walls; before stages and output, so
/// that no message asks for something unsupported.
void check_model(const Scene& scene, const Value& root);
/// Contact model: resolution, fall height (which may depend on stages) and vessels.
void check_time_step(const Scene& scene, const Value& root);
/// Forces between sleeping grains are not updated, so a scene must not request them.
void check_sleeping(const Scene& scene, const Value& root);
/// Checks the scene as a whole: every species, source and motion is used, and there are particles.
void check_use(const Scene& scene, const Value& root);

}  // namespace clca::scene
