#pragma once
// Points and rectangles in the box, and the sites that a moving wall sweeps over.

#include <functional>
#include <string>

#include "clca/lattice/lattice.hpp"
#include "clca/lattice/region.hpp"
#include "clca/scene/scene.hpp"
#include "scene/value.hpp"

namespace clca::scene {

inline constexpr int kDegreesPerSixth = 360 / lattice::kDirectionCount;

lattice::Lattice lattice_of(const Box& box);

/// [x, y]. Throws SceneError, as all here.
Eigen::Vector2d read_point(const Value& value, const std::string& path);
/// [left, bottom, right, top], not empty.
lattice::Rectangle read_rectangle(const Value& value, const std::string& path);
/// `[left, bottom, right, top]`
std::string shown(const lattice::Rectangle& edges);
/// True when no site of the lattice lies in the rectangle; costs nothing.
bool holds_no_site(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle);
/// Refuses a rectangle, read from `value`, that holds no site of the box.
void require_site(const lattice::Rectangle& region, const Value& value, const std::string& path,
                  const Box& box);

/// The region that enters the box as the wall moves; for a standing wall, the box.
lattice::SweptRegion swept_region_of(const lattice::Lattice& lattice, const Wall& wall);

/// Visits the sites of the box that the wall ever covers, each once except in a periodic box, until
/// `test` returns true. Returns whether it did.
/// Memory: the sites at the initial position. Time: these and the sites of the box.
bool any_swept_site(const lattice::Lattice& lattice, const Wall& wall,
                    const std::function<bool(lattice::Site)>& test);

}  // namespace clca::scene
