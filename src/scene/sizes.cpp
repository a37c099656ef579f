// Distributions of sizes: the kinds of particles of a law, and its keys.

#include "scene/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clca/lattice/lattice.hpp"
#include "clca/lattice/shape.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr double kMaxDiameter = 100;  // of a distribution of sizes
constexpr std::size_t kMaxKinds = 64;

constexpr double kCutQuantile = 2.5758293035489004;  // of the normal law, at half a percent
// Shares are ratios of whole numbers of it: functions of machines differ in the last bits.
constexpr double kShareUnit = 1e-9;

struct Diameter {
  double value = 0;  ///< lattice spacings
  double share = 0;  ///< of the law, by number or by area
};

double normal_below(double quantile) {
  return std::erfc(-quantile / std::sqrt(2.0)) / 2;
}

/// Mean diameters of equal classes from `low` to `high`; the outermost take what is beyond.
/// `below`: share of the law below a diameter; `moment_below`: that share times its mean.
template <class Below, class MomentBelow>
std::vector<Diameter> classes(double low, double high, std::uint64_t count, Below below,
                              MomentBelow moment_below) {
  std::vector<Diameter> result;
  const double width = (high - low) / static_cast<double>(count);
  double start = 0;
  for (std::uint64_t i = 1; i <= count; ++i) {
    const double end =
        i < count ? low + width * static_cast<double>(i) : std::numeric_limits<double>::infinity();
    const double share = below(end) - below(start);
    result.push_back({(moment_below(end) - moment_below(start)) / share, share});
    start = end;
  }
  return result;
}

std::vector<Diameter> diameters_of(const SizeDistribution& sizes) {
  std::vector<Diameter> result;
  if (sizes.law == SizeLaw::list) {
    for (std::size_t i = 0; i < sizes.diameters.size(); ++i) {
      result.push_back({sizes.diameters[i], sizes.shares[i]});
    }
    return result;
  }
  const double mean = *sizes.mean;
  const double sd = *sizes.sd;
  if (sizes.law == SizeLaw::uniform) {
    const double low = mean - sd * std::sqrt(3.0);
    const double high = mean + sd * std::sqrt(3.0);
    return classes(
        low, high, sizes.class_count,
        [=](double diameter) { return std::clamp(diameter, low, high); },
        [=](double diameter) {
          const double inside = std::clamp(diameter, low, high);
          return inside * inside / 2;
        });
  }
  // Of the logarithm.
  const double spread = std::sqrt(std::log1p(sd * sd / (mean * mean)));
  const double middle = std::log(mean) - spread * spread / 2;
  const auto quantile = [=](double diameter) { return (std::log(diameter) - middle) / spread; };
  return classes(
      std::exp(middle - kCutQuantile * spread), std::exp(middle + kCutQuantile * spread),
      sizes.class_count, [=](double diameter) { return normal_below(quantile(diameter)); },
      [=](double diameter) { return mean * normal_below(quantile(diameter) - spread); });
}

/// Of the classes of the law.
double largest_diameter(const SizeDistribution& sizes) {
  double largest = 0;
  for (const Diameter& diameter : diameters_of(sizes)) {
    largest = std::max(largest, diameter.value);
  }
  return largest;
}

/// With the weight in a law by area, and no share yet.
SizeClass round_kind(double radius, double sites) {
  return {.radius = radius,
          .weight_in_law = sites,
          .diameter = std::sqrt(4 * lattice::kColumnPitch * sites / std::numbers::pi)};
}

/// Hexagons by size: two at least, up to the first with a diameter of `largest` or more.
std::vector<SizeClass> hexagons(double largest) {
  std::vector<SizeClass> kinds;
  for (int radius = 0; radius < 2 || kinds.back().diameter < largest; ++radius) {
    kinds.push_back(round_kind(radius, 3.0 * radius * (radius + 1) + 1));
  }
  return kinds;
}

/// Discs, likewise. Squares of distances between sites are whole numbers.
std::vector<SizeClass> discs(double largest) {
  const int reach = static_cast<int>(largest) + 2;  // more than the radius
  std::vector<int> sites(static_cast<std::size_t>(reach) * static_cast<std::size_t>(reach), 0);
  for (int x = -2 * reach; x <= 2 * reach; ++x) {
    for (int q = -2 * reach; q <= 2 * reach; ++q) {
      const int square = x * x + x * q + q * q;
      if (const auto at = static_cast<std::size_t>(square); at < sites.size()) {
        ++sites[at];
      }
    }
  }
  std::vector<SizeClass> kinds;
  double inside = 0;
  for (std::size_t square = 0; square < 2 || kinds.back().diameter < largest; ++square) {
    if (sites[square] > 0) {
      inside += sites[square];
      // Two digits keep them apart.
      kinds.push_back(
          round_kind(std::ceil(std::sqrt(static_cast<double>(square)) * 100) / 100, inside));
    }
  }
  return kinds;
}

constexpr auto kLawNames = in_order<SizeLaw::list>("uniform", "lognormal", "list");
constexpr auto kSharesByNames = in_order<SharesBy::area>("number", "area");
constexpr auto kRoundShapeNames = in_order<RoundShape::disc>("hexagon", "disc");

Type<std::vector<double>> list(const Type<double>& number) {
  auto type = list_type(number, 1, kMaxKinds);
  type.allowed = "list of numbers " + number.allowed;
  return type;
}

void check(const PlacedValue& fields, SizeDistribution& sizes) {
  const bool list = sizes.law == SizeLaw::list;
  for (const char* key : {"mean", "sd", "kinds", "diameters", "shares"}) {
    const bool of_list = key == std::string_view("diameters") || key == std::string_view("shares");
    if (fields.find(key) != nullptr && list != of_list) {
      fail(fields.at(key), "goes with 'law: {}'", of_list ? "list" : "uniform' or 'law: lognormal");
    }
  }
  if (list) {
    fields.at("diameters");
    if (sizes.diameters.size() != fields.at("shares").value.items.size()) {
      fail(fields.at("shares"), "expected a share for each of the {} diameters, found {}",
           sizes.diameters.size(), sizes.shares.size());
    }
    return;
  }
  const double smallest = lattice::Shape::hexagon(0).diameter();
  if (*sizes.mean < smallest) {
    fail(fields.at("mean"), "expected at least {:.3g}, the diameter of a single site, found {}",
         smallest, *sizes.mean);
  }
  const PlacedValue sd = fields.at("sd");
  if (sizes.law == SizeLaw::uniform && *sizes.mean <= *sizes.sd * std::sqrt(3.0)) {
    fail(sd, "expected less than {:.4g}, so that all diameters are above 0, found {}",
         *sizes.mean / std::sqrt(3.0), *sizes.sd);
  }
  if (const double largest = largest_diameter(sizes); largest > kMaxDiameter) {
    fail(sd, "expected less, so that all diameters are up to {}; the largest would be {:.4g}",
         kMaxDiameter, largest);
  }
}

}  // namespace

std::vector<SizeClass> size_classes(const SizeDistribution& sizes) {
  const double largest = largest_diameter(sizes);
  std::vector<SizeClass> kinds =
      sizes.shape == RoundShape::disc ? discs(largest) : hexagons(largest);
  for (const Diameter& diameter : diameters_of(sizes)) {
    // The two kinds around it, and the share of the upper one with which their mean diameter is
    // this one: by number or by area, as that of the law.
    std::size_t above = 1;
    while (above + 1 < kinds.size() && kinds[above].diameter < diameter.value) {
      ++above;
    }
    const double low = kinds[above - 1].diameter;
    const double share =
        std::clamp((diameter.value - low) / (kinds[above].diameter - low), 0.0, 1.0);
    const double upper = sizes.law == SizeLaw::list ? std::round(share) : share;
    kinds[above - 1].share += (1 - upper) * diameter.share;
    kinds[above].share += upper * diameter.share;
  }
  std::erase_if(kinds, [](const SizeClass& kind) { return kind.share <= 0; });
  double all = 0;
  for (SizeClass& kind : kinds) {
    if (sizes.shares_by == SharesBy::number) {
      kind.weight_in_law = 1;
    }
    kind.share /= kind.weight_in_law;
    all += kind.share;
  }
  double units = 0;
  for (SizeClass& kind : kinds) {
    kind.share = std::max(1.0, std::round(kind.share / all / kShareUnit));
    units += kind.share;
  }
  for (SizeClass& kind : kinds) {
    kind.share /= units;
  }
  return kinds;
}

Type<SizeDistribution> sizes_type() {
  const Type<double> diameter = length_type(positive_type(kMaxDiameter));
  return type_of<SizeDistribution>(
      {.keys = {required_key("law", &SizeDistribution::law, choice_type(kLawNames),
                             "how diameters are distributed"),
                key("mean", &SizeDistribution::mean, diameter,
                    "mean diameter, in spacings: that of the circle of the same area")
                    .with_condition("required but for a list"),
                key("sd", &SizeDistribution::sd, diameter, "standard deviation of the diameter")
                    .with_condition("required but for a list"),
                key("by", &SizeDistribution::shares_by, choice_type(kSharesByNames),
                    "whether the law is that of the number of particles or of the area they cover"),
                key("kinds", &SizeDistribution::class_count, count_type(1, kMaxKinds),
                    "classes of equal width that the law is divided into, at most"),
                key("diameters", &SizeDistribution::diameters, list(diameter), "of a list")
                    .with_condition("required for a list"),
                key("shares", &SizeDistribution::shares, list(positive_type(1e9)),
                    "of a list: one for each diameter, of any sum")
                    .with_condition("required for a list"),
                key("shape", &SizeDistribution::shape, choice_type(kRoundShapeNames),
                    "hexagons, or discs: of more sizes, but notched")},
       .check = check});
}

}  // namespace clca::scene
