#include "model/internal/scene_model.hpp"

#include <algorithm>
#include <utility>

#include "clca/model/initial_state.hpp"
#include "clca/scene/units.hpp"

namespace clca::model {

namespace {

constexpr const char* kState = "state";  // path of the columns of a state

AnyModel make_model(const AnyRules& rules, ModelState state, const grains::Options& options) {
  if (const auto* contact = std::get_if<contact::Parameters>(&rules)) {
    return contact::ContactModel(std::get<contact::State>(std::move(state)), *contact, options);
  }
  auto& grains = std::get<grains::State>(state);
  if (const auto* voids = std::get_if<voids::Rules>(&rules)) {
    return voids::VoidModel(std::move(grains), *voids, options);
  }
  if (const auto* baxter = std::get_if<baxter::Rules>(&rules)) {
    return baxter::BaxterModel(std::move(grains), *baxter, options);
  }
  return automaton::Automaton(std::move(grains), std::get<automaton::Rules>(rules), options);
}

AnyRules rules_in(const scene::Scene& scene, const scene::Stage& stage) {
  if (scene.model == scene::Model::contact) {
    return scene::contact_parameters(scene, stage);
  }
  if (scene.model == scene::Model::voids) {
    voids::Rules rules = scene.voids_rules;
    for (const scene::Species& species : scene.species) {
      rules.sieve_factors.push_back(species.sieve);
    }
    return rules;
  }
  if (scene.model == scene::Model::baxter) {
    return scene.baxter_rules;
  }
  return stage.automaton_rules.value_or(scene.automaton_rules);
}

/// Forces of contacts and of blocked collisions in the last step, one for each pair.
std::vector<contact::Force> forces_with_blocked(const contact::ContactModel& model,
                                                std::span<const contact::Contact> contacts) {
  std::vector<contact::Force> of_contacts =
      contact::forces(model.grains(), contacts, model.gravity());
  const std::vector<contact::Contact>& blocked = model.last_step().blocked_collisions;
  if (blocked.empty()) {
    return of_contacts;
  }
  std::vector<contact::Force> all = contact::forces(model.grains(), blocked, model.gravity());
  all.insert(all.end(), of_contacts.begin(), of_contacts.end());  // last: theirs are the normals
  contact::ForceSums sums;
  contact::add(sums, all, contact::mean_grain_mass(model.grains()));
  std::vector<contact::Force> result = contact::mean_forces(sums);
  std::ranges::for_each(result, [](contact::Force& force) { force.share = 1; });
  return result;
}

}  // namespace

const grains::State& grains_of(const ModelState& state) {
  const auto* contact = std::get_if<contact::State>(&state);
  return contact != nullptr ? contact->grains : std::get<grains::State>(state);
}

grains::State& grains_of(ModelState& state) {
  return const_cast<grains::State&>(grains_of(std::as_const(state)));
}

std::uint64_t hash(const ModelState& state) {
  const auto* contact = std::get_if<contact::State>(&state);
  return contact != nullptr ? contact::hash(*contact) : grains::hash(grains_of(state));
}

ModelState empty_state(const scene::Scene& scene) {
  grains::State grains = initial_state(scene);
  if (scene.model == scene::Model::contact) {
    const std::size_t walls = grains.walls.size();
    return contact::State{.grains = std::move(grains),
                          .wall_remainders = std::vector<std::int64_t>(walls)};
  }
  return grains;
}

ModelState state_from_checkpoint(const scene::Scene& scene, const reflection::Columns& columns,
                                 double max_bytes) {
  const grains::State beginning = initial_state(scene);
  ModelState saved = empty_state(scene);
  std::visit([&](auto& state) { reflection::decode(kState, columns, max_bytes, state); }, saved);
  grains::check_reachable(grains_of(saved), beginning);
  return saved;
}

double checkpoint_bytes(const scene::Scene& scene, double particles) {
  if (!scene.output.checkpoint) {
    return 0;
  }
  constexpr double kCopies = 2;  // as columns and as a file
  const double motion = scene.model == scene::Model::contact
                            ? sizeof(contact::Velocity<std::int32_t>) + sizeof(contact::Vector) +
                                  sizeof(lattice::Axial) +
                                  contact::kContactsPerGrain * sizeof(contact::Contact)
                            : 0;
  return kCopies * particles * (sizeof(grains::Particle) + sizeof(lattice::Site) + motion);
}

bool has_vessel(const scene::Scene& scene) {
  return std::ranges::any_of(
      scene.stages, [](const scene::Stage& stage) { return stage.vessel_motion.has_value(); });
}

SceneModel::SceneModel(const scene::Scene& scene, ModelState state, const grains::Options& options)
    : scene_(scene),
      options_(options),
      rules_(rules_in(scene, {})),
      model_(make_model(rules_, std::move(state), options)) {}

const grains::Model& SceneModel::grains() const {
  return std::visit([](const auto& model) -> const grains::Model& { return model; }, model_);
}

grains::Model& SceneModel::grains() {
  return std::visit([](auto& model) -> grains::Model& { return model; }, model_);
}

std::uint64_t SceneModel::hash() const {
  return contact() != nullptr ? contact::hash(contact()->state()) : grains::hash(state());
}

ModelState SceneModel::copied_state() const {
  return std::visit([](const auto& model) { return ModelState(model.state()); }, model_);
}

void SceneModel::save(reflection::Columns& columns) const {
  std::visit([&](const auto& model) { reflection::encode(kState, model.state(), columns); },
             model_);
}

std::vector<contact::Force> SceneModel::forces() const {
  return contact() != nullptr ? forces_with_blocked(*contact(), contact()->state().contacts)
                              : std::vector<contact::Force>();
}

std::vector<contact::Force> SceneModel::wall_forces() const {
  return contact() != nullptr ? forces_with_blocked(*contact(), contact()->wall_contacts())
                              : std::vector<contact::Force>();
}

std::vector<Eigen::Vector2d> SceneModel::velocities() const {
  std::vector<Eigen::Vector2d> result;
  if (contact() != nullptr) {
    for (const auto& velocity : contact()->state_with_old_contacts().velocities) {
      result.emplace_back(Eigen::Vector2d(velocity.x, velocity.y) / contact::kSpacing);
    }
  }
  return result;
}

std::vector<double> SceneModel::spins() const {
  std::vector<double> result;
  if (contact() != nullptr) {
    for (const auto& velocity : contact()->state_with_old_contacts().velocities) {
      result.push_back(static_cast<double>(velocity.spin) / contact::kSpacing);
    }
  }
  return result;
}

contact::Vessel SceneModel::vessel() const {
  return contact() != nullptr ? contact()->state_with_old_contacts().vessel : contact::Vessel();
}

void SceneModel::set_vessel(const scene::Stage& stage) {
  if (auto* contact = std::get_if<contact::ContactModel>(&model_)) {
    contact->set_vessel(vessel_at_start(scene_, stage, contact->state_with_old_contacts().vessel));
  }
}

void SceneModel::set_rules(const scene::Stage& stage) {
  const AnyRules rules = rules_in(scene_, stage);
  if (rules == rules_) {
    return;
  }
  // Beside the old one, which the summary of the run needs if there is no memory for another.
  model_ = make_model(rules, copied_state(), options_);
  rules_ = rules;
  grains().set_interruption(interruption_);
}

void SceneModel::set_interruption(std::function<void()> check) {
  interruption_ = std::move(check);
  grains().set_interruption(interruption_);
}

}  // namespace clca::model
