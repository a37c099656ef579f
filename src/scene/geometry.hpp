#pragma once
// Points and rectangles in the box, and the sites that a moving wall sweeps over.

#include <functional>
#include <string>

#include "clca/lattice/lattice.hpp"
#include "clca/lattice/region.hpp"
#include "clca/scene/scene.hpp"
#include "scene/place.hpp"

namespace clca::scene {

inline constexpr int kDegreesPerSixth = 360 / lattice::kDirectionCount;

lattice::Lattice lattice_of(const Box& box);

/// `[left, bottom, right, top]`
std::string shown(const lattice::Rectangle& edges);
/// True when no site of the lattice lies in the rectangle, or on the straight wall.
bool holds_no_site(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle);
bool holds_no_site(const lattice::Lattice& lattice, const lattice::Segment& segment);
/// Refuses a rectangle that holds no site of the box. Throws SceneError.
void require_site(const lattice::Rectangle& region, const PlacedValue& place);

/// The region that enters the box as the wall moves; for a standing wall, the box.
lattice::SweptRegion swept_region_of(const lattice::Lattice& lattice, const Wall& wall);

/// Visits the sites of the box that the wall ever covers, each once except in a periodic box, until
/// `test` returns true. Returns whether it did. Memory: the sites at the initial position. Time:
/// these and, of each that no other one of them is ahead of, the steps of the motion until it
/// leaves the box.
bool any_swept_site(const lattice::Lattice& lattice, const Wall& wall,
                    const std::function<bool(lattice::Site)>& test);

}  // namespace clca::scene
