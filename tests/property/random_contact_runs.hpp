#pragma once
// Random runs of the contact model: boxes, shapes, walls, sources, outlets, parameters, and what
// changes on the way.

#include <rapidcheck.h>

#include "clca/contact/contact_model.hpp"
#include "property/random_motions.hpp"

namespace clca::testing {

struct ContactRun {
  contact::State state;  ///< grains that have been filled in, perhaps in motion
  contact::Parameters parameters;
  // Steps before which something happens; what comes later than the last step, or is -1, does not.
  int wall_goes = 0;
  int wall_comes = 0;
  int source_opens = 0;
  int more_grains = 0;
  int vessel_moves = 0;
  contact::Vessel vessel = {};

  contact::ContactModel model(const contact::Options& options = {}) const {
    return model_from(state, options);
  }
  contact::ContactModel model_from(const contact::State& from,
                                   const contact::Options& options = {}) const {
    return contact::ContactModel(from, parameters, options);
  }
  /// One step, and before it what is due. `number` counts from 0.
  grains::StepReport step(contact::ContactModel& model, int number) const {
    if (!state.grains.walls.empty()) {
      if (number == wall_goes) {
        model.remove_wall(0);
      }
      if (number == wall_comes) {
        model.insert_wall(0);
      }
    }
    if (!state.grains.sources.empty() && number == source_opens) {
      model.set_source_open(0, true);
    }
    if (number == more_grains) {
      model.fill({0, 0, 1e3, 1e3}, std::vector<std::size_t>(state.grains.kinds.size(), 3));
    }
    if (number == vessel_moves) {
      model.set_vessel(vessel);
    }
    return model.step();
  }
};

inline contact::Parameters any_contact_parameters(bool round) {
  using contact::Rolling;
  contact::Parameters parameters;
  const auto friction = [] {
    return *rc::gen::element(0.0, 0.1, 0.4, 1.0, 10.0, contact::kMaxFriction);
  };
  parameters.friction = friction();
  parameters.wall_friction = friction();
  parameters.rolling =
      round ? *rc::gen::element(Rolling::none, Rolling::resistance, Rolling::free) : Rolling::none;
  parameters.rolling_friction = friction();
  parameters.restitution = within(0, 91) / 100.0;
  parameters.sweeps = 2 * within(1, 5);
  parameters.resolution = within(10, 101) / 100.0;
  parameters.fall_height = *rc::gen::element(2.0, 10.0, 40.0, 200.0, 1000.0);
  return parameters;
}

/// Where hexagons and discs only, some of them of one site. Narrow periodic boxes see small ones
/// only.
inline std::vector<grains::Kind> any_kinds(bool round, bool narrow) {
  std::vector<grains::Kind> kinds;
  const int species = within(1, 4);
  for (int i = 0; i < species; ++i) {
    kinds.push_back({narrow  ? lattice::Shape::hexagon(within(0, 2))
                     : round ? *rc::gen::arbitrary<bool>()
                                   ? lattice::Shape::hexagon(within(0, 5))
                                   : lattice::Shape::disc(within(0, 11) / 2.0)
                             : any_shape(),
                     static_cast<std::uint16_t>(i)});
  }
  return kinds;
}

inline void add_source(grains::State& state) {
  grains::Source source{.weights = std::vector<std::uint32_t>(state.kinds.size(), 1)};
  for (int i = 0; i < 5; ++i) {
    source.sites.push_back({within(0, state.lattice.columns()), within(0, state.lattice.rows())});
  }
  source.rate = std::uint64_t{1} << 31U;
  source.max_emitted = 40;
  source.open = *rc::gen::arbitrary<bool>();
  state.sources = {source};
}

inline void add_outlet(grains::State& state) {
  const double left = within(0, 10);
  const double bottom = within(0, 20);
  state.outlets = {{.region = {left, bottom, left + within(8, 30), bottom + within(6, 20)}}};
}

/// Velocities up to some sites a step, now and then as fast as can be.
inline void stir(contact::State& state) {
  const std::int32_t most = *rc::gen::element(contact::kSpacing / 8, contact::kSpacing,
                                              4 * contact::kSpacing, contact::kMaxVelocity);
  for (std::size_t id = 0; id < state.velocities.size(); ++id) {
    if (state.grains.particles[id].present) {
      state.velocities[id] = {within(-most, most + 1), within(-most, most + 1),
                              within(-most, most + 1)};
    }
  }
}

/// At any angle; turning, shaken or at rest.
inline contact::Vessel any_vessel() {
  const contact::Vessel stands =
      contact::Vessel{.angle = contact::angle_from_degrees(
                          *rc::gen::element(0.0, 20.0, 59.0, 90.0, 150.0, -110.0))};
  const Eigen::Vector2d centre(within(0, 20), within(0, 40));
  switch (within(0, 4)) {
    case 0:
      return with_rotation(stands, *rc::gen::element(-1.0 / 64, -1e-3, 1e-3, 1.0 / 100), centre);
    case 1:
      return with_tilting(stands, contact::angle_from_degrees(within(-180, 180)),
                          within(1, 40) / 10.0, centre);
    case 2:
      return with_shaking(stands, within(1, 40) / 10.0, within(1, 60) / 1000.0, within(0, 2) == 0);
    default:
      return stands;
  }
}

/// `open`: grains may enter and leave, be in motion from the beginning, and the vessel may move.
inline ContactRun any_contact_run(bool open, int steps) {
  const bool periodic = *rc::gen::arbitrary<bool>();
  const bool narrow = within(0, 4) == 0;
  const bool round = narrow || within(0, 3) != 0;
  const int half_columns = narrow ? within(2, 5) : within(6, 20);
  std::vector<grains::Kind> kinds = any_kinds(round, narrow);
  const int columns =
      std::max(2 * half_columns, periodic ? contact::min_periodic_columns(kinds) : 0);
  grains::State grains{.lattice = lattice::Lattice(columns, within(12, 50), periodic),
                       .seed = *rc::gen::arbitrary<std::uint64_t>(),
                       .kinds = std::move(kinds)};
  add_static_walls(grains);
  const int moving = open ? *rc::gen::inRange(0, 3) : 0;
  for (int i = 0; i < moving; ++i) {
    add_moving_wall(grains, lattice::Direction::down, MovingWalls::rigid);
  }
  ContactRun run{.state = {.grains = std::move(grains)},
                 .parameters = any_contact_parameters(round)};
  for (std::size_t wall = 0; wall < run.state.grains.walls.size(); ++wall) {
    run.parameters.friction_by_wall.push_back(
        *rc::gen::arbitrary<bool>() ? std::optional(within(0, 20) / 10.0) : std::nullopt);
  }
  if (open && *rc::gen::arbitrary<bool>()) {
    add_source(run.state.grains);
  }
  if (open && *rc::gen::arbitrary<bool>()) {
    add_outlet(run.state.grains);
  }
  contact::ContactModel model = run.model();
  for (std::size_t wall = 0; wall < run.state.grains.walls.size(); ++wall) {
    if (run.state.grains.walls[wall].motion) {
      model.set_wall_moving(wall, within(0, 8) != 0);
    }
  }
  model.fill({0, 0, 1e3, 1e3},
             std::vector<std::size_t>(run.state.grains.kinds.size(), within<std::size_t>(1, 60)));
  run.state = model.state();
  if (open && within(0, 3) == 0) {
    stir(run.state);
  }
  run.wall_goes = within(0, 2 * steps);
  run.wall_comes = within(0, 2 * steps);
  run.source_opens = within(0, 2 * steps);
  run.vessel_moves = open ? within(0, 2 * steps) : -1;
  run.vessel = any_vessel();
  if (open && *rc::gen::arbitrary<bool>()) {
    run.state.vessel = any_vessel();
  }
  run.more_grains = open ? within(0, 2 * steps) : -1;
  return run;
}

}  // namespace clca::testing
