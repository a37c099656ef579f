#pragma once
// Distribution of the index of force over contacts, at one moment or averaged over time.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "clca/measure/force.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::measure {

/// Whole sites at one moment, real numbers as averages.
enum class Strength : std::uint8_t { whole_sites, averaged };

struct ForceBin {
  double low = 0;  ///< sites
  double high = 0;
  std::size_t count = 0;
  double density = 0;  ///< of f/<f>: over all bins it integrates to 1
};

struct ForceDistribution {
  std::size_t contacts = 0;
  double mean = 0;              ///< <f>, sites
  double share_above_mean = 0;  ///< of the contacts
  std::size_t tail = 0;         ///< contacts above the mean
  /// Decay of the tail, P(f/<f>) ~ exp(-beta f/<f>) for f > <f>, by maximum likelihood, with its
  /// standard error. None for fewer than two contacts in the tail or if all are equal.
  std::optional<double> beta = {};
  std::optional<double> beta_error = {};
  /// Contiguous bins. Whole sites: one bin per number n, from n - 1/2 to n + 1/2. Averages: bins of
  /// a quarter of the mean, from 0.
  std::vector<ForceBin> bins = {};
};

/// For strengths in sites; none if the list is empty. Throws std::invalid_argument unless all are
/// in (0, 10^6).
std::optional<ForceDistribution> force_distribution(const std::vector<double>& strengths,
                                                    Strength kind);

/// Averages the strength of each contact over samples; a contact absent from a sample counts as 0.
class ForceAverage {
 public:
  struct Mean {
    std::uint32_t first = 0;
    grains::Owner second = 0;
    double sites = 0;  ///< mean over all samples
    double share = 0;  ///< of the samples in which the contact was there

    bool operator==(const Mean&) const = default;
  };

  /// Adds one sample.
  void add(const std::vector<OverlapContact>& contacts);

  std::uint64_t samples() const { return samples_; }
  /// All contacts that occurred, sorted by `first`, then `second`.
  std::vector<Mean> means() const;

  /// False if some contact cannot be from a run that reached `now`.
  bool precedes(const grains::State& now) const;
  CLCA_FIELDS(samples_, sums_);

 private:
  struct Sum {
    std::uint64_t sites = 0;
    std::uint64_t samples = 0;

    CLCA_FIELDS(sites, samples);
  };

  std::uint64_t samples_ = 0;
  std::map<std::pair<std::uint32_t, grains::Owner>, Sum> sums_;
};

/// The sites of each contact.
template <class Contact>
std::vector<double> strengths(const std::vector<Contact>& contacts) {
  std::vector<double> sites;
  sites.reserve(contacts.size());
  for (const Contact& contact : contacts) {
    sites.push_back(contact.sites);
  }
  return sites;
}

}  // namespace clca::measure
