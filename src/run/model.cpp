#include "run/model.hpp"

#include <algorithm>
#include <utility>

#include "clca/run/run.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/contact.hpp"
#include "run/other_run.hpp"

namespace clca::run {

namespace {

constexpr const char* kState = "state";

using AnyModel = std::variant<automaton::Automaton, contact::ContactModel>;
using AnyRules = std::variant<automaton::Rules, contact::Parameters>;

AnyModel make_model(const scene::Scene& scene, const AnyRules& rules, ModelState state,
                    const Model::Options& options) {
  if (auto* grains = std::get_if<grains::State>(&state)) {
    automaton::Options model = {.threads = options.threads, .reference = options.reference};
    model.parallel_from = options.parallel_from.value_or(model.parallel_from);
    return automaton::Automaton(std::move(*grains), std::get<automaton::Rules>(rules), model);
  }
  std::vector<std::optional<double>> friction;
  for (const scene::Wall& wall : scene.walls) {
    friction.push_back(wall.friction);
  }
  contact::Options model = {
      .wall_friction = friction, .reference = options.reference, .threads = options.threads};
  model.split_from = options.parallel_from.value_or(model.split_from);
  return contact::ContactModel(std::get<contact::State>(std::move(state)),
                               std::get<contact::Parameters>(rules), model);
}

AnyRules rules_in(const scene::Scene& scene, const scene::Stage& stage) {
  if (scene.model == scene::Model::contact) {
    return scene::contact_parameters(scene, stage);
  }
  return stage.rules.value_or(scene.rules);
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

ModelState first_state(const scene::Scene& scene) {
  ModelState state = empty_state(scene);
  if (scene.begin) {
    take_particles(scene, state);
  }
  return state;
}

ModelState saved_state(const scene::Scene& scene, const reflection::Columns& columns,
                       double max_bytes) {
  const grains::State beginning = initial_state(scene);
  ModelState saved = empty_state(scene);
  std::visit([&](auto& state) { reflection::decode(kState, columns, max_bytes, state); }, saved);
  grains::check_reachable(grains_of(saved), beginning);
  return saved;
}

bool has_vessel(const scene::Scene& scene) {
  return std::any_of(scene.stages.begin(), scene.stages.end(),
                     [](const scene::Stage& stage) { return stage.vessel.has_value(); });
}

Model::Model(const scene::Scene& scene, ModelState state, const Options& options)
    : scene_(scene),
      options_(options),
      rules_(rules_in(scene, {})),
      model_(make_model(scene, rules_, std::move(state), options)) {}

const grains::State& Model::state() const {
  if (const auto* contact = std::get_if<contact::ContactModel>(&model_)) {
    return contact->grains();
  }
  return std::get<automaton::Automaton>(model_).state();
}

grains::Occupancy Model::occupancy() const {
  return std::visit([](const auto& model) { return model.occupancy(); }, model_);
}

std::uint64_t Model::hash() const {
  const auto* contact = std::get_if<contact::ContactModel>(&model_);
  return contact != nullptr ? contact::hash(contact->state()) : grains::hash(state());
}

void Model::save(reflection::Columns& columns) const {
  std::visit([&](const auto& model) { reflection::encode(kState, model.state(), columns); },
             model_);
}

std::optional<contact::Energy> Model::energy() const {
  if (const auto* contact = std::get_if<contact::ContactModel>(&model_)) {
    return contact::energy(contact->state(), contact->gravity());
  }
  return std::nullopt;
}

std::optional<std::vector<contact::Force>> Model::forces() const {
  if (const auto* contact = std::get_if<contact::ContactModel>(&model_)) {
    return contact::forces(contact->state(), contact->gravity());
  }
  return std::nullopt;
}

std::vector<Eigen::Vector2d> Model::velocities() const {
  std::vector<Eigen::Vector2d> result;
  if (const auto* contact = std::get_if<contact::ContactModel>(&model_)) {
    for (const auto& velocity : contact->state().velocities) {
      result.emplace_back(Eigen::Vector2d(velocity.x, velocity.y) / contact::kSpacing);
    }
  }
  return result;
}

contact::Vessel Model::vessel() const {
  const auto* contact = std::get_if<contact::ContactModel>(&model_);
  return contact != nullptr ? contact->vessel() : contact::Vessel();
}

lattice::Direction Model::down() const {
  if (const auto* automaton = std::get_if<automaton::Automaton>(&model_)) {
    return automaton->rules().gravity;
  }
  return contact::down(vessel());
}

Model::Report Model::step() {
  return std::visit(
      [](auto& model) {
        const auto report = model.step();
        Report result = {
            .moved = report.moved, .emitted = report.emitted, .settled = report.settled};
        if constexpr (std::is_same_v<decltype(report), const contact::StepReport>) {
          result.quiet = report.quiet;
          result.exchange = report.exchange;
        }
        return result;
      },
      model_);
}

grains::FillResult Model::fill(const lattice::Rectangle& region,
                               std::span<const std::size_t> counts) {
  return std::visit([&](auto& model) { return model.fill(region, counts); }, model_);
}

grains::FillResult Model::deposit(const lattice::Rectangle& region,
                                  std::span<const std::size_t> counts) {
  return std::visit([&](auto& model) { return model.deposit(region, counts); }, model_);
}

grains::FillResult Model::fill(const lattice::Rectangle& region, const grains::Mixture& mixture) {
  return std::visit([&](auto& model) { return model.fill(region, mixture); }, model_);
}

void Model::remove_wall(std::size_t wall) {
  std::visit([&](auto& model) { model.remove_wall(wall); }, model_);
}

bool Model::insert_wall(std::size_t wall) {
  return std::visit([&](auto& model) { return model.insert_wall(wall); }, model_);
}

void Model::set_motion(std::size_t wall, bool active) {
  std::visit([&](auto& model) { model.set_motion(wall, active); }, model_);
}

void Model::set_source(std::size_t source, bool open) {
  std::visit([&](auto& model) { model.set_source(source, open); }, model_);
}

void Model::set_vessel(const scene::Stage& stage) {
  if (auto* contact = std::get_if<contact::ContactModel>(&model_)) {
    contact->set_vessel(vessel_in(scene_, stage, contact->vessel()));
  }
}

void Model::set_rules(const scene::Stage& stage) {
  const AnyRules rules = rules_in(scene_, stage);
  if (rules == rules_) {
    return;
  }
  // Beside the old one, which the summary of the run needs if there is no memory for another.
  ModelState state = std::visit([](auto& model) { return ModelState(model.state()); }, model_);
  model_ = make_model(scene_, rules, std::move(state), options_);
  rules_ = rules;
}

void Model::mark_origins() {
  std::visit([](auto& model) { model.mark_origins(); }, model_);
}

}  // namespace clca::run
