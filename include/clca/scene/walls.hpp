#pragma once
// The walls of a scene as sites, whether they can move as the scene says, and what room they leave.

#include <vector>

#include "clca/lattice/lattice.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// The sites of all parts of a wall at home, sorted. Of a wall that stands still those in the box;
/// of one that moves all those that come into the box somewhere on its way.
std::vector<lattice::Site> wall_sites(const lattice::Lattice& lattice, const Wall& wall);

/// Which walls are there before the first stage: all but those that a stage inserts before any
/// stage removes them.
std::vector<bool> walls_there_first(const Scene& scene);

/// Whether a wall is there during a stage, as `[stage][wall]`.
std::vector<std::vector<bool>> walls_there(const Scene& scene);

/// Refuses moving walls that never come into the box, that stand in another wall at the start, that
/// may meet a standing wall while they move, or another moving wall; two that move alike may.
/// Visits the sites of the walls: ask for size_of first. Throws SceneError with the place of a
/// wall.
void check_walls(const Scene& scene);

/// Refuses fills that find no room whatever is drawn: counts that take more sites than the region
/// has beside the walls that are there, or a shape that fits nowhere; and outlets that no particle
/// fits into. Visits sites as check_walls does. Throws SceneError with the place.
void check_room(const Scene& scene);

}  // namespace clca::scene
