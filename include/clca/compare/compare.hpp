#pragma once
// A run of the automaton beside one of the Boltzmann equation: how the energies of their particles
// are distributed. Both are in bins that are equally probable under chi-square, with 2 degrees of
// freedom in the plane and 3 in space, so that bin k of one answers to bin k of the other.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace clca::compare {

/// The runs cannot be compared. what() is one line with the file and why.
class CompareError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Choice {
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

/// Hellinger distance of a distribution from chi-square, or of one from another.
struct Distance {
  std::string name;  ///< of the distribution, or of both, as in A:B
  double distance = 0;
  double floor = 0;  ///< what it is on the average for that many independent samples of equals
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
                      const std::filesystem::path& boltzmann_run, const Choice& choice);

/// Each from chi-square, then each of the automaton from each of the Boltzmann run.
std::vector<Distance> distances(const Comparison& comparison);

/// Writes comparison.csv (quantile_lower, quantile_upper, a column per distribution, reference) and
/// distances.csv (name, distance, floor, samples) into `folder`, made if need be, and a run.json of
/// kind "comparison" that lets figures be drawn. Throws store::StoreError, and
/// CompareError where a run of another kind lies there.
void write(const Comparison& comparison, const std::filesystem::path& folder);

}  // namespace clca::compare
