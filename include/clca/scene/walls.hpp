#pragma once
// The sites of walls and sources, and checks of motion and of the space left for particles.

#include <functional>
#include <vector>

#include "clca/lattice/lattice.hpp"
#include "clca/lattice/region.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// The lattice that covers the box.
lattice::Lattice lattice_of(const Box& box);

/// The sites of the region inside the shape or at most 10^-6 spacings outside it, column by column
/// from the left, upwards.
/// A ring at least one spacing thick is closed: no chain of neighbouring sites crosses it.
std::vector<lattice::Site> sites_in(const lattice::SweptRegion& swept_region,
                                    const CircularPart& circle);

/// Whether sites_in() of the box is empty. Does not build the list.
bool holds_no_site(const lattice::Lattice& lattice, const CircularPart& circle);
/// Whether no site of the lattice lies in the rectangle, or on the straight wall.
bool holds_no_site(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle);
bool holds_no_site(const lattice::Lattice& lattice, const lattice::Segment& segment);

/// A rectangle that contains all sites of the circle.
lattice::Rectangle bounding_rectangle(const CircularPart& circle);

/// The region that enters the box as the wall moves; for a standing wall, the box.
lattice::SweptRegion swept_region_of(const lattice::Lattice& lattice, const Wall& wall);

/// The sites of all parts of a wall at its initial position, sorted: those in the box or, for a
/// moving wall, those that enter the box during its motion.
std::vector<lattice::Site> wall_sites(const lattice::Lattice& lattice, const Wall& wall);

/// The sites of the box at which a source places particles.
std::vector<lattice::Site> source_sites(const lattice::Lattice& lattice, const Source& source);

/// Visits the sites of the box that the wall ever covers, each once except in a periodic box, until
/// `test` returns true. Returns whether it did. Memory: the sites at the initial position. Time:
/// these and, of each that no other one of them is ahead of, the steps of the motion until it
/// leaves the box.
bool any_swept_site(const lattice::Lattice& lattice, const Wall& wall,
                    const std::function<bool(lattice::Site)>& test);

/// Walls present before the first stage: all but those first inserted by a stage.
std::vector<bool> walls_present_at_start(const Scene& scene);

/// Whether a wall is present in a stage, as `[stage][wall]`.
std::vector<std::vector<bool>> walls_present_by_stage(const Scene& scene);

/// Rejects moving walls that never enter the box, overlap another wall at the start, or may meet a
/// standing or another moving wall (unless both move alike).
/// Visits all sites of the walls: check model_size first. Throws SceneError with a location.
void check_walls(const Scene& scene);

/// Rejects fills that cannot fit: counts that need more sites than the region has, or a shape that
/// fits nowhere; outlets that no particle fits into; and sources of particles that never fit.
/// Visits sites as check_walls. Throws SceneError with the location.
void check_room(const Scene& scene);

}  // namespace clca::scene
