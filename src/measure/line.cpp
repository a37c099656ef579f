#include "clca/measure/line.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "measure/places.hpp"

namespace clca::measure {

namespace {

constexpr double kPointsPerSpacing = 4;  // so that a part has its share of each site it cuts

/// A sum over one block that is a mean once divided by its weight.
struct Weighted {
  double sum = 0;
  double weight = 0;
};

/// Mean over all blocks of what `weighted` gives of each; its error is that of a ratio of sums.
template <class Weigh>
statistics::SampleStatistics mean_of(const std::vector<LineBlock>& blocks, Weigh weighted) {
  Weighted total;
  std::size_t filled = 0;
  for (const LineBlock& block : blocks) {
    const auto [sum, weight] = weighted(block);
    total.sum += sum;
    total.weight += weight;
    filled += weight > 0 ? 1 : 0;
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (total.weight <= 0) {
    return {.mean = kNone, .standard_error = kNone};
  }
  statistics::SampleStatistics result = {.mean = total.sum / total.weight, .standard_error = kNone};
  if (filled >= LineSums::kMaxBlocks / 2) {
    double scatter = 0;
    for (const LineBlock& block : blocks) {
      const auto [sum, weight] = weighted(block);
      const double deviation = sum - result.mean * weight;
      scatter += deviation * deviation;
    }
    const auto count = static_cast<double>(filled);
    result.standard_error = std::sqrt(scatter * count / (count - 1)) / total.weight;
  }
  return result;
}

}  // namespace

LineBlock& LineSums::begin_observation(double steps) {
  const bool full = blocks_.empty() || blocks_.back().observations >= block_size_;
  if (full && blocks_.size() == kMaxBlocks) {
    for (std::size_t pair = 0; pair < kMaxBlocks / 2; ++pair) {
      LineBlock joined = std::move(blocks_[2 * pair]);
      const LineBlock& next = blocks_[2 * pair + 1];
      joined.observations += next.observations;
      joined.steps += next.steps;
      for (std::size_t part = 0; part < parts_; ++part) {
        reflection::add_fields(joined.parts[part], next.parts[part]);
      }
      blocks_[pair] = std::move(joined);
    }
    blocks_.resize(kMaxBlocks / 2);
    block_size_ *= 2;
  }
  if (full) {
    blocks_.push_back({.parts = std::vector<LinePartSums>(parts_)});
  }
  LineBlock& block = blocks_.back();
  ++block.observations;
  block.steps += steps;
  return block;
}

bool LineSums::fits_part_count(std::size_t parts) const {
  return parts_ == parts && blocks_.size() <= kMaxBlocks && block_size_ > 0 &&
         std::ranges::all_of(blocks_,
                             [=](const LineBlock& block) { return block.parts.size() == parts; });
}

Line::Line(const grains::State& state, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
           std::size_t parts)
    : from_(from),
      direction_((to - from).normalized()),
      right_(direction_.y(), -direction_.x()),
      length_((to - from).norm()),
      points_(parts) {
  require(length_ > 0 && parts > 0, "a line needs a length and parts");
  const auto count = static_cast<std::size_t>(
      std::clamp(std::ceil(kPointsPerSpacing * part_length()), 1.0, kMaxPoints));
  const double distance = part_length() / static_cast<double>(count);
  for (std::size_t point = 0; point < parts * count; ++point) {
    const double position = distance * (static_cast<double>(point) + 0.5);
    const lattice::Site site = lattice::nearest_site(from_ + position * direction_);
    if (state.lattice.contains(site)) {
      points_[point / count].push_back(state.lattice.index(site));
    }
  }
  std::ranges::transform(state.kinds, std::back_inserter(reaches_),
                         [](const grains::Kind& kind) { return max_site_distance(kind.shape); });
}

Eigen::Vector2d Line::across_and_along(const Eigen::Vector2d& vector) const {
  return {vector.dot(right_), vector.dot(direction_)};
}

std::optional<Line::Crossing> Line::crossing(const Eigen::Vector2d& from,
                                             const Eigen::Vector2d& to) const {
  const Eigen::Vector2d start = across_and_along(from - from_);
  const Eigen::Vector2d end = across_and_along(to - from_);
  if ((start.x() > kRoundingTolerance) == (end.x() > kRoundingTolerance)) {
    return std::nullopt;
  }
  const double share = start.x() / (start.x() - end.x());
  const double position = start.y() + share * (end.y() - start.y());
  if (position < -kRoundingTolerance || position >= length_ - kRoundingTolerance) {
    return std::nullopt;
  }
  return Crossing{.position = std::max(0.0, position), .to_right = end.x() > kRoundingTolerance};
}

void Line::observe(const Snapshot& before, const grains::State& now,
                   const grains::Occupancy& occupancy,
                   std::span<const std::optional<Eigen::Vector2d>> velocities,
                   LineSums& sums) const {
  check_occupancy(now, occupancy);
  require(before.step() < now.step, "a line is observed after the snapshot");
  const auto steps = static_cast<double>(now.step - before.step());
  LineBlock& block = sums.begin_observation(steps);
  add_covered_points(occupancy, velocities, steps, block);
  add_passing_particles(before, now, block);
}

void Line::add_covered_points(const grains::Occupancy& occupancy,
                              std::span<const std::optional<Eigen::Vector2d>> velocities,
                              double steps, LineBlock& block) const {
  for (std::size_t part = 0; part < part_count(); ++part) {
    LinePartSums& sums = block.parts[part];
    for (const std::size_t index : points_[part]) {
      const grains::Owner owner = occupancy.owner(index);
      if (grains::is_obstacle(owner)) {
        continue;
      }
      sums.open += steps;
      if (!grains::is_particle(owner)) {
        continue;
      }
      sums.covered += steps;
      if (const auto& velocity = velocities[grains::particle_id(owner)]) {
        sums.followed += steps;
        sums.displacement += steps * across_and_along(*velocity);
      }
    }
  }
}

void Line::add_passing_particles(const Snapshot& before, const grains::State& now,
                                 LineBlock& block) const {
  for (std::size_t id = 0; id < now.particles.size(); ++id) {
    const grains::Particle& particle = now.particles[id];
    const std::optional<Displacement> path = before.displacement(now, id);
    if (!path) {
      continue;
    }
    const Eigen::Vector2d& from = path->from;
    const Eigen::Vector2d to = from + path->vector;
    const double radius = reaches_[particle.kind];
    const auto [low, high] = std::minmax({from.x(), to.x()});
    const auto [first, last] = images(low - radius, high + radius, now.lattice);
    for (int image = first; image <= last; ++image) {
      const Eigen::Vector2d shift(image * now.lattice.extent().x(), 0);
      const double start = right_.dot(from + shift - from_);
      const double end = right_.dot(to + shift - from_);
      if (std::min(start, end) <= radius && std::max(start, end) >= -radius) {
        add_particle_path(now.shape(particle), from + shift, to + shift, block);
      }
    }
  }
}

/// First and last number of box widths that shift a range of x onto the line; none if first > last.
std::pair<int, int> Line::images(double low, double high, const lattice::Lattice& lattice) const {
  if (!lattice.periodic()) {
    return {0, 0};
  }
  const auto [left, right] = std::minmax({from_.x(), from_.x() + length_ * direction_.x()});
  const double width = lattice.extent().x();
  return {static_cast<int>(std::ceil((left - high) / width)),
          static_cast<int>(std::floor((right - low) / width))};
}

void Line::add_particle_path(const lattice::Shape& shape, const Eigen::Vector2d& from,
                             const Eigen::Vector2d& to, LineBlock& block) const {
  for (const lattice::Axial site : shape.sites()) {
    const Eigen::Vector2d offset = lattice::position(site) - shape.centroid();
    if (const auto passed = crossing(from + offset, to + offset)) {
      add_site_crossing(*passed, block);
    }
  }
  if (const auto passed = crossing(from, to)) {
    share_out(passed->position / part_length(), part_count(),
              [&](std::size_t part, double share) { block.parts[part].particles += share; });
  }
}

/// Adds a site that crosses the line. It has a width, and counts over one spacing: else parts in
/// which one column more ends would have more flux.
void Line::add_site_crossing(const Crossing& crossing, LineBlock& block) const {
  const double low = std::max(0.0, crossing.position - 0.5);
  const double high = std::min(length_, crossing.position + 0.5);
  const double density = (crossing.to_right ? 1 : -1) / (high - low);
  for (auto part = static_cast<std::size_t>(low / part_length()); part < part_count(); ++part) {
    const double left = part_length() * static_cast<double>(part);
    if (left >= high) {
      break;
    }
    const double right = part + 1 == part_count() ? length_ : left + part_length();
    block.parts[part].sites += density * std::max(0.0, std::min(high, right) - std::max(low, left));
  }
}

std::vector<LinePart> Line::part_means(const LineSums& sums) const {
  std::vector<LinePart> result;
  for (std::size_t part = 0; part < part_count(); ++part) {
    LinePartSums total;
    for (const LineBlock& block : sums.blocks()) {
      reflection::add_fields(total, block.parts[part]);
    }
    const double position = part_length() * (static_cast<double>(part) + 0.5);
    const auto velocity = [part](Eigen::Index component) {
      return [=](const LineBlock& block) {
        const LinePartSums& of_part = block.parts[part];
        return Weighted{of_part.displacement[component], of_part.followed};
      };
    };
    const auto flux = [=, this](const LineBlock& block) {
      return Weighted{block.parts[part].sites, block.steps * part_length()};
    };
    result.push_back({.position = position,
                      .middle = from_ + position * direction_,
                      .flux = mean_of(sums.blocks(), flux),
                      .across_velocity = mean_of(sums.blocks(), velocity(0)),
                      .along_velocity = mean_of(sums.blocks(), velocity(1)),
                      .covered_share = total.open > 0 ? total.covered / total.open : 0,
                      .passed_particles = total.particles});
  }
  return result;
}

}  // namespace clca::measure
