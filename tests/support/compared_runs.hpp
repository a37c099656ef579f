#pragma once
// Folders as runs leave them, as far as clca compare reads them.

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"

namespace clca::testing {

/// 20 shares that grow or fall along a line; `slope` between -0.05 and 0.05.
inline std::vector<double> sloping_shares(double slope, int bins = 20) {
  std::vector<double> shares;
  for (int bin = 0; bin < bins; ++bin) {
    shares.push_back(1.0 / bins + slope * (2 * bin + 1 - bins) / bins);
  }
  return shares;
}

/// Lines of a histogram: start, lower, upper, share, end; the edges count the bins.
inline std::string histogram_lines(const std::string& start, const std::vector<double>& shares,
                                   const std::string& end) {
  std::string lines;
  for (std::size_t bin = 0; bin < shares.size(); ++bin) {
    const std::string upper = bin + 1 < shares.size() ? fmt::format("{}", bin + 1) : "";
    lines += fmt::format("{}{},{},{}{}\n", start, bin, upper, shares[bin], end);
  }
  return lines;
}

inline void write_gas_summary(const std::filesystem::path& run, std::uint64_t particles) {
  std::filesystem::create_directories(run);
  store::RunSummary summary;
  summary.kind = "boltzmann";
  summary.scene = "gas";
  summary.particles = particles;
  store::write_whole(run / "run.json", store::to_json(summary));
}

/// A Boltzmann run of 10,000 particles with one histogram: sloping shares.
inline void write_gas(const std::filesystem::path& run, const std::string& time,
                      double translational_slope, double rotational_slope) {
  write_gas_summary(run, 10'000);
  store::write_whole(
      run / ("histogram-" + time + ".csv"),
      "energy,lower,upper,share,reference\n" +
          histogram_lines("translational,", sloping_shares(translational_slope), ",0.05") +
          histogram_lines("rotational,", sloping_shares(rotational_slope), ",0.05"));
}

}  // namespace clca::testing
