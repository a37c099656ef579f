#pragma once
// The model that moves the grains of a run.

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "clca/automaton/automaton.hpp"
#include "clca/baxter/baxter_model.hpp"
#include "clca/contact/contact_model.hpp"
#include "clca/contact/force.hpp"
#include "clca/reflection/columns.hpp"
#include "clca/scene/scene.hpp"
#include "clca/voids/void_model.hpp"

namespace clca::model {

/// The state of any model; those without more have that of the grains.
using ModelState = std::variant<grains::State, contact::State>;

const grains::State& grains_of(const ModelState& state);
grains::State& grains_of(ModelState& state);
std::uint64_t hash(const ModelState& state);

/// The initial state of a scene, without particles.
ModelState empty_state(const scene::Scene& scene);
/// The state in a checkpoint. Throws reflection::ColumnMismatch or std::invalid_argument if no run
/// of the scene can have saved it.
ModelState state_from_checkpoint(const scene::Scene& scene, const reflection::Columns& columns,
                                 double max_bytes);

/// Memory for a checkpoint of the state of so many particles, in bytes; 0 where there are none.
double checkpoint_bytes(const scene::Scene& scene, double particles);

/// Whether the vessel is tilted or moves in some stage.
bool has_vessel(const scene::Scene& scene);

using AnyModel = std::variant<automaton::Automaton, contact::ContactModel, voids::VoidModel,
                              baxter::BaxterModel>;
using AnyRules = std::variant<automaton::Rules, contact::Parameters, voids::Rules, baxter::Rules>;

class SceneModel {
 public:
  /// Throws as the models do.
  SceneModel(const scene::Scene& scene, ModelState state, const grains::Options& options);

  const grains::Model& grains() const;
  grains::Model& grains();
  const grains::State& state() const { return grains().grains(); }
  std::uint64_t hash() const;
  ModelState copied_state() const;
  /// Saves the state for state_from_checkpoint().
  void save(reflection::Columns& columns) const;
  /// The contact model; null if the scene has another one.
  const contact::ContactModel* contact() const {
    return std::get_if<contact::ContactModel>(&model_);
  }

  // These are empty for other models than contact.
  std::vector<contact::Force> forces() const;
  /// Forces on walls and sides of the box, maybe others, too.
  std::vector<contact::Force> wall_forces() const;
  /// Velocities by id, in lattice spacings per step.
  std::vector<Eigen::Vector2d> velocities() const;
  /// Spins by id, in lattice spacings per step: angular velocities times radii, anticlockwise.
  std::vector<double> spins() const;

  /// Upright and at rest for other models than contact.
  contact::Vessel vessel() const;
  /// Sets the vessel motion of a stage; no effect for other models than contact.
  void set_vessel(const scene::Stage& stage);
  /// Sets what a stage has in place of the rules or the friction of the scene.
  void set_rules(const scene::Stage& stage);
  /// As grains::Model::set_interruption(), whatever the rules.
  void set_interruption(std::function<void()> check);

 private:
  const scene::Scene& scene_;
  grains::Options options_;
  std::function<void()> interruption_ = {};
  AnyRules rules_;
  AnyModel model_;
};

}  // namespace clca::model
