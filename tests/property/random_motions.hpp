#pragma once
// Random boxes in which walls move.

#include <rapidcheck.h>

#include <set>

#include "property/random_states.hpp"
#include "support/overlaps.hpp"

namespace clca::testing {

/// The whole range from the first case on, so that most boxes are full enough to matter.
template <class Number>
Number within(Number low, Number high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<Number>(low, high));
}

inline grains::Path any_path() {
  grains::Path path;
  grains::Path::Point last;
  const int points = *rc::gen::inRange(1, 5);
  for (int i = 0; i < points; ++i) {
    const int steps = *rc::gen::inRange(1, 15);
    last.step += static_cast<std::uint64_t>(steps);
    last.offset += *rc::gen::inRange(-steps, steps + 1);
    path.points.push_back(last);
  }
  return path;
}

inline grains::WallMotion any_motion() {
  grains::WallMotion motion;
  motion.direction = lattice::kDirections[*rc::gen::inRange<std::size_t>(0, 6)];
  const int amplitude = *rc::gen::inRange(1, 6);
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      motion.program = grains::Drive{.period = *rc::gen::inRange<std::uint64_t>(1, 4),
                                     .distance = within(0, 25)};
      break;
    case 1:
      motion.program = grains::Wave{
          .form = *rc::gen::element(grains::Waveform::sine, grains::Waveform::triangle),
          .amplitude = amplitude,
          .period = static_cast<std::uint64_t>(7 * amplitude + *rc::gen::inRange(0, 9))};
      break;
    case 2: {
      grains::Shake shake{.amplitude = amplitude, .wait = {}};
      if (*rc::gen::arbitrary<bool>()) {
        shake.wait = *rc::gen::inRange<std::uint64_t>(1, 10);
      }
      motion.program = shake;
      break;
    }
    default:
      motion.program = any_path();
  }
  return motion;
}

/// Sites along a random line, some perhaps outside the box.
inline std::vector<lattice::Site> any_line(const lattice::Lattice& lattice) {
  const auto along = [&](double extent) { return extent * within(0, 100) / 100; };
  const double width = lattice.columns() * lattice::kColumnPitch;
  const double height = lattice.rows();
  // Half of them through the whole box: pistons.
  const bool whole = *rc::gen::arbitrary<bool>();
  const lattice::Segment segment{{whole ? 0 : along(width), along(height)},
                                 {whole ? width : along(width), along(height)},
                                 1.5};
  std::vector<lattice::Site> sites = sites_along(lattice, segment);
  if (*rc::gen::inRange(0, 3) == 0) {
    const lattice::Axial by{*rc::gen::inRange(-8, 9), *rc::gen::inRange(-8, 9)};
    std::transform(sites.begin(), sites.end(), sites.begin(),
                   [by](lattice::Site site) { return site + by; });
  }
  return sites;
}

enum class MovingWalls : std::uint8_t { rigid, overlapping, any };

/// A wall that moves, all of whose sites in the box are free.
inline void add_moving_wall(grains::State& state, lattice::Direction gravity, MovingWalls which) {
  grains::Wall wall{.sites = any_line(state.lattice), .motion = any_motion()};
  const auto others = occupants(state);
  std::erase_if(wall.sites, [&](lattice::Site site) {
    return others.contains({state.lattice.wrapped(site.column), site.row});
  });
  if (*rc::gen::arbitrary<bool>()) {
    wall.motion = grains::WallMotion{gravity, grains::Drive{within<std::uint64_t>(1, 4), 30}};
  }
  const bool overlaps = which == MovingWalls::overlapping ||
                        (which == MovingWalls::any && *rc::gen::arbitrary<bool>());
  wall.passive_rule = overlaps ? grains::PassiveRule::overlap : grains::PassiveRule::rigid;
  state.walls.push_back(std::move(wall));
}

inline void add_static_walls(grains::State& state) {
  const int walls = *rc::gen::inRange(0, 3);
  for (int i = 0; i < walls; ++i) {
    std::vector<lattice::Site> sites = any_line(state.lattice);
    std::erase_if(sites, [&](lattice::Site site) { return !state.lattice.contains(site); });
    state.walls.push_back({.sites = std::move(sites)});
  }
}

/// A box with walls at rest, one to three that move, and particles that have fallen for a while.
inline RuledState any_moving_state(MovingWalls which) {
  const bool periodic = *rc::gen::arbitrary<bool>();
  const int columns = 2 * within(5, 14);
  const int rows = within(10, 40);
  const automaton::Rules rules = any_rules(false);
  grains::State state{.lattice = lattice::Lattice(columns, rows, periodic),
                      .seed = *rc::gen::arbitrary<std::uint64_t>()};
  add_static_walls(state);
  const int moving = *rc::gen::inRange(1, 4);
  for (int i = 0; i < moving; ++i) {
    add_moving_wall(state, rules.gravity, which);
  }
  const int species = *rc::gen::inRange(1, 4);
  for (int i = 0; i < species; ++i) {
    state.kinds.push_back({any_shape(), static_cast<std::uint16_t>(i)});
  }
  const std::vector<std::size_t> counts(state.kinds.size(), within<std::size_t>(5, 80));
  automaton::Automaton automaton(state, rules);
  automaton.fill({0, 0, 1e3, 1e3}, counts);
  const int fall = within(0, 60);
  for (int step = 0; step < fall; ++step) {
    automaton.step();
  }
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    if (state.walls[wall].motion) {
      automaton.set_wall_moving(wall, *rc::gen::inRange(0, 8) != 0);
    }
  }
  return {automaton.state(), rules};
}

}  // namespace clca::testing
