#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "clca/model/initial_state.hpp"
#include "clca/random/draw.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "grains/internal/filling.hpp"
#include "run/stage.hpp"

namespace clca::run {

namespace {

namespace fs = std::filesystem;

/// A run that the scene begins with, and the state that it takes.
struct OtherRun {
  scene::Scene scene;
  model::ModelState state;
};

[[noreturn]] void refuse(const scene::InitialState& begin, const std::string& reason) {
  throw scene::SceneError(fmt::format("{}: error: begin: {}", begin.location, reason));
}

OtherRun end_state_of(const fs::path& folder, const store::RunSummary& summary, double max_bytes) {
  if (summary.status != "done") {
    throw store::StoreError(
        fmt::format("the run in {} is {}, not done; continue it with clca resume", folder.string(),
                    summary.status));
  }
  const auto found = store::read_checkpoint(folder, max_bytes);
  if (found && !found->warning.empty()) {  // it is an earlier one
    throw store::StoreError(fmt::format(
        "the run in {} has lost the checkpoint of its end; run it again, or name a step "
        "of its trajectory",
        folder.string()));
  }
  if (found && found->checkpoint.is_before_first_step()) {
    throw store::StoreError(fmt::format("a new run begins in {}", folder.string()));
  }
  if (!found) {
    throw store::StoreError(
        fmt::format("the run in {} has kept no checkpoint of its end (output.checkpoint: none); "
                    "name a step of its trajectory",
                    folder.string()));
  }
  scene::Scene scene =
      scene::parse(found->checkpoint.scene_text, (folder / store::kSceneFile).string());
  model::ModelState state =
      model::state_from_checkpoint(scene, found->checkpoint.fields, max_bytes);
  if (model::hash(state) != summary.state_hash) {
    throw store::StoreError(
        fmt::format("the checkpoint in {} is not of the end of the run", folder.string()));
  }
  return {std::move(scene), std::move(state)};
}

/// The first frame of the step: before what the next stage begins with.
OtherRun frame_state_of(const fs::path& folder, const store::RunSummary& summary,
                        std::uint64_t step, double max_bytes) {
  scene::Scene scene = scene::parse_file(folder / store::kSceneFile);
  scene.name = summary.scene;
  const store::Trajectory trajectory(folder, scene, model::initial_state(scene), max_bytes);
  const auto& frames = trajectory.frames();
  const auto frame = std::ranges::find_if(
      frames, [step](const store::Trajectory::Frame& candidate) { return candidate.step == step; });
  if (frame == frames.end()) {
    throw store::StoreError(
        fmt::format("the trajectory in {} has no frame of step {}", folder.string(), step));
  }
  model::ModelState state = trajectory.state(static_cast<std::size_t>(frame - frames.begin()));
  return {std::move(scene), std::move(state)};
}

OtherRun other_run(const scene::InitialState& begin, double max_bytes) {
  try {
    const fs::path folder = begin.run_folder;
    const store::RunSummary summary = store::read_summary(folder / store::kSummaryFile);
    OtherRun run = begin.step ? frame_state_of(folder, summary, *begin.step, max_bytes)
                              : end_state_of(folder, summary, max_bytes);
    const std::uint64_t found = model::hash(run.state);
    if (begin.state_hash && *begin.state_hash != found) {
      throw store::StoreError(
          fmt::format("the state in {} has changed: found {:016x}, expected {:016x}",
                      begin.run_folder, found, *begin.state_hash));
    }
    if (grains::present_count(model::grains_of(run.state)) == 0) {
      throw store::StoreError(fmt::format("no particles are left in {}", begin.run_folder));
    }
    return run;
  } catch (const std::runtime_error& error) {
    refuse(begin, error.what());
  } catch (const std::invalid_argument& error) {
    refuse(begin, fmt::format("cannot read the state in {}: {}", begin.run_folder, error.what()));
  }
}

/// A kind of the other run as one of this run, and where its reference site is from there.
struct SameKind {
  std::uint16_t kind = 0;
  lattice::Axial shift = {};
};

SameKind same_kind(const scene::Scene& scene, const std::vector<grains::Kind>& kinds,
                   const scene::Species& species, const lattice::Shape& shape) {
  const auto known = std::ranges::find_if(
      scene.species, [&](const scene::Species& own) { return own.name == species.name; });
  if (known == scene.species.end()) {
    refuse(*scene.initial_state,
           fmt::format("{} has particles of a species '{}', the scene has none",
                       scene.initial_state->run_folder, species.name));
  }
  const auto number = known - scene.species.begin();
  const auto same = std::ranges::find_if(kinds, [&](const grains::Kind& kind) {
    return kind.species == number && kind.shape.is_congruent(shape);
  });
  if (same == kinds.end()) {
    refuse(*scene.initial_state,
           fmt::format("particles of species '{}' in {} have a shape or an orientation that the "
                       "scene does not give this species",
                       species.name, scene.initial_state->run_folder));
  }
  return {static_cast<std::uint16_t>(same - kinds.begin()),
          shape.sites().front() - same->shape.sites().front()};
}

std::vector<std::size_t> present_ids(const grains::State& state) {
  std::vector<std::size_t> ids;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    if (state.particles[id].present) {
      ids.push_back(id);
    }
  }
  return ids;
}

/// The axis of the grain that comes next, as if it were deposited.
std::uint16_t random_axis(const grains::State& state) {
  const auto id = static_cast<std::uint32_t>(state.particles.size());
  return static_cast<std::uint16_t>(random::uniform_below(
      random::draw(state.seed, 0, id, random::Purpose::deposit_kind), baxter::kAxisCount));
}

void take_grains(const scene::Scene& scene, const OtherRun& other,
                 const std::vector<std::size_t>& ids, grains::State& state) {
  const grains::State& there = model::grains_of(other.state);
  std::vector<std::optional<SameKind>> kinds(there.kinds.size());
  grains::Box box(state);
  const bool same_period =
      there.lattice.periodic() && there.lattice.columns() == state.lattice.columns();
  std::size_t without_room = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  for (const std::size_t id : ids) {
    grains::Particle particle = there.particles[id];
    auto& same = kinds[particle.kind];
    if (!same) {
      const grains::Kind& kind = there.kinds[particle.kind];
      same = same_kind(scene, state.kinds, other.scene.species[kind.species], kind.shape);
    }
    const lattice::Site site =
        lattice::Site{there.lattice.wrapped(particle.column), particle.row} + same->shift;
    particle.column = site.column;
    particle.row = site.row;
    particle.kind = same->kind;
    if (scene.model == scene::Model::baxter) {
      const std::uint16_t axis = other.scene.model == scene.model
                                     ? baxter::axis_of(there.particles[id])
                                     : random_axis(state);
      particle.kind = static_cast<std::uint16_t>(same->kind + axis);
    }
    if (scene.model != other.scene.model) {
      particle.previous = grains::kRest;
    }
    const bool inside = same_period || (site.column >= 0 && site.column < state.lattice.columns());
    if (inside && grains::fits(box, particle)) {
      grains::insert(box, particle);
    } else if (without_room++ == 0) {
      first = grains::centre_in_box(there, there.particles[id]);
    }
  }
  if (without_room > 0) {
    refuse(*scene.initial_state,
           fmt::format("{} of the {} particles in {} lie outside the box, on a wall or on another "
                       "particle, the first at [{:.2f}, {:.2f}]",
                       without_room, ids.size(), scene.initial_state->run_folder, first.x(),
                       first.y()));
  }
}

void remove_at_outlets(grains::State& state) {
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    if (grains::count_at_outlet(state, id)) {
      state.particles[id].present = false;
      state.particles[id].previous = grains::kRest;
    }
  }
}

/// `factor` times `value`, rounded, from -`most` to `most`.
std::int32_t scaled(double factor, std::int32_t value, double most) {
  return static_cast<std::int32_t>(std::llround(std::clamp(factor * value, -most, most)));
}

/// Contacts of the other run as those of this one, if both bodies are here. The model drops
/// contacts of bodies that do not touch. `force`: factor of the impulses.
void take_contacts(const contact::State& other, const std::vector<std::size_t>& ids, double force,
                   contact::State& state) {
  const grains::State& there = other.grains;
  const grains::State& here = state.grains;
  const grains::Occupancy sites_there(there);
  const grains::Occupancy sites_here(here);
  std::vector<grains::Owner> owners(there.particles.size(), grains::kFree);  // here, by id there
  for (std::size_t id = 0; id < ids.size(); ++id) {
    if (here.particles[id].present) {
      owners[ids[id]] = grains::as_owner(id);
    }
  }
  // The wall that the particle touches here where it touches `wall` there.
  const auto wall_in_place_of = [&](grains::Owner wall, const grains::Particle& particle) {
    for (const lattice::Direction direction : lattice::kDirections) {
      for (const lattice::Axial side : here.shape(particle).lead_sites(direction)) {
        const lattice::Site site = particle.site() + side;
        const grains::Owner found = sites_here.owner(here.lattice.index(site));
        if (sites_there.owner(there.lattice.index(site)) == wall && grains::is_obstacle(found) &&
            found != grains::kBorder) {
          return found;
        }
      }
    }
    return grains::kFree;
  };
  const auto impulse = [force](std::int32_t value) {
    return scaled(force, value, contact::kMaxImpulse);
  };
  std::set<std::pair<std::uint32_t, grains::Owner>> known;
  for (contact::Contact contact : other.contacts) {
    const grains::Owner upper = owners[contact.upper];
    if (upper == grains::kFree) {
      continue;
    }
    contact.upper = static_cast<std::uint32_t>(upper);
    if (grains::is_particle(contact.other)) {
      contact.other = owners[static_cast<std::size_t>(contact.other)];
    } else if (contact.other > contact::kRightSide) {
      contact.other = wall_in_place_of(contact.other, here.particles[contact.upper]);
    }
    if (contact.other != grains::kFree && known.emplace(contact.upper, contact.other).second) {
      for (contact::Impulse<>* part : {&contact.impulse, &contact.transient}) {
        *part = {impulse(part->normal), impulse(part->shear), impulse(part->rolling)};
      }
      state.contacts.push_back(contact);
    }
  }
}

/// A time step of another length changes velocities, in spacings a step, and impulses.
void take_motion(const scene::Scene& scene, const OtherRun& other,
                 const std::vector<std::size_t>& ids, contact::State& state) {
  state.velocities.resize(ids.size());
  state.remainders.resize(ids.size());
  const auto* there = std::get_if<contact::State>(&other.state);
  if (there == nullptr) {
    return;
  }
  const double gravity = contact::gravity(scene::contact_parameters(scene)) /
                         contact::gravity(scene::contact_parameters(other.scene));
  const auto velocity = [longer = std::sqrt(gravity)](std::int32_t value) {
    return scaled(longer, value, contact::kMaxVelocity);
  };
  for (std::size_t id = 0; id < ids.size(); ++id) {
    if (state.grains.particles[id].present) {
      const auto& old = there->velocities[ids[id]];
      state.velocities[id] = {velocity(old.x), velocity(old.y), velocity(old.spin)};
      state.remainders[id] = there->remainders[ids[id]];
    }
  }
  take_contacts(
      *there, ids,
      gravity * contact::mass_unit(there->grains.kinds) / contact::mass_unit(state.grains.kinds),
      state);
}

}  // namespace

model::ModelState state_at_start(const scene::Scene& scene) {
  model::ModelState state = model::empty_state(scene);
  if (!scene.initial_state) {
    return state;
  }
  const OtherRun other = other_run(*scene.initial_state, std::numeric_limits<double>::infinity());
  const std::vector<std::size_t> ids = present_ids(model::grains_of(other.state));
  take_grains(scene, other, ids, model::grains_of(state));
  remove_at_outlets(model::grains_of(state));
  if (auto* contact = std::get_if<contact::State>(&state)) {
    take_motion(scene, other, ids, *contact);
  }
  return state;
}

void resolve_begin(scene::Scene& scene, double max_bytes) {
  if (!scene.initial_state || scene.initial_state->particles > 0) {
    return;
  }
  const OtherRun other = other_run(*scene.initial_state, max_bytes);
  scene.initial_state->state_hash = model::hash(other.state);
  scene.initial_state->particles = grains::present_count(model::grains_of(other.state));
}

}  // namespace clca::run
