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
  boltzmann::InitialCondition beginning;
  boltzmann::Dynamics process;
  int members = 4;
};

/// Quantities by name as in the reference tables, each with its value in every member.
using GasResult = std::map<std::string, std::vector<double>>;

/// Results at each of `times`, which ascend.
inline std::vector<GasResult> results(const GasCase& one, const std::vector<double>& times) {
  const auto bins = statistics::Bins::equiprobable(20, 3);
  const auto reference = statistics::chi_square_shares(bins, 3);
  std::vector<GasResult> all(times.size());
  for (int member = 0; member < one.members; ++member) {
    const auto seed = boltzmann::member_seed(1982, static_cast<std::uint64_t>(member));
    boltzmann::Gas gas = boltzmann::make_gas(one.beginning, seed);
    const boltzmann::Moments start = boltzmann::moments(gas.motions);
    for (std::size_t i = 0; i < times.size(); ++i) {
      // One thread each, as the tests run side by side.
      boltzmann::advance(gas, one.process, seed, times[i], 1);
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
      result["Pxx"].push_back(moments.p_xx);
      result["Pyy"].push_back(moments.p_yy);
      result["Pxy"].push_back(moments.p_xy);
      result["DHt_q20"].push_back(statistics::hellinger_distance(shares.translational, reference));
      result["DHr_q20"].push_back(statistics::hellinger_distance(shares.rotational, reference));
    }
  }
  return all;
}

/// What each member came to, averaged over the times from `first` on.
inline std::vector<double> late_means(const std::vector<GasResult>& all, std::size_t first,
                                      const std::string& quantity) {
  std::vector<double> means(all.front().at(quantity).size(), 0);
  for (std::size_t i = first; i < all.size(); ++i) {
    for (std::size_t member = 0; member < means.size(); ++member) {
      means[member] += all[i].at(quantity)[member] / static_cast<double>(all.size() - first);
    }
  }
  return means;
}

/// Expects `measured` within `tolerance` of `expected` and leaves both in the report of the tests.
inline void expect_near(const std::string& what, double measured, double expected,
                        double tolerance) {
  EXPECT_NEAR(measured, expected, tolerance) << what;
  ::testing::Test::RecordProperty(
      what, fmt::format("{:.6g}, expected {:.6g}, off by {:+.2f} of the tolerance {:.2g}", measured,
                        expected, (measured - expected) / tolerance, tolerance));
}

/// The same for the mean of an ensemble: within 4 standard errors, and `systematic`.
inline void expect_mean(const std::string& what, const std::vector<double>& values, double expected,
                        double expected_error = 0, double systematic = 0) {
  const statistics::SampleStatistics measured = sample(values);
  expect_near(what, measured.mean, expected,
              4 * std::hypot(measured.standard_error, expected_error) + systematic);
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
