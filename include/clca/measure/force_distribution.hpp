#pragma once
// How the index of force is distributed over contacts, at one moment or averaged over time.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "clca/fields/fields.hpp"
#include "clca/measure/contacts.hpp"

namespace clca::measure {

/// Strengths are whole sites at one moment and real numbers when they are averages.
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
  /// Slope of the tail, P(f/<f>) ~ exp(-beta f/<f>) for f > <f>, by maximum likelihood, and its
  /// standard error; none for fewer than two contacts in the tail or where all of them are alike.
  std::optional<double> beta = {};
  std::optional<double> beta_error = {};
  /// Without gaps. For whole sites one bin for each number, from half a site below to half above,
  /// beginning at one site; for averages bins of a quarter of the mean, beginning at 0.
  std::vector<ForceBin> bins = {};
};

/// Of strengths in sites; none where there are none. Throws std::invalid_argument unless all are
/// greater than 0 and less than 10^6.
std::optional<ForceDistribution> force_distribution(const std::vector<double>& strengths,
                                                    Strength kind);

/// Averages the strength of each contact over samples. A contact that is absent from a sample
/// counts 0 there.
class ForceAverage {
 public:
  struct Mean {
    std::uint32_t first = 0;
    grains::Owner second = 0;
    double sites = 0;  ///< mean over all samples
    double share = 0;  ///< of the samples in which the contact was there

    bool operator==(const Mean&) const = default;
  };

  /// Takes one sample.
  void add(const std::vector<Contact>& contacts);

  std::uint64_t samples() const { return samples_; }
  /// All contacts that were there, by `first`, then `second`.
  std::vector<Mean> means() const;

  /// False where some contact is not one of a run that has come to `now`.
  bool precedes(const grains::State& now) const;
  static constexpr auto fields();

 private:
  struct Sum {
    std::uint64_t sites = 0;
    std::uint64_t samples = 0;

    static constexpr auto fields() {
      using fields::field;
      return std::make_tuple(field("sites", &Sum::sites), field("samples", &Sum::samples));
    }
  };

  std::uint64_t samples_ = 0;
  std::map<std::pair<std::uint32_t, grains::Owner>, Sum> sums_;
};

constexpr auto ForceAverage::fields() {
  using fields::field;
  return std::make_tuple(field("samples", &ForceAverage::samples_),
                         field("sums", &ForceAverage::sums_));
}

/// The sites of each contact.
std::vector<double> strengths(const std::vector<Contact>& contacts);
std::vector<double> strengths(const std::vector<ForceAverage::Mean>& means);

}  // namespace clca::measure
