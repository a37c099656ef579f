#pragma once
// A state and the tables that follow from it alone, shared by all models of the same grains.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "clca/grains/state.hpp"
#include "grains/internal/occupancy_table.hpp"

namespace clca::grains {

/// The sites of one kind, for reference columns of one parity.
struct Footprint {
  template <class T>
  using PerDirection = std::array<std::vector<T>, lattice::kDirectionCount>;

  std::vector<lattice::IndexOffset> covered;       ///< all sites that it covers
  PerDirection<lattice::IndexOffset> lead_sites;   ///< Shape::lead_sites
  PerDirection<lattice::IndexOffset> trail_sites;  ///< Shape::trail_sites
  std::vector<lattice::IndexOffset> neighbours;    ///< all sites beside it, each once
};

/// Index offsets of sites that are given from a reference site in a column of this parity.
std::vector<lattice::IndexOffset> index_offsets(const lattice::Lattice& lattice,
                                                const std::vector<lattice::Axial>& sites,
                                                bool odd_column);

/// The sites that each kind of particle covers, enters and leaves, as index offsets on one lattice.
class FootprintTable {
 public:
  explicit FootprintTable(const State& state);

  const Footprint& footprint(const Particle& particle) const {
    return footprint(particle.kind, particle.column);
  }
  const Footprint& footprint(std::uint16_t kind, int column) const {
    return table_[2U * kind + static_cast<unsigned>(column & 1)];
  }

 private:
  std::vector<Footprint> table_;
};

/// A step of a wall: the indices that it enters and leaves.
struct WallStep {
  std::size_t wall = 0;
  lattice::Direction direction = lattice::Direction::up;
  std::vector<std::size_t> entered;
  std::vector<std::size_t> vacated;
};

/// The boundary sites of moving walls.
class WallEdges {
 public:
  explicit WallEdges(const State& state);

  /// `desired`: +1 along the motion of the wall, -1 against it.
  WallStep wall_step(const State& state, std::size_t number, int desired) const;

 private:
  /// Foremost sites of a wall at its initial position: along the motion, and against it.
  using Edges = std::array<std::vector<lattice::Site>, 2>;

  std::vector<Edges> edges_;  // by wall; empty for those without motion
};

/// Functions that change the state of a box keep the occupancy true.
struct Box {
  /// The state must outlive the box. Throws as Occupancy.
  explicit Box(State& of) : state(of), occupancy(of), footprints(of), wall_edges(of) {}

  /// Calls `visit` with the index of each site covered, or at `offsets` from the reference site.
  template <class Visit>
  void for_each_index(const Particle& particle, Visit visit) const {
    for_each_index(particle, footprints.footprint(particle).covered, visit);
  }
  template <class Visit>
  void for_each_index(const Particle& particle, const std::vector<lattice::IndexOffset>& offsets,
                      Visit visit) const {
    const std::size_t index = state.lattice.index(particle.site());
    const int column = state.lattice.wrapped(particle.column);
    for (const lattice::IndexOffset offset : offsets) {
      visit(state.lattice.shifted_index(index, column, offset));
    }
  }

  /// Calls `visit` with the index of each site that a particle enters by a step.
  template <class Visit>
  void for_each_entered(const Particle& particle, lattice::Direction direction, Visit visit) const {
    for_each_index(particle, footprints.footprint(particle).lead_sites[index_of(direction)], visit);
  }
  /// Calls `visit` with the index of each site that a particle vacates by a step.
  template <class Visit>
  void for_each_vacated(const Particle& particle, lattice::Direction direction, Visit visit) const {
    for_each_index(particle, footprints.footprint(particle).trail_sites[index_of(direction)],
                   visit);
  }
  /// Whether all sites that a particle enters by a step are free.
  bool is_free(const Particle& particle, lattice::Direction direction) const {
    bool free = true;
    for_each_entered(particle, direction,
                     [&](std::size_t index) { free = free && !occupancy.is_taken(index); });
    return free;
  }

  /// Call for each trial of a change that may take long.
  void check_interruption() {
    constexpr unsigned kTrials = 256;
    if (interruption && ++trials % kTrials == 0) {
      interruption();
    }
  }

  State& state;
  OccupancyTable occupancy;
  FootprintTable footprints;
  WallEdges wall_edges;
  std::function<void()> interruption = {};  ///< see Model::set_interruption
  unsigned trials = 0;                      ///< so far: `interruption` is called after some
};

/// The particle one step further.
inline Particle after_step(Particle particle, lattice::Direction direction) {
  const lattice::Site target = particle.site() + unit(direction);
  particle.column = target.column;
  particle.row = target.row;
  return particle;
}

/// Removes a particle for good: its sites become free.
void remove_particle(Box& box, std::uint32_t id);

/// Index of the first outlet that the particle lies wholly inside; the number of outlets if none.
std::size_t enclosing_outlet(const State& state, const Particle& particle);

/// If the particle is present and wholly inside an outlet, counts it at the first such outlet and
/// returns true. The caller then removes it.
bool count_at_outlet(State& state, std::uint32_t id);

/// The particles that must move together with a wall, which pushes them; none if the border or
/// another wall blocks the step. Those that share sites move together.
std::optional<std::vector<std::uint32_t>> pushed_particles(const Box& box, const WallStep& step);

}  // namespace clca::grains
