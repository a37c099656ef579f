#pragma once
// Where particles and walls are: their sites, and in which of equal parts a position is. Edges of
// cells, columns and lines may lie on a site, where rounding must not decide.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/measure/grid.hpp"
#include "lattice/internal/require.hpp"

namespace clca::measure {

/// Calls visit(id, particle) for every present particle.
template <typename Visit>
void for_each_present(const grains::State& state, const Visit& visit) {
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    if (state.particles[id].present) {
      visit(id, state.particles[id]);
    }
  }
}

/// Calls visit(site) for every site of every present particle, wrapped; twice for a shared site.
template <typename Visit>
void for_each_site(const grains::State& state, const Visit& visit) {
  for_each_present(state, [&](std::uint32_t /*id*/, const grains::Particle& particle) {
    for (const lattice::Axial part : state.shape(particle).sites()) {
      lattice::Site site = particle.site() + part;
      site.column = state.lattice.wrapped(site.column);
      visit(site);
    }
  });
}

/// Largest distance of a site of the shape from its centre of mass, lattice spacings.
inline double max_site_distance(const lattice::Shape& shape) {
  double result = 0;
  for (const lattice::Axial site : shape.sites()) {
    result = std::max(result, (lattice::position(site) - shape.centroid()).norm());
  }
  return result;
}

/// Throws std::invalid_argument if the occupancy is that of another box.
inline void check_occupancy(const grains::State& state, const grains::Occupancy& occupancy) {
  require(occupancy.index_count() == state.lattice.index_count(),
          "the occupancy is that of another box");
}

/// Whether a present wall covers a site, by its index in the lattice.
inline std::vector<bool> wall_mask(const grains::State& state) {
  std::vector<bool> walled(state.lattice.index_count(), false);
  for (const grains::Wall& wall : state.walls) {
    if (wall.present) {
      for (const lattice::Site site : grains::current_sites(state.lattice, wall)) {
        walled[state.lattice.index(site)] = true;
      }
    }
  }
  return walled;
}

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// More than the rounding of any position, far less than the distance of a centre of mass from an
/// edge on which it does not lie: both are whole multiples of small fractions of a spacing.
inline constexpr double kRoundingTolerance = 1e-9;  // lattice spacings, or shares of a part

/// Number of the equal part, counted from 0, that contains a position given in lengths of a part.
/// An edge belongs to the part after it.
inline double part_at(double position) {
  return std::floor(position + kRoundingTolerance);
}

/// Number of the part that ends at an edge; else as part_at().
inline double part_before(double position) {
  return std::ceil(position - kRoundingTolerance) - 1;
}

/// The nearest of `count` parts.
inline std::size_t nearest_part(double part, std::size_t count) {
  return static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(count) - 1));
}

/// Calls visit(part, share) for the parts that a position is in, of `count` equal ones: an edge
/// between two belongs half to each, so that the mirror image of a bed has the mirror image of its
/// table. A position beyond an end is in the last part there.
template <class Visit>
void share_out(double position, std::size_t count, const Visit& visit) {
  share_out(nearest_part(part_before(position), count), nearest_part(part_at(position), count),
            visit);
}

/// The component of the vector product at right angles to the plane.
inline double cross_product(const Eigen::Vector2d& one, const Eigen::Vector2d& other) {
  return one.x() * other.y() - one.y() * other.x();
}

}  // namespace clca::measure
