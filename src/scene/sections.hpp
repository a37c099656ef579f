#pragma once
// The parts of the format, and checks across them. All throw SceneError.

#include <cstdint>
#include <vector>

#include "clca/scene/boltzmann.hpp"
#include "scene/key.hpp"

namespace clca::scene {

/// A scene of grains, and one of the Boltzmann equation.
const Type<Scene>& scene_type();
const Type<BoltzmannScene>& boltzmann_type();

Type<std::string> text_line_type();
/// The block of each model, and other keys of one model.
Keys<Scene> model_blocks();
/// Rules of a stage; missing keys have the values of the scene.
Type<automaton::Rules> stage_rules_type();
Type<contact::Parameters> stage_contact_type();
Type<Units> units_type();
Type<std::vector<Species>> species_type();
Type<std::vector<Wall>> walls_type();
Type<lattice::Picture> picture_type();
Type<std::vector<Source>> sources_type();
Type<std::vector<Outlet>> outlets_type();
Type<std::vector<Probe>> probes_type();
Type<std::vector<Line>> lines_type();
/// `stages.flow`, or the number where there is no name to go by.
std::string stage_path(const Value& value, std::size_t number);
Type<Fill> fill_type();
Type<std::vector<Stage>> stages_type();
/// `measure`: requested and derived measures.
Key<Scene> measure_key();
Type<Output> output_type();
/// CheckpointIntervals of a gas: by seconds only.
Type<CheckpointIntervals> gas_checkpoint_type();
Key<BoltzmannScene> boltzmann_block_key();
Key<BoltzmannScene> boltzmann_output_key();
/// Refuses a series of too many rows.
void check_series_rows(const PlacedValue& root, const BoltzmannScene& scene);

/// Sets `max_steps` of stages, and the steps of those that end at a time; needs the time step.
/// `list` is the value that the stages were read from.
void set_max_steps(Scene& scene, const Value& list);

/// In the expressions of derived measures, replaces names of keys by their numbers.
void put_numbers_into_derived(Scene& scene);

/// Checks that names of stages are unique, and that walls are inserted, moved and removed in a
/// possible order. `list` is the value that the stages were read from.
void check_stage_order(const PlacedValue& list);
/// Whether a wall lets particles overlap.
bool walls_may_overlap(const Scene& scene);
/// Refuses paths of weight where particles may overlap or gravity may turn.
void check_weight_paths(const PlacedValue& place);
/// Refuses what the model cannot do.
void check_model(const PlacedValue& root);
/// Contact model: resolution, fall height (which may depend on stages) and vessels.
void check_time_step(const PlacedValue& root);
/// Refuses species, sources, moving walls, probes and lines that nothing uses, walls that have the
/// number of a particle as name, and a scene without particles.
void check_unused_items(const PlacedValue& root);

}  // namespace clca::scene
