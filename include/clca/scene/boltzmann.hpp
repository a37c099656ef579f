#pragma once
// A scene of the Boltzmann equation: all parameters of a run as validated values. Times and
// velocities in the units of boltzmann/gas.hpp.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "clca/boltzmann/gas.hpp"
#include "clca/boltzmann/scheme.hpp"
#include "clca/scene/output.hpp"

namespace clca::scene {

struct QuantileBins {
  int count = 20;
};
struct UniformBins {
  double width = 0.5;          ///< of the energy X: v²/T_tr or w²/T_rot
  double last_bin_start = 15;  ///< where the last bin begins
};
using BinsSpec = std::variant<QuantileBins, UniformBins>;

/// Observation times that differ by less than this share of `series_interval` are equal.
inline constexpr double kTimeTolerance = 1e-9;

struct BoltzmannScene {
  std::string name;   ///< of the file, without folder and ending
  std::string title;  ///< the name where the file gives none
  std::uint64_t seed = 1;
  std::uint64_t particles = 10'000;
  boltzmann::InitialDistribution initial = boltzmann::InitialDistribution::gaussian;
  bool exact_moments = true;
  bool quasi_random = false;               ///< sampling: quasi
  std::vector<double> restitutions = {1};  ///< one run for each, in this order
  /// Whether the file has a list (even of one): tables then have a column for it.
  bool has_restitution_list = false;
  double friction = 0;      ///< boltzmann::kNoSlidingLimit where the file gives a roughness only
  double roughness = 0;     ///< as in boltzmann::Law
  double energy_ratio = 1;  ///< initial, rotational over translational
  boltzmann::Scheme scheme;
  double shear_rate = 0;
  double end_time = 15;
  std::uint64_t ensemble_size = 1;
  double series_interval = 0.5;
  std::vector<double> histogram_times;  ///< times, ascending, none beyond `end_time`
  BinsSpec bins;
  std::optional<CheckpointIntervals> checkpoint = kDefaultCheckpoints;
  std::string location;  ///< FILE:LINE:COLUMN of the block `boltzmann`, for messages
};

/// Initial condition of each gas of the ensemble.
boltzmann::InitialCondition initial_condition(const BoltzmannScene& scene);
/// Law of collision and driving of each gas.
boltzmann::Dynamics gas_process(const BoltzmannScene& scene, double restitution);

}  // namespace clca::scene
