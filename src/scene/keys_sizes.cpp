// Distributions of sizes.

#include <cmath>

#include "clca/lattice/shape.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr auto kLawNames = in_order<SizeLaw>("uniform", "lognormal", "list");
constexpr auto kSharesByNames = in_order<SharesBy>("number", "area");
constexpr auto kRoundShapeNames = in_order<RoundShape>("hexagon", "disc");

Type<std::vector<double>> list(const Type<double>& number) {
  auto type = list_of(number, 1, kMaxKinds);
  type.allowed = "list of numbers " + number.allowed;
  return type;
}

void check(const KeyedMap& fields, Sizes& sizes) {
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
  const Place sd = fields.at("sd");
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

Type<Sizes> sizes_type() {
  const Type<double> diameter = length(above_zero(kMaxDiameter));
  return type_of<Sizes>(
      {.keys = {required("law", &Sizes::law, choice(kLawNames), "how diameters are distributed"),
                key("mean", &Sizes::mean, diameter,
                    "mean diameter, in spacings: that of the circle of the same area")
                    .with_condition("required but for a list"),
                key("sd", &Sizes::sd, diameter, "standard deviation of the diameter")
                    .with_condition("required but for a list"),
                key("by", &Sizes::by, choice(kSharesByNames),
                    "whether the law is that of the number of particles or of the area they cover"),
                key("kinds", &Sizes::kinds, count(1, kMaxKinds),
                    "classes of equal width that the law is divided into, at most"),
                key("diameters", &Sizes::diameters, list(diameter), "of a list")
                    .with_condition("required for a list"),
                key("shares", &Sizes::shares, list(above_zero(1e9)),
                    "of a list: one for each diameter, of any sum")
                    .with_condition("required for a list"),
                key("shape", &Sizes::shape, choice(kRoundShapeNames),
                    "hexagons, or discs: of more sizes, but notched")},
       .check = check});
}

}  // namespace clca::scene
