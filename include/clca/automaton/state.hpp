#pragma once
// The state of a run: a value that can be copied, compared and hashed.

#include <cstdint>
#include <vector>

#include "clca/automaton/rules.hpp"
#include "clca/lattice/lattice.hpp"
#include "clca/lattice/region.hpp"
#include "clca/lattice/shape.hpp"

namespace clca::automaton {

/// A species in one of its orientations.
struct Kind {
  lattice::Shape shape;
  std::uint16_t species = 0;

  bool operator==(const Kind&) const = default;
};

/// What a particle did in its last step: 0 to 5 a lattice::Direction, kRest none.
using Move = std::uint8_t;
inline constexpr Move kRest = 6;

/// Its id is its place in State::particles, for life.
struct Particle {
  std::int32_t column = 0;  ///< of the reference site; runs on across a periodic seam
  std::int32_t row = 0;
  std::uint16_t kind = 0;  ///< index into State::kinds
  Move previous = kRest;
  bool present = true;  ///< false once an outlet has removed it

  lattice::Site site() const { return {column, row}; }
  bool operator==(const Particle&) const = default;
};

/// A fixed obstacle; its sites lie inside the box.
struct Wall {
  std::vector<lattice::Site> sites = {};
  bool present = true;

  bool operator==(const Wall&) const = default;
};

/// Emits particles while it is open.
struct Source {
  std::vector<lattice::Site> sites = {};  ///< where the reference site of a new particle may lie
  std::vector<std::uint32_t> weights;     ///< per kind; a kind is drawn in proportion
  std::uint64_t rate = 0;                 ///< particles per step, times 2^32
  std::uint64_t count = 0;                ///< closes for good after so many particles
  std::uint64_t credit = 0;               ///< particles due, times 2^32
  std::uint64_t emitted = 0;
  bool open = false;

  bool exhausted() const { return emitted >= count; }
  bool operator==(const Source&) const = default;
};

/// Removes and counts every particle that lies wholly inside.
struct Outlet {
  lattice::Rectangle region = {};
  std::uint64_t particles = 0;
  std::uint64_t sites = 0;

  bool operator==(const Outlet&) const = default;
};

struct State {
  lattice::Lattice lattice;
  Rules rules = {};
  std::uint64_t seed = 0;
  std::uint64_t step = 0;
  std::vector<Kind> kinds = {};
  std::vector<Particle> particles = {};
  /// Where each particle was when the stage began or when it entered, by id.
  std::vector<lattice::Site> origins = {};
  std::vector<Wall> walls = {};
  std::vector<Source> sources = {};
  std::vector<Outlet> outlets = {};

  const lattice::Shape& shape(const Particle& particle) const { return kinds[particle.kind].shape; }
  bool operator==(const State&) const = default;
};

/// Centre of mass in lattice spacings.
Eigen::Vector2d centre(const State& state, const Particle& particle);

/// Number of particles that are still in the box.
std::size_t present_count(const State& state);

/// 64 bits over everything that a run changes; the same on every machine.
std::uint64_t hash(const State& state);

}  // namespace clca::automaton
