#pragma once
// The grains of a run, whichever model moves them.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "clca/automaton/automaton.hpp"
#include "clca/contact/contact_model.hpp"
#include "clca/contact/force.hpp"
#include "clca/fields/columns.hpp"
#include "clca/scene/scene.hpp"

namespace clca::run {

/// What a run changes, by model.
using ModelState = std::variant<grains::State, contact::State>;

const grains::State& grains_of(const ModelState& state);

/// As a scene begins.
ModelState first_state(const scene::Scene& scene);

/// As a checkpoint has it. Throws fields::Mismatch or std::invalid_argument for what no run of the
/// scene can have saved.
ModelState saved_state(const scene::Scene& scene, const fields::Columns& columns,
                       double most_bytes);

/// Whether a vessel stands at an angle or moves in some stage.
bool has_vessel(const scene::Scene& scene);

class Model {
 public:
  struct Options {
    int threads = 1;
    bool reference = false;  ///< steps as the model is defined; of the contact model
  };
  struct Report {
    std::size_t moved = 0;
    std::size_t emitted = 0;
    bool settled = false;
    // Of the contact model; see contact::StepReport.
    bool quiet = false;
    double energy_gained = 0;
  };

  /// Throws as the models do, and ScenePlaceError for a reference of the automaton.
  Model(const scene::Scene& scene, ModelState state, const Options& options);

  const grains::State& state() const;
  const grains::Occupancy& occupancy() const;
  std::uint64_t hash() const;
  /// Saves the state for saved_state().
  void save(fields::Columns& columns) const;
  // Of the contact model; none of the automaton.
  std::optional<contact::Energy> energy() const;
  std::optional<std::vector<contact::Force>> forces() const;
  /// By id, lattice spacings a step; empty of the automaton.
  std::vector<Eigen::Vector2d> velocities() const;
  /// Upright and at rest, of the automaton.
  contact::Vessel vessel() const;

  Report step();
  grains::FillResult fill(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  grains::FillResult deposit(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  void remove_wall(std::size_t wall);
  bool insert_wall(std::size_t wall);
  void set_motion(std::size_t wall, bool active);
  void set_source(std::size_t source, bool open);
  /// Moves the vessel as a stage says; nothing of the automaton.
  void set_vessel(const scene::Stage& stage);
  void mark_origins();

 private:
  const scene::Scene& scene_;
  std::variant<automaton::Automaton, contact::ContactModel> model_;
  double gravity_ = 0;  // of the contact model, lattice spacings per step squared
};

}  // namespace clca::run
