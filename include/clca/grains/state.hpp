#pragma once
// The state of a run: a value that can be copied, compared, hashed, saved and loaded. The lists of
// fields name what a run changes; all else follows from the scene.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "clca/fields/fields.hpp"
#include "clca/grains/motion.hpp"
#include "clca/lattice/lattice.hpp"
#include "clca/lattice/region.hpp"
#include "clca/lattice/shape.hpp"

namespace clca::grains {

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
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("column", &Particle::column), field("row", &Particle::row),
                           field("kind", &Particle::kind), field("previous", &Particle::previous),
                           field("present", &Particle::present));
  }
};

/// Takes part where sites have two occupants: a particle id, or the code of a wall.
using Owner = std::int32_t;
inline constexpr Owner kFirstWall = -2;  ///< further walls are numbered down

constexpr bool is_particle(Owner owner) {
  return owner >= 0;
}
constexpr bool is_wall(Owner owner) {
  return owner <= kFirstWall;
}
constexpr Owner wall_code(std::size_t wall) {
  return kFirstWall - static_cast<Owner>(wall);
}
constexpr std::size_t wall_number(Owner owner) {
  return static_cast<std::size_t>(kFirstWall - owner);
}

/// An obstacle. The sites of one that does not move lie inside the box; one that moves may begin
/// or end outside, where it is not there.
struct Wall {
  std::vector<lattice::Site> sites = {};  ///< at home
  bool present = true;
  std::optional<Motion> motion = {};
  Passive passive = Passive::rigid;  ///< of one that moves
  Travel travel = {};

  /// Where the wall is now, as a vector from home.
  lattice::Axial shift() const;
  bool lets_overlap() const { return motion && passive == Passive::overlap; }
  bool operator==(const Wall&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("present", &Wall::present), field("travel", &Wall::travel));
  }
};

/// An overlap that a push has left: `pusher`, a particle or a wall, came onto `pushed`. The push
/// began at the wall `source`, in `direction`.
struct Push {
  std::uint32_t pushed = 0;
  Owner pusher = 0;
  std::uint32_t source = 0;
  lattice::Direction direction = lattice::Direction::down;

  /// By which State::pushes are in order.
  std::pair<std::uint32_t, Owner> key() const { return {pushed, pusher}; }
  bool operator==(const Push&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("pushed", &Push::pushed), field("pusher", &Push::pusher),
                           field("source", &Push::source), field("direction", &Push::direction));
  }
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
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("credit", &Source::credit), field("emitted", &Source::emitted),
                           field("open", &Source::open));
  }
};

/// Removes and counts every particle that lies wholly inside.
struct Outlet {
  lattice::Rectangle region = {};
  std::uint64_t particles = 0;
  std::uint64_t sites = 0;

  bool operator==(const Outlet&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("particles", &Outlet::particles), field("sites", &Outlet::sites));
  }
};

struct State {
  lattice::Lattice lattice;
  std::uint64_t seed = 0;
  std::uint64_t step = 0;
  std::vector<Kind> kinds = {};
  std::vector<Particle> particles = {};
  /// Where each particle was when the stage began or when it entered, by id.
  std::vector<lattice::Site> origins = {};
  std::vector<Wall> walls = {};
  std::vector<Source> sources = {};
  std::vector<Outlet> outlets = {};
  /// By Push::key; one for each pair.
  std::vector<Push> pushes = {};

  const lattice::Shape& shape(const Particle& particle) const { return kinds[particle.kind].shape; }
  bool operator==(const State&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("seed", &State::seed), field("step", &State::step),
                           field("particles", &State::particles), field("origins", &State::origins),
                           field("walls", &State::walls), field("sources", &State::sources),
                           field("outlets", &State::outlets), field("pushes", &State::pushes));
  }
};

/// Centre of mass in lattice spacings.
Eigen::Vector2d centre(const State& state, const Particle& particle);

/// Number of particles that are still in the box.
std::size_t present_count(const State& state);

/// The sites inside the box that a wall covers now, whether it is present or not.
std::vector<lattice::Site> sites_now(const lattice::Lattice& lattice, const Wall& wall);

/// True when some wall may come to overlap with particles.
bool may_overlap(const State& state);

/// The push by which `pusher` came onto particle `pushed`; null where there is none.
const Push* find_push(const State& state, std::uint32_t pushed, Owner pusher);

/// 64 bits over everything that a run changes; the same on every machine.
std::uint64_t hash(const State& state);

/// Throws std::invalid_argument, with the reason, unless a model can work with the state: the
/// shape of a kind has a site at its reference, what refers to others refers to some that are
/// there, motions have positive periods and rise, a source has sites and one weight for each kind,
/// not all 0. Whether particles have room is for Occupancy to say.
void check_valid(const State& state);

/// Throws likewise unless the state is one that a run which began as `beginning` may come to.
void check_reachable(const State& state, const State& beginning);

}  // namespace clca::grains
