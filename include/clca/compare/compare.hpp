#pragma once
// Compares the energy distributions of an automaton run and a Boltzmann run. Bins are equally
// probable under chi-square, with 2 degrees of freedom in the plane and 3 in space, so that bin k
// of one corresponds to bin k of the other.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "clca/text/input_error.hpp"

namespace clca::compare {

/// The runs cannot be compared. what() is one line with the file and why.
class CompareError : public text::InputError {
 public:
  using InputError::InputError;
};

struct RunChoice {
  std::optional<std::string> stage = {};   ///< of the automaton; none: the last with a distribution
  std::optional<double> time = {};         ///< of the Boltzmann run; none: the latest
  std::optional<double> restitution = {};  ///< needed where the run has several
};

/// Shares by bin. Names: automaton, automaton_local (measure::Fluctuations),
/// boltzmann_translational and, unless its spheres do not spin, boltzmann_rotational.
struct Distribution {
  std::string name;
  std::vector<double> shares;
  std::uint64_t samples = 0;
};

/// Hellinger distance of a distribution from chi-square, or between two.
struct Distance {
  std::string name;  ///< of the distribution, or of both, as in A:B
  double distance = 0;
  double floor = 0;  ///< expected distance of that many independent samples of equal distributions
  std::uint64_t samples = 0;  ///< the fewer of the two
};

struct Comparison {
  std::string title;  ///< both scenes, with stage and time
  std::string stage;
  double time = 0;
  std::vector<Distribution> distributions;
};

/// Reads the folders of the two runs. Throws CompareError.
Comparison comparison(const std::filesystem::path& automaton_run,
                      const std::filesystem::path& boltzmann_run, const RunChoice& choice);

/// Each from chi-square, then each automaton distribution from each Boltzmann one.
std::vector<Distance> distances(const Comparison& comparison);

/// Writes comparison.csv (quantile_lower, quantile_upper, a column per distribution, reference),
/// distances.csv (name, distance, floor, samples) and a run.json of kind "comparison" for figures
/// into `folder`, made if needed.
/// Throws store::StoreError, and CompareError if the folder holds another run.
void write(const Comparison& comparison, const std::filesystem::path& folder);

}  // namespace clca::compare
