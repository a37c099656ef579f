#pragma once
// What passes a straight line and how fast, in parts of the line; lengths in lattice spacings.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/measure/displacement.hpp"
#include "clca/reflection/reflection.hpp"
#include "clca/statistics/sample.hpp"

namespace clca::measure {

/// Sums for one part of a line. Points: evenly spaced on the part.
struct LinePartSums {
  double open = 0;      ///< points that no wall covers, times steps
  double covered = 0;   ///< of these, those that a particle covers
  double followed = 0;  ///< of these, those that a particle of known velocity covers
  /// Sum of the velocities at followed points times steps: across the line, and along it.
  Eigen::Vector2d displacement = Eigen::Vector2d::Zero();
  double sites = 0;      ///< passed to the right, less those to the left
  double particles = 0;  ///< whose centres have passed, either way

  CLCA_FIELDS(open, covered, followed, displacement, sites, particles);
};

/// Sums over a number of observations, one after the other.
struct LineBlock {
  std::uint64_t observations = 0;
  double steps = 0;
  std::vector<LinePartSums> parts = {};

  CLCA_FIELDS(observations, steps, parts);
};

/// Sums over all observations of a line, in blocks for standard errors. Each block but the last has
/// the same number of observations: when there are kMaxBlocks, they are joined in pairs.
class LineSums {
 public:
  static constexpr std::size_t kMaxBlocks = 16;

  static double bytes_for(double parts) { return parts * kMaxBlocks * sizeof(LinePartSums); }

  explicit LineSums(std::size_t parts = 0) : parts_(parts) {}

  /// Counts an observation over `steps` steps; returns the block that it is to be added to.
  LineBlock& begin_observation(double steps);
  const std::vector<LineBlock>& blocks() const { return blocks_; }

  /// False if these cannot be sums of a line of so many parts.
  bool fits_part_count(std::size_t parts) const;
  CLCA_FIELDS(parts_, block_size_, blocks_);

 private:
  std::uint64_t parts_;
  std::uint64_t block_size_ = 1;  // observations
  std::vector<LineBlock> blocks_;
};

/// Means over time for one part of a line, with standard errors by the scatter of the blocks; NaN
/// without data, the error with fewer than LineSums::kMaxBlocks / 2 blocks. Across: positive to the
/// right of its direction. SampleStatistics: only mean and standard error are set.
struct LinePart {
  double position = 0;     ///< distance of its middle from the start of the line
  Eigen::Vector2d middle;  ///< of the part
  /// Sites that pass, per step and spacing; to the right less to the left.
  statistics::SampleStatistics flux;
  statistics::SampleStatistics across_velocity;  ///< velocity, spacings per step
  statistics::SampleStatistics along_velocity;  ///< likewise, positive in the direction of the line
  double covered_share = 0;                     ///< by particles, of what no wall covers; else 0
  double passed_particles = 0;                  ///< whose centres have passed, either way
};

/// A line in a box, without its end, in equal parts; edges between parts belong half to each.
class Line {
 public:
  /// A line in the box of the state. Throws std::invalid_argument unless the
  /// line has a length and at least one part.
  Line(const grains::State& state, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
       std::size_t parts);

  /// Adds an observation: what is on the line now, and what has passed it since the snapshot, on
  /// straight paths (Snapshot::displacement). `velocities` (spacings per step) are by id. Throws
  /// std::invalid_argument unless the snapshot is earlier and the occupancy is of this box.
  void observe(const Snapshot& before, const grains::State& now, const grains::Occupancy& occupancy,
               std::span<const std::optional<Eigen::Vector2d>> velocities, LineSums& sums) const;

  static double bytes_for(double parts) { return parts * kMaxPoints * sizeof(std::size_t); }

  std::size_t part_count() const { return points_.size(); }
  std::vector<LinePart> part_means(const LineSums& sums) const;

 private:
  static constexpr double kMaxPoints = 256;  // of a part

  struct Crossing {
    double position;  // on the line, from its start
    bool to_right;
  };

  double part_length() const { return length_ / static_cast<double>(part_count()); }
  Eigen::Vector2d across_and_along(const Eigen::Vector2d& vector) const;
  std::optional<Crossing> crossing(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  void add_covered_points(const grains::Occupancy& occupancy,
                          std::span<const std::optional<Eigen::Vector2d>> velocities, double steps,
                          LineBlock& block) const;
  void add_passing_particles(const Snapshot& before, const grains::State& now,
                             LineBlock& block) const;
  void add_particle_path(const lattice::Shape& shape, const Eigen::Vector2d& from,
                         const Eigen::Vector2d& to, LineBlock& block) const;
  void add_site_crossing(const Crossing& crossing, LineBlock& block) const;
  std::pair<int, int> images(double low, double high, const lattice::Lattice& lattice) const;

  Eigen::Vector2d from_;
  Eigen::Vector2d direction_;  // unit vectors
  Eigen::Vector2d right_;
  double length_;
  std::vector<std::vector<std::size_t>> points_;  // by part: indices of their sites
  std::vector<double> reaches_;  // by kind: of its sites from the centre of mass, spacings
};

}  // namespace clca::measure
