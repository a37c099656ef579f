#include "clca/measure/convection.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "measure/places.hpp"

namespace clca::measure {

namespace {

constexpr double kInside = 1.0 / 6;  // of the bed's width, to either side of its middle
constexpr double kAtWalls = 1.0 / 3;

}  // namespace

Convection::Convection(const lattice::Lattice& lattice, double cell)
    : grid_(lattice, cell), cells_(grid_.size()) {}

bool Convection::precedes(const grains::State& now) const {
  return cells_.size() == grid_.size() && (!begin_ || begin_->snapshot.precedes(now));
}

void Convection::begin_cycle(const grains::State& state) {
  begin_.emplace(CycleStart{Snapshot(state), kInfinity, -kInfinity});
  for_each_site(state, [&](lattice::Site site) {
    begin_->left = std::min(begin_->left, lattice::kColumnPitch * (site.column - 0.5));
    begin_->right = std::max(begin_->right, lattice::kColumnPitch * (site.column + 0.5));
  });
}

void Convection::end_cycle(const grains::State& state) {
  if (!begin_) {
    throw std::logic_error("a cycle ends that has not begun");
  }
  for (const Displacement& displacement : begin_->snapshot.displacements(state)) {
    add(displacement, begin_->left, begin_->right);
  }
  begin_.reset();
  ++cycles_;
}

void Convection::add(const Displacement& displacement, double left, double right) {
  const auto add_to = [&](Mean& mean, double share) {
    mean.weight += share * displacement.sites;
    mean.sum += share * displacement.sites * displacement.vector;
  };
  grid_.share_out(displacement.from,
                  [&](std::size_t cell, double share) { add_to(cells_[cell], share); });
  const double width = right - left;
  const Eigen::Vector2d at = displacement.from - Eigen::Vector2d((left + right) / 2, 0);
  if (std::abs(at.x()) <= kInside * width + kRoundingTolerance) {
    add_to(inside_, 1);
  } else if (std::abs(at.x()) >= kAtWalls * width - kRoundingTolerance) {
    add_to(at_walls_, 1);
  }
  share_out(1 + at.x() / width, halves_.size(), [&](std::size_t half, double share) {
    halves_[half].add(at, displacement, share * displacement.sites);
  });
}

void Convection::HalfBedSums::add(const Eigen::Vector2d& at, const Displacement& displacement,
                                  double sites) {
  weight += sites;
  place += sites * at;
  drift += sites * displacement.vector;
  cross += sites * cross_product(at, displacement.vector);
  square += sites * at.squaredNorm();
}

// Least squares of the drift against u + omega x (r - <r>); 0 for a half in one point.
double Convection::HalfBedSums::rotation() const {
  if (weight == 0) {
    return 0;
  }
  const double inertia = square - place.squaredNorm() / weight;
  const double turning = cross - cross_product(place, drift) / weight;
  return inertia > kRoundingTolerance * square ? turning / inertia : 0;
}

std::vector<ConvectionArrow> Convection::arrows() const {
  std::vector<ConvectionArrow> arrows;
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    const Mean& mean = cells_[cell];
    if (mean.weight > 0) {
      arrows.push_back({.centre = grid_.cell_centre(cell),
                        .displacement = mean.sum / mean.weight,
                        .weight = mean.weight});
    }
  }
  return arrows;
}

std::optional<ConvectionRolls> Convection::rolls() const {
  if (inside_.weight == 0 || at_walls_.weight == 0) {
    return std::nullopt;
  }
  return ConvectionRolls{
      .centre_minus_wall = inside_.sum.y() / inside_.weight - at_walls_.sum.y() / at_walls_.weight,
      .rotation_left = halves_[0].rotation(),
      .rotation_right = halves_[1].rotation()};
}

}  // namespace clca::measure
