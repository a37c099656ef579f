#pragma once
// Displacements of particles: since a snapshot, and since the start of the stage.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::measure {

/// Displacement of a particle between two moments, in lattice spacings.
struct Displacement {
  Eigen::Vector2d from;    ///< initial centre of mass, wrapped into the box
  Eigen::Vector2d vector;  ///< not wrapped at a periodic boundary
  double sites = 0;        ///< number of sites of the particle: its mass
};

/// Displacement of each present particle in one step at its velocity (spacings per step, by id).
std::vector<Displacement> displacements_in_step(const grains::State& state,
                                                const std::vector<Eigen::Vector2d>& velocities);

/// The positions of the particles at one moment.
class Snapshot {
 public:
  /// A snapshot of an empty box.
  Snapshot() = default;
  explicit Snapshot(const grains::State& state);

  static double bytes_for(double particles) {
    return particles * sizeof(std::optional<lattice::Site>);
  }

  std::uint64_t step() const { return step_; }
  /// Displacement of a particle since the snapshot, or since it has entered (State::origins), until
  /// now or until it was removed; none if it was removed before the snapshot.
  std::optional<Displacement> displacement(const grains::State& now, std::size_t id) const;
  /// Displacements of the particles present at both moments, by id. Throws std::invalid_argument if
  /// `now` is earlier or has fewer particles.
  std::vector<Displacement> displacements(const grains::State& now) const;
  /// Mean velocities since, spacings per step, by id; none unless present at both moments.
  std::vector<std::optional<Eigen::Vector2d>> velocities(const grains::State& now) const;

  /// False if this cannot have been taken in a run that reached `now`.
  bool precedes(const grains::State& now) const;
  CLCA_FIELDS(step_, sites_);

 private:
  void require_later(const grains::State& now) const;

  std::uint64_t step_ = 0;
  std::vector<std::optional<lattice::Site>> sites_;  // by id; none of removed particles
};

// Since the start of the stage. All throw std::invalid_argument unless each particle has an origin.

/// Distance of each particle from its origin by id, in lattice spacings; 0 for removed ones.
std::vector<double> distances_from_origins(const grains::State& state);

/// Share of the present particles further than `distance` (lattice spacings) from their origin;
/// none if none is present. Throws std::invalid_argument for NaN.
std::optional<double> moved_share(const grains::State& state, double distance);

/// Diameter of the smallest kind (lattice::Shape::diameter); infinite if there are none.
double smallest_kind_diameter(const grains::State& state);

/// How far the material has spread beyond the columns of its origins, lattice spacings. The larger
/// of both sides; negative if it receded on both.
struct Runout {
  double front = 0;           ///< of the outermost site
  double percentile_99 = 0;   ///< of the 99th percentile of the sites on that side
  bool reaches_side = false;  ///< the front is at a side of the box, which ends it
};

/// None for an empty box.
std::optional<Runout> runout(const grains::State& state);

}  // namespace clca::measure
