#pragma once
// Random boxes, shapes, walls and rules for property tests.

#include <rapidcheck.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "clca/automaton/automaton.hpp"

namespace clca::testing {

/// A connected set of sites without holes, grown at random.
inline lattice::Shape grown_shape() {
  const int size = *rc::gen::inRange(1, 9);
  std::vector<lattice::Axial> sites = {{0, 0}};
  while (static_cast<int>(sites.size()) < size) {
    const auto from = sites[*rc::gen::inRange<std::size_t>(0, sites.size())];
    const auto site = from + unit(lattice::kDirections[*rc::gen::inRange<std::size_t>(0, 6)]);
    if (std::find(sites.begin(), sites.end(), site) == sites.end()) {
      sites.push_back(site);
    }
  }
  try {
    return lattice::Shape(sites);
  } catch (const std::invalid_argument&) {
    return lattice::Shape::hexagon(1);  // it had grown around a hole
  }
}

inline lattice::Shape any_shape() {
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return lattice::Shape::hexagon(*rc::gen::inRange(0, 4));
    case 1:
      return lattice::Shape::rod(*rc::gen::inRange(0, 2), *rc::gen::inRange(1, 5))
          .rotated(*rc::gen::inRange(0, 6));
    case 2:
      return lattice::Shape::polygon(std::vector<lattice::Axial>{{0, 0}, {3, 0}, {0, 3}})
          .rotated(*rc::gen::inRange(0, 6));
    default:
      return grown_shape();
  }
}

/// A state and the rules by which it goes on.
struct RuledState {
  grains::State state;
  automaton::Rules rules;

  automaton::Automaton automaton(automaton::Options options = {}) const {
    return automaton::Automaton(state, rules, options);
  }
};

inline automaton::Rules any_rules(bool downward_only) {
  automaton::Rules rules;
  rules.inertia = *rc::gen::element(0.0, 0.5, 0.9, 1.0);
  rules.scatter = *rc::gen::element(0.0, 0.0, 0.3, 1.0);
  rules.gravity = lattice::kDirections[*rc::gen::inRange<std::size_t>(0, 6)];
  rules.ties =
      *rc::gen::element(automaton::TieBreaking::particle, automaton::TieBreaking::direction);
  std::sort(rules.update_priority.begin(), rules.update_priority.end());
  const int permutations = *rc::gen::inRange(0, 6);
  for (int i = 0; i < permutations; ++i) {
    std::next_permutation(rules.update_priority.begin(), rules.update_priority.end());
  }
  if (!downward_only && *rc::gen::inRange(0, 3) == 0) {
    rules.candidates = automaton::CandidateDirections::all;
  }
  return rules;
}

/// An empty box with `min_walls` to two walls.
inline grains::State any_box(bool periodic, int min_walls, int max_columns) {
  const int columns = 2 * *rc::gen::inRange(8, max_columns / 2);
  const int rows = *rc::gen::inRange(10, 70);
  grains::State state{.lattice = lattice::Lattice(columns, rows, periodic),
                      .seed = *rc::gen::arbitrary<std::uint64_t>()};
  const double width = columns * lattice::kColumnPitch;
  const int walls = *rc::gen::inRange(min_walls, 3);
  for (int i = 0; i < walls; ++i) {
    const auto along = [&](double extent) { return extent * *rc::gen::inRange(0, 100) / 100; };
    const lattice::Segment segment{{along(width), along(rows)}, {along(width), along(rows)}, 1.5};
    state.walls.push_back({.sites = sites_along(state.lattice, segment), .present = true});
  }
  return state;
}

/// All of a box.
inline lattice::Rectangle whole(const lattice::Lattice& lattice) {
  return {0, 0, lattice.columns() * lattice::kColumnPitch, static_cast<double>(lattice.rows())};
}

/// A box with `min_walls` to two walls and some particles placed by the fill.
inline RuledState any_state(bool downward_only, int min_walls = 0, int max_columns = 50) {
  const automaton::Rules rules = any_rules(downward_only);
  // Where gravity has a sideways part, a periodic box has no floor to come to rest on.
  const bool upright =
      rules.gravity == lattice::Direction::down || rules.gravity == lattice::Direction::up;
  const bool periodic = *rc::gen::arbitrary<bool>() && (upright || !downward_only);
  grains::State state = any_box(periodic, min_walls, max_columns);
  const int species = *rc::gen::inRange(1, 4);
  for (int i = 0; i < species; ++i) {
    state.kinds.push_back({any_shape(), static_cast<std::uint16_t>(i)});
  }
  const std::vector<std::size_t> counts(state.kinds.size(), *rc::gen::inRange<std::size_t>(1, 40));
  automaton::Automaton automaton(state, rules);
  automaton.fill(whole(automaton.state().lattice), counts);
  return {automaton.state(), rules};
}

}  // namespace clca::testing
