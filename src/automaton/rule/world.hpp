#pragma once
// A box, and who overlaps in it.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/automaton/automaton.hpp"
#include "clca/grains/state.hpp"
#include "grains/internal/box.hpp"

namespace clca::automaton {

/// The pushes of a state in order, and who takes part in one.
/// Every pair that overlaps has one push in State::pushes, and there are no others.
class PushList {
 public:
  explicit PushList(const grains::State& state);

  /// True when the particle overlaps with something.
  bool overlapping(std::uint32_t id) const { return parts_[id] > 0; }
  /// All overlapping particles, ascending.
  static std::vector<std::uint32_t> overlapping_particles(const grains::State& state);
  /// The pushes onto `id`.
  static std::span<const grains::Push> onto(const grains::State& state, std::uint32_t id);

  void resize(std::size_t particles) { parts_.resize(particles, 0); }
  /// Enters a push, or renews the one of the same pair.
  void record(grains::State& state, const grains::Push& push);
  /// Forgets the push between the particle and `other`, whoever pushed.
  void forget(grains::State& state, std::uint32_t id, grains::Owner other);

 private:
  void count(const grains::Push& push, int change);
  bool erase(grains::State& state, std::uint32_t pushed, grains::Owner pusher);

  std::vector<std::uint32_t> parts_;  // pushes in which a particle takes part, by id
};

/// A wall or particle that shares sites with a particle.
struct Overlap {
  grains::Owner owner = 0;
  int sites = 0;

  bool operator==(const Overlap&) const = default;
};

/// Whether one of these is with `owner`.
bool shares(const std::vector<Overlap>& overlaps, grains::Owner owner);

/// What has changed since these lists were cleared. The rule only writes them; the engine finds in
/// them which particles to examine again.
struct Changes {
  std::vector<std::size_t> vacated;  ///< sites that became free, if nothing has taken them since
  std::vector<std::uint32_t> particles;  ///< new ones, moved ones, those that lost an overlap
  bool by_others = true;  ///< by something else than the particles' own moves, also before

  void clear() {
    vacated.clear();
    particles.clear();
    by_others = false;
  }
};

class World {
 public:
  /// The box must outlive the world.
  World(grains::Box& around, const Rules& given_rules);

  /// Takes in particles that were added to the state from id `first` on.
  void include_new(std::size_t first);

  /// Who would share sites with particle `id` if it were where `at` is; in order of the sites.
  std::vector<Overlap> overlaps(std::uint32_t id, const grains::Particle& at) const;

  /// Moves a particle, whatever shares its sites, and forgets the pushes that have ended. Its
  /// `previous` becomes the direction.
  void move(std::uint32_t id, lattice::Direction direction);
  /// Moves many by one site at once; they may be in each other's way. Adds them to `carried`.
  void move_together(std::span<const std::uint32_t> ids, lattice::Direction direction);
  /// Forgets the push between a particle and `other`, whoever pushed.
  void forget_push(std::uint32_t id, grains::Owner other);
  /// Forgets what a particle shares with others, as it will be taken out.
  void let_go(std::uint32_t id);
  /// Particles or walls were changed by something else than steps: forgets the pushes of walls that
  /// are gone.
  void reload();

  grains::Box& box;
  grains::State& state;               // of the box
  grains::OccupancyTable& occupancy;  // of the box
  Rules rules;
  PushList pushes;
  std::vector<std::uint32_t> carried;  ///< particles that walls have moved in this step
  Changes changes;

 private:
  void leave(std::uint32_t id, lattice::Direction direction);
  void enter(std::uint32_t id, lattice::Direction direction);
};

}  // namespace clca::automaton
