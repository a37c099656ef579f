#include "python/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clca/grains/occupancy.hpp"
#include "clca/measure/force.hpp"
#include "clca/render/body.hpp"

namespace clca::python {

namespace {

std::vector<double> forces(const grains::State& state, const store::ContactFrame& contact) {
  if (!contact.forces.empty()) {
    return contact::loads(state.particles.size(), contact.forces);
  }
  std::vector<double> none(state.particles.size(), 0.0);
  if (state.pushes.empty()) {
    return none;
  }
  const grains::Occupancy occupancy(state);
  return measure::force_indices(state.particles.size(), measure::contacts(state, occupancy));
}

Eigen::Vector2d last_move(grains::Move move) {
  if (move == grains::kRest) {
    return Eigen::Vector2d::Zero();
  }
  return lattice::position(lattice::unit(static_cast<lattice::Direction>(move)));
}

std::vector<Eigen::Vector2d> outline_of(const lattice::Shape& shape) {
  std::vector<Eigen::Vector2d> corners;
  const std::vector<render::Outline> outlines = render::outlines(shape);
  for (const render::GridPoint point : outlines.front()) {
    corners.emplace_back(render::position(point) - shape.centroid());
  }
  return corners;
}

}  // namespace

std::vector<Body> bodies(const grains::State& state, const store::ContactFrame& contact,
                         const std::optional<scene::Conversion>& units) {
  const std::vector<double> force = forces(state, contact);
  const auto& velocities = contact.velocities;
  const double velocity_unit = units ? units->velocity(1) : 1;
  const double time_step = units ? units->time_step : 1;
  std::vector<double> radii;
  for (const grains::Kind& kind : state.kinds) {
    radii.push_back(kind.shape.diameter() / 2);
  }
  std::vector<Body> result;
  result.reserve(grains::present_count(state));
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    const Eigen::Vector2d centre = grains::centre_in_box(state, particle);
    const double beyond = grains::centre(state, particle).x() - centre.x();
    result.push_back(
        {.centre = centre,
         .velocity =
             velocities.empty() ? last_move(particle.previous) : velocity_unit * velocities[id],
         .displacement = lattice::position(particle.site() - state.origins[id]),
         .angular_velocity =
             contact.spins.empty() ? 0 : contact.spins[id] / (radii[particle.kind] * time_step),
         .id = static_cast<std::uint32_t>(id),
         .image = static_cast<int>(std::lround(beyond / state.lattice.size().x())),
         .force = static_cast<float>(force[id]),
         .kind = particle.kind});
  }
  return result;
}

double time_step(const scene::Scene& scene) {
  const auto conversion = scene::conversion(scene);
  return conversion ? conversion->time_step : 1;
}

std::vector<KindAppearance> kind_appearances(const scene::Scene& scene,
                                             const std::vector<grains::Kind>& kinds) {
  std::vector<KindAppearance> looks;
  const std::vector<int> all_degrees = scene::degrees_of(scene, kinds);
  for (std::size_t number = 0; number < kinds.size(); ++number) {
    const grains::Kind& kind = kinds[number];
    const scene::Species& species = scene.species[kind.species];
    const auto same_species =
        std::count_if(kinds.begin(), kinds.end(),
                      [&](const grains::Kind& other) { return other.species == kind.species; });
    const int degrees = all_degrees[number];
    looks.push_back(
        {.name = same_species > 1 ? fmt::format("{}@{}", species.name, degrees) : species.name,
         .species = kind.species,
         .degrees = degrees,
         .outline = outline_of(kind.shape)});
  }
  return looks;
}

}  // namespace clca::python
