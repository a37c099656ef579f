#include "clca/measure/profile.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/places.hpp"

namespace clca::measure {

namespace {

constexpr double kFlankLow = 0.15;
constexpr double kFlankHigh = 0.80;
constexpr std::size_t kFlankColumns = 5;
constexpr double kExplained = 0.25;  // of the variance of the heights, at least
constexpr double kTopOverCentre =
    1.0;  // height of a site's top over the floor (y = -1/2), less its y

/// Lowest and highest row with a particle, per column.
struct RowBounds {
  int low = -1;
  int high = -1;
  bool empty() const { return high < 0; }
};

std::vector<RowBounds> row_bounds_by_column(const grains::State& state) {
  std::vector<RowBounds> bounds(static_cast<std::size_t>(state.lattice.columns()));
  for_each_site(state, [&](lattice::Site site) {
    RowBounds& column = bounds[static_cast<std::size_t>(site.column)];
    column.low = column.empty() ? site.row : std::min(column.low, site.row);
    column.high = std::max(column.high, site.row);
  });
  return bounds;
}

/// The least-squares line through the points; none if it does not fall.
ReposeAngle::Flank falling_slope(const std::vector<double>& x, const std::vector<double>& height) {
  const auto rows = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixX2d design(rows, 2);
  design.col(0).setOnes();
  design.col(1) = Eigen::Map<const Eigen::VectorXd>(x.data(), rows);
  const Eigen::Map<const Eigen::VectorXd> values(height.data(), rows);
  const Eigen::Vector2d line = design.colPivHouseholderQr().solve(values);
  const double angle = std::atan(-line[1]) * 180.0 / std::numbers::pi;
  if (angle <= 0) {
    return {};
  }
  const double residual = (values - design * line).squaredNorm();
  const double variance = (values.array() - values.mean()).matrix().squaredNorm();
  if (residual > (1 - kExplained) * variance) {
    return {.degrees = {}, .is_uneven = true};
  }
  return {.degrees = angle};
}

/// The flank that falls towards the end of `profile`: a line through the
/// columns beyond the middle of the top with heights between the bounds.
ReposeAngle::Flank falling_flank(const std::vector<double>& profile) {
  if (profile.empty()) {
    return {};
  }
  const double highest = *std::ranges::max_element(profile);
  const double high = kFlankHigh * highest;
  const double low = kFlankLow * highest;
  double top_sum = 0;
  double top_count = 0;
  for (std::size_t column = 0; column < profile.size(); ++column) {
    if (profile[column] >= high) {
      top_sum += static_cast<double>(column);
      top_count += 1;
    }
  }
  std::vector<double> x;
  std::vector<double> height;
  for (std::size_t column = 0; column < profile.size(); ++column) {
    if (static_cast<double>(column) * top_count > top_sum && profile[column] < high &&
        profile[column] >= low) {
      x.push_back(lattice::kColumnPitch * static_cast<double>(column));
      height.push_back(profile[column]);
    }
  }
  return x.size() >= kFlankColumns ? falling_slope(x, height) : ReposeAngle::Flank();
}

}  // namespace

std::vector<double> surface_profile(const grains::State& state) {
  const std::vector<RowBounds> bounds = row_bounds_by_column(state);
  std::vector<double> profile(bounds.size(), 0.0);
  for (std::size_t column = 0; column < bounds.size(); ++column) {
    if (!bounds[column].empty()) {
      const lattice::Site top = {static_cast<int>(column), bounds[column].high};
      profile[column] = lattice::position(top).y() + kTopOverCentre;
    }
  }
  return profile;
}

std::vector<double> surface_profile(const grains::State& state, const Eigen::Vector2d& down) {
  std::vector<Eigen::Vector2d> points;  // to the right, up
  Eigen::Vector2d lowest = Eigen::Vector2d::Constant(kInfinity);
  double last = -kInfinity;
  for_each_site(state, [&](lattice::Site site) {
    const Eigen::Vector2d point = lattice::position(site);
    points.emplace_back(down.x() * point.y() - down.y() * point.x(), -point.dot(down));
    lowest = lowest.cwiseMin(points.back());
    last = std::max(last, points.back().x());
  });
  std::vector<double> profile;
  const auto column_of = [&](double x) {
    return static_cast<std::size_t>(part_at((x - lowest.x()) / lattice::kColumnPitch));
  };
  if (!points.empty()) {
    profile.resize(column_of(last) + 1, 0.0);
  }
  for (const Eigen::Vector2d& point : points) {
    double& height = profile[column_of(point.x())];
    height = std::max(height, point.y() - lowest.y() + kTopOverCentre);
  }
  return profile;
}

double mean_height(const std::vector<double>& profile) {
  double sum = 0;
  double count = 0;
  for (const double height : profile) {
    sum += height;
    count += height > 0 ? 1 : 0;
  }
  return count > 0 ? sum / count : 0;
}

std::optional<double> ReposeAngle::mean_degrees() const {
  if (left.degrees && right.degrees) {
    return (*left.degrees + *right.degrees) / 2;
  }
  return left.degrees ? left.degrees : right.degrees;
}

ReposeAngle repose_angle(const std::vector<double>& profile) {
  return {.left = falling_flank({profile.rbegin(), profile.rend()}),
          .right = falling_flank(profile)};
}

std::optional<double> packing_fraction(const grains::State& state) {
  const std::vector<RowBounds> bounds = row_bounds_by_column(state);
  const std::vector<bool> walled = wall_mask(state);
  double available = 0;
  for (int column = 0; column < state.lattice.columns(); ++column) {
    const RowBounds bed = bounds[static_cast<std::size_t>(column)];
    int floor = -1;  // row of the highest wall site under the bed
    for (int row = 0; row < bed.high; ++row) {
      const bool is_walled = walled[state.lattice.index({column, row})];
      if (row >= bed.low) {
        available += is_walled ? 0 : 1;
      } else if (is_walled) {
        floor = row;
      }
    }
    available += bed.empty() ? 0 : bed.low - floor;
  }
  double filled = 0;
  for_each_site(state, [&](lattice::Site) { filled += 1; });
  return available > 0 ? std::optional(filled / available) : std::nullopt;
}

}  // namespace clca::measure
