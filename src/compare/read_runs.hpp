#pragma once
// Reading the two runs. All functions throw CompareError.

#include "clca/compare/compare.hpp"

namespace clca::compare {

struct AutomatonSide {
  std::string scene;
  std::string stage;
  std::vector<Distribution> distributions;
};
AutomatonSide read_automaton(const std::filesystem::path& run, const RunChoice& choice);

struct BoltzmannSide {
  std::string scene;
  double time = 0;
  std::vector<Distribution> distributions;
};
BoltzmannSide read_boltzmann(const std::filesystem::path& run, const RunChoice& choice);

}  // namespace clca::compare
