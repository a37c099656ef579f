#pragma once
// Ensembles of gases, and the reference tables of tests/data/boltzmann.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "clca/boltzmann/observation.hpp"
#include "clca/boltzmann/scheme.hpp"
#include "support/runs.hpp"

namespace clca::testing {

struct GasCase {
  boltzmann::Beginning beginning;
  boltzmann::Process process;
  int members = 4;
};

/// Quantities by name as in the reference tables, each with its value in every member.
using GasResult = std::map<std::string, std::vector<double>>;

/// Results at each of `times`, which ascend.
inline std::vector<GasResult> results(const GasCase& one, const std::vector<double>& times) {
  const auto bins = boltzmann::Bins::equiprobable(20, 3);
  const auto reference = boltzmann::chi_square_shares(bins, 3);
  std::vector<GasResult> all(times.size());
  for (int member = 0; member < one.members; ++member) {
    const auto seed = boltzmann::member_seed(1982, static_cast<std::uint64_t>(member));
    boltzmann::Gas gas = boltzmann::make_gas(one.beginning, seed);
    const boltzmann::Moments start = boltzmann::moments(gas.motions);
    for (std::size_t i = 0; i < times.size(); ++i) {
      boltzmann::advance(gas, one.process, seed, times[i], 2);
      const auto moments = boltzmann::moments(gas.motions);
      const auto shares = boltzmann::energy_shares(gas.motions, moments, bins);
      GasResult& result = all[i];
      result["Ttr"].push_back(moments.translational / start.translational);
      result["Trot"].push_back(moments.rotational / start.rotational);
      result["ncoll"].push_back(gas.collisions_per_particle());
      result["a2t"].push_back(moments.a2_translational);
      result["a2r"].push_back(moments.a2_rotational);
      result["crel"].push_back(moments.correlation);
      result["ori"].push_back(moments.alignment);
      result["DHt_q20"].push_back(boltzmann::hellinger_distance(shares.translational, reference));
      result["DHr_q20"].push_back(boltzmann::hellinger_distance(shares.rotational, reference));
    }
  }
  return all;
}

/// One line of a reference table.
struct Reference {
  double value = 0;
  double standard_error = 0;
  double particles = 0;
  double runs = 0;
};

class ReferenceTable {
 public:
  explicit ReferenceTable(const std::string& name)
      : file_(std::string(CLCA_SOURCE_DIR "/tests/data/boltzmann/") + name + ".csv") {}

  /// The line of case 1 or 2, a restitution and a time; friction 0.3, energy ratio 1.
  Reference at(int kind, double restitution, double time, const std::string& quantity) {
    const std::vector<double>& kinds = column("case");
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (kinds[i] == kind && std::abs(column("eps")[i] - restitution) < 1e-9 &&
          std::abs(column("t")[i] - time) < 1e-9) {
        return {column(quantity)[i], column(quantity + "_se")[i], column("N")[i],
                column("nseeds")[i]};
      }
    }
    throw std::out_of_range(fmt::format("no line of case {}, {} at {}", kind, restitution, time));
  }

 private:
  const std::vector<double>& column(const std::string& name) {
    auto [found, is_new] = columns_.try_emplace(name);
    if (is_new) {
      found->second = csv_column(file_, name);
    }
    return found->second;
  }

  std::string file_;
  std::map<std::string, std::vector<double>> columns_;
};

}  // namespace clca::testing
