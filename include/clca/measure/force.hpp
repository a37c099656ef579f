#pragma once
// Overlaps left by pushes, their distribution, and effects of the walls that push. The number of
// shared sites is the index of force (Sakaguchi et al. 2001, after Murakami).

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::measure {

/// A particle that shares sites with another particle or a wall.
struct OverlapContact {
  std::uint32_t first = 0;
  grains::Owner second = 0;  ///< a particle with a greater id, or the code of a wall
  int shared_sites = 0;      ///< shared
  /// 1 if one of the six moves of the first separates the two, else 2.
  int depth = 0;
  /// Centroid of the shared sites, in the box, in lattice spacings.
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  std::optional<std::uint32_t> source_wall = {};  ///< wall from which the grain was pushed
};

/// All pairs that share sites, sorted by `first`, then `second` (walls before particles).
/// Throws std::invalid_argument if `occupancy` belongs to another box.
std::vector<OverlapContact> overlap_contacts(const grains::State& state,
                                             const grains::Occupancy& occupancy);

/// Index of force of each particle by id: the shared sites of all its contacts.
/// Throws std::invalid_argument if a contact has an unknown particle.
std::vector<double> force_indices(std::size_t particle_count,
                                  const std::vector<OverlapContact>& contacts);

/// A moving wall and the overlaps that began at it.
struct WallOverlap {
  std::size_t wall = 0;
  std::int32_t travel = 0;  ///< sites from the initial position along the direction of the motion
  std::optional<std::uint64_t> stalled_since = {};  ///< step
  std::uint64_t stalls = 0;
  std::size_t overlapping_particles = 0;  ///< those that share sites with the wall
  std::uint64_t shared_sites = 0;         ///< of the wall and particles
  std::uint64_t chain_sites = 0;          ///< shared sites of all contacts that began at the wall
  std::size_t jammed_particles = 0;       ///< pushed from this wall, and at rest
};

struct ForceSummary {
  int max_depth = 0;                 ///< unit moves
  std::uint64_t shared_sites = 0;    ///< shared, over all contacts
  std::size_t contact_count = 0;     ///< pairs
  std::size_t jammed_particles = 0;  ///< pushed onto others, and at rest
  /// Share of the sites shared between particles that lie in a cone of 45 degrees ahead of the wall
  /// where their push began; none if particles share no sites.
  /// "Ahead" is the direction of the push. At distance a from the foremost site of the wall the
  /// cone extends a beyond the wall on either side; up to one spacing behind that site it is as
  /// wide as the wall, as a straight wall is not flat on the lattice.
  std::optional<double> cone_share = {};
  std::vector<WallOverlap> walls = {};  ///< all walls with a motion, present or not, in order
};

/// `occupancy` and `contacts` belong to this state; throws std::invalid_argument if they cannot.
ForceSummary force_summary(const grains::State& state, const grains::Occupancy& occupancy,
                           const std::vector<OverlapContact>& contacts);

/// Depth of the foremost point of a vertically moving wall below the initial bed surface, lattice
/// spacings: below the mean of surface_profile over the columns with particles that the wall
/// covers.
/// Negative above it; none if the wall is removed, moves sideways or covers no bed. Throws
/// std::invalid_argument unless the surface has one height per column.
std::optional<double> penetration_depth(const grains::State& now, const grains::Wall& wall,
                                        const std::vector<double>& surface_at_start);

/// Whole sites at one moment, real numbers as averages.
enum class StrengthKind : std::uint8_t { whole_sites, averaged };

struct ForceBin {
  double low = 0;  ///< sites
  double high = 0;
  std::size_t count = 0;
  double density = 0;  ///< probability density of f/<f>
};

struct ForceDistribution {
  double mean = 0;                ///< <f>, sites
  double share_above_mean = 0;    ///< of the contacts
  std::size_t tail_contacts = 0;  ///< contacts above the mean
  /// Decay of the tail, P(f/<f>) ~ exp(-beta f/<f>) for f > <f>, by maximum likelihood. None for
  /// fewer than two contacts in the tail or if all are equal.
  std::optional<double> beta = {};
  /// Whole sites: a bin from n - 1/2 to n + 1/2 for each n. Averages: of a quarter of the mean.
  std::vector<ForceBin> bins = {};
};

/// None if the list is empty. Throws std::invalid_argument unless all are positive, whole sites
/// below 10^6, averages below 10^15.
std::optional<ForceDistribution> force_distribution(const std::vector<double>& strengths,
                                                    StrengthKind kind);

/// Averages the strength of each contact over samples; a contact absent from a sample counts as 0.
class ForceAverage {
 public:
  struct Mean {
    std::uint32_t first = 0;
    grains::Owner second = 0;
    double shared_sites = 0;   ///< mean over all samples
    double present_share = 0;  ///< share of the samples that have the contact

    bool operator==(const Mean&) const = default;
  };

  /// Adds one sample.
  void add(const std::vector<OverlapContact>& contacts);

  std::uint64_t sample_count() const { return samples_; }
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
    sites.push_back(contact.shared_sites);
  }
  return sites;
}

}  // namespace clca::measure
