#pragma once
// The sites of walls, and checks of their motion and of the space left for particles.

#include <vector>

#include "clca/lattice/lattice.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// The sites of all parts of a wall at its initial position, sorted: those in the box or, for a
/// moving wall, those that enter the box during its motion.
std::vector<lattice::Site> wall_sites(const lattice::Lattice& lattice, const Wall& wall);

/// Walls present before the first stage: all except those that a stage inserts before any stage
/// removes them.
std::vector<bool> walls_present_at_start(const Scene& scene);

/// Whether a wall is present in a stage, as `[stage][wall]`.
std::vector<std::vector<bool>> walls_present_by_stage(const Scene& scene);

/// Rejects moving walls that never enter the box, overlap another wall at the start, or may meet a
/// standing or another moving wall (unless both move alike).
/// Visits all sites of the walls: check size_of first. Throws SceneError with the location of a
/// wall.
void check_walls(const Scene& scene);

/// Rejects fills that cannot fit: counts that need more sites than the region has, or a shape that
/// fits nowhere; and outlets that no particle fits into.
/// Visits sites as check_walls. Throws SceneError with the location.
void check_room(const Scene& scene);

}  // namespace clca::scene
