#pragma once
// The state of a run: a value that can be copied, compared, hashed, saved and loaded.
// CLCA_FIELDS lists the members that a run changes; all others follow from the scene.

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "clca/grains/motion.hpp"
#include "clca/lattice/lattice.hpp"
#include "clca/lattice/region.hpp"
#include "clca/lattice/shape.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::grains {

/// A species in one of its orientations.
struct Kind {
  lattice::Shape shape;
  std::uint16_t species = 0;

  bool operator==(const Kind&) const = default;
};

/// Last move of a particle: 0 to 5 is a lattice::Direction, kRest is none.
using Move = std::uint8_t;
inline constexpr Move kRest = 6;

/// Its id is its index in State::particles and never changes.
struct Particle {
  std::int32_t column = 0;  ///< of the reference site; not wrapped at a periodic boundary
  std::int32_t row = 0;
  std::uint16_t kind = 0;  ///< index into State::kinds
  Move previous = kRest;
  bool present = true;  ///< false once removed by an outlet

  lattice::Site site() const { return {column, row}; }
  bool operator==(const Particle&) const = default;
  CLCA_FIELDS(column, row, kind, previous, present);
};

/// Owner of a site: a particle id, the code of a wall, or one of these.
using Owner = std::int32_t;
inline constexpr Owner kFree = -1;       ///< nobody
inline constexpr Owner kFirstWall = -2;  ///< further walls are numbered down
inline constexpr Owner kBorder = std::numeric_limits<Owner>::min();  ///< the border of the box

constexpr bool is_particle(Owner owner) {
  return owner >= 0;
}
/// The id of a particle that owns a site.
constexpr std::uint32_t particle_id(Owner owner) {
  return static_cast<std::uint32_t>(owner);
}
constexpr Owner as_owner(std::size_t id) {
  return static_cast<Owner>(id);
}
/// True of walls, the border and the sides of the box; only walls have a wall_number().
constexpr bool is_obstacle(Owner owner) {
  return owner <= kFirstWall;
}
constexpr Owner wall_code(std::size_t wall) {
  return kFirstWall - static_cast<Owner>(wall);
}
constexpr std::size_t wall_number(Owner owner) {
  return static_cast<std::size_t>(kFirstWall - owner);
}

/// An obstacle. The sites of a wall without motion lie in the box. Those of a moving wall may start
/// or end outside, where they have no effect.
struct Wall {
  std::vector<lattice::Site> sites = {};  ///< at the initial position
  bool present = true;
  std::optional<WallMotion> motion = {};
  PassiveRule passive_rule = PassiveRule::rigid;  ///< of a moving wall
  Travel travel = {};

  /// Displacement of the wall from its initial position.
  lattice::Axial shift() const;
  bool lets_overlap() const { return motion && passive_rule == PassiveRule::overlap; }
  bool in_motion() const { return motion && present && travel.active; }
  bool operator==(const Wall&) const = default;
  CLCA_FIELDS(present, travel);
};

/// An overlap left by a push: `pusher`, a particle or a wall, moved onto `pushed`.
/// The push began at the wall `source`, in `direction`.
struct Push {
  std::uint32_t pushed = 0;
  Owner pusher = 0;
  std::uint32_t source = 0;
  lattice::Direction direction = lattice::Direction::down;

  /// State::pushes is sorted by this.
  std::pair<std::uint32_t, Owner> key() const { return {pushed, pusher}; }
  bool operator==(const Push&) const = default;
  CLCA_FIELDS(pushed, pusher, source, direction);
};

/// Emits particles while it is open.
struct Source {
  std::vector<lattice::Site> sites = {};  ///< allowed reference sites of a new particle
  std::vector<std::uint32_t> weights;     ///< per kind; a kind is drawn in proportion
  std::uint64_t units_per_particle = std::uint64_t{1} << 32U;  ///< in `rate` and `credit`
  std::uint64_t rate = 0;         ///< particles per step, times units_per_particle
  std::uint64_t max_emitted = 0;  ///< particles after which it closes for good
  std::uint64_t credit = 0;       ///< particles due, times units_per_particle
  std::uint64_t emitted = 0;
  bool open = false;

  bool is_exhausted() const { return emitted >= max_emitted; }
  bool operator==(const Source&) const = default;
  CLCA_FIELDS(credit, emitted, open);
};

/// Removes and counts every particle that is wholly inside.
struct Outlet {
  lattice::Rectangle region = {};
  std::uint64_t particles = 0;  ///< removed so far
  std::uint64_t sites = 0;      ///< of these particles

  bool operator==(const Outlet&) const = default;
  CLCA_FIELDS(particles, sites);
};

struct State {
  lattice::Lattice lattice;
  std::uint64_t seed = 0;
  std::uint64_t step = 0;
  std::vector<Kind> kinds = {};
  std::vector<Particle> particles = {};
  /// Position of each particle at the start of the stage or when it entered, by id.
  std::vector<lattice::Site> origins = {};
  std::vector<Wall> walls = {};
  std::vector<Source> sources = {};
  std::vector<Outlet> outlets = {};
  /// Sorted by Push::key; one per pair.
  std::vector<Push> pushes = {};

  const lattice::Shape& shape(const Particle& particle) const { return kinds[particle.kind].shape; }
  bool operator==(const State&) const = default;
  CLCA_FIELDS(seed, step, particles, origins, walls, sources, outlets, pushes);
};

// Constants of estimates of memory.
inline constexpr double kListCapacityRatio = 2;  ///< most room of a list, over its size
inline constexpr double kParticleBytes =
    kListCapacityRatio * (sizeof(Particle) + sizeof(lattice::Site));

/// Centre of mass in lattice spacings; counted on across a periodic boundary, as the column is.
Eigen::Vector2d centre(const State& state, const Particle& particle);
/// Centre of mass, within the box if periodic: the same bits for every image of a particle.
Eigen::Vector2d centre_in_box(const State& state, const Particle& particle);

/// Number of particles in the box.
std::size_t present_count(const State& state);

/// The sites of the box that a wall covers now, whether it is present or not.
std::vector<lattice::Site> current_sites(const lattice::Lattice& lattice, const Wall& wall);

/// True if some wall may overlap particles.
bool walls_may_overlap(const State& state);

/// The push of `pusher` onto the particle `pushed`; null if there is none.
const Push* find_push(const State& state, std::uint32_t pushed, Owner pusher);

/// 64-bit hash of everything that a run changes; the same on every machine.
std::uint64_t hash(const State& state);

/// Throws std::invalid_argument, with the reason, unless a model can run the state:
/// every shape contains its reference site, all indices are valid, motions have positive periods
/// and increasing steps, a source has sites and one weight per kind, not all 0. Occupancy checks
/// that particles do not overlap.
void check_valid(const State& state);

/// Throws std::invalid_argument unless every kind has one site and no wall has a motion.
void check_one_site(const State& state);

/// Throws std::invalid_argument unless a run that started from `beginning` can reach the state.
void check_reachable(const State& state, const State& beginning);

}  // namespace clca::grains
