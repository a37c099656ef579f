#include "clca/measure/force_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lattice/internal/require.hpp"
#include "measure/numbers.hpp"

namespace clca::measure {

namespace {

constexpr double kAveragedBin = 0.25;  // of the mean
constexpr double kFirstNumberLow = 0.5;
constexpr double kMaxSites = 1e6;  // of a contact

/// Fits the exponential tail. Static packings have beta from 1.4 (Radjai et al. 1996) to 1.9 (Mueth
/// et al. 1998).
/// Averages: density beta exp(-beta (x - 1)) of x = f/<f> > 1, so beta is the inverse mean of x -
/// 1. Whole sites: a geometric distribution from the first integer above the mean; with m the mean
/// excess over it, beta = <f> log(1 + 1/m), and the Fisher information is m (1 + m).
/// Treating whole sites as real numbers would bias beta if <f> is only a few sites.
void fit_tail(ForceDistribution& distribution, const std::vector<double>& strengths,
              Strength kind) {
  const double mean = distribution.mean;
  const bool whole = kind == Strength::whole_sites;
  const double start = whole ? std::floor(mean) + 1 : mean;
  double excess = 0;
  for (const double strength : strengths) {
    if (strength > mean * (1 + kRounding)) {
      ++distribution.tail;
      excess += strength - start;
    }
  }
  if (distribution.tail < 2 || excess <= 0) {
    return;
  }
  const auto count = static_cast<double>(distribution.tail);
  excess /= count;
  if (whole) {
    distribution.beta = mean * std::log1p(1 / excess);
    distribution.beta_error = mean / std::sqrt(count * excess * (1 + excess));
  } else {
    distribution.beta = mean / excess;
    distribution.beta_error = mean / excess / std::sqrt(count);
  }
}

void fill_bins(ForceDistribution& distribution, const std::vector<double>& strengths,
               Strength kind) {
  const bool whole = kind == Strength::whole_sites;
  const double width = whole ? 1 : kAveragedBin * distribution.mean;
  const double low = whole ? kFirstNumberLow : 0;
  const auto bin_of = [&](double strength) {
    return static_cast<std::size_t>(std::max(0.0, part_at((strength - low) / width)));
  };
  distribution.bins.resize(bin_of(*std::ranges::max_element(strengths)) + 1);
  for (const double strength : strengths) {
    ++distribution.bins[bin_of(strength)].count;
  }
  const double unit = static_cast<double>(strengths.size()) * width / distribution.mean;
  for (std::size_t number = 0; number < distribution.bins.size(); ++number) {
    ForceBin& bin = distribution.bins[number];
    bin.low = low + width * static_cast<double>(number);
    bin.high = bin.low + width;
    bin.density = static_cast<double>(bin.count) / unit;
  }
}

}  // namespace

std::optional<ForceDistribution> force_distribution(const std::vector<double>& strengths,
                                                    Strength kind) {
  if (strengths.empty()) {
    return std::nullopt;
  }
  const bool usable = std::ranges::all_of(
      strengths, [](double strength) { return strength > 0 && strength < kMaxSites; });
  require(usable, "the strength of a contact is a positive number of sites");
  const auto count = static_cast<double>(strengths.size());
  ForceDistribution distribution{
      .contacts = strengths.size(),
      .mean = std::accumulate(strengths.begin(), strengths.end(), 0.0) / count};
  fit_tail(distribution, strengths, kind);
  distribution.share_above_mean = static_cast<double>(distribution.tail) / count;
  fill_bins(distribution, strengths, kind);
  return distribution;
}

void ForceAverage::add(const std::vector<OverlapContact>& contacts) {
  ++samples_;
  for (const OverlapContact& contact : contacts) {
    Sum& sum = sums_[{contact.first, contact.second}];
    sum.sites += static_cast<std::uint64_t>(contact.sites);
    ++sum.samples;
  }
}

bool ForceAverage::precedes(const grains::State& now) const {
  return std::ranges::all_of(sums_, [&](const auto& pair) {
    const auto [first, second] = pair.first;
    const bool known =
        grains::is_particle(second)
            ? static_cast<std::size_t>(second) < now.particles.size()
            : grains::is_wall(second) && grains::wall_number(second) < now.walls.size();
    return known && first < now.particles.size();
  });
}

std::vector<ForceAverage::Mean> ForceAverage::means() const {
  std::vector<Mean> means;
  means.reserve(sums_.size());
  const auto samples = static_cast<double>(samples_);
  for (const auto& [pair, sum] : sums_) {
    means.push_back({.first = pair.first,
                     .second = pair.second,
                     .sites = static_cast<double>(sum.sites) / samples,
                     .share = static_cast<double>(sum.samples) / samples});
  }
  return means;
}

}  // namespace clca::measure
