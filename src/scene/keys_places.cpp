// Sources, outlets, probes and lines.

#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr double kMinLineLength = 1;  // lattice spacings

void check_region(const lattice::Rectangle& region, const PlacedValue& place) {
  const Box& box = place.scene.box;
  if (region.left < 0 || region.bottom < 0 || region.right > box.width || region.top > box.height) {
    fail(place, "expected a region in the box, {} wide and {} high, found {}", box.width,
         box.height, shown(region));
  }
}

void check_line_end(const Eigen::Vector2d& end, const PlacedValue& place) {
  const Box& box = place.scene.box;
  // From one side of a periodic box to where it repeats.
  const double width = box.periodic ? lattice_of(box).extent().x() : box.width;
  if (end.x() < 0 || end.y() < 0 || end.x() > width || end.y() > box.height) {
    fail(place, "expected a point in the box, {:.6g} wide and {} high, found [{}, {}]", width,
         box.height, end.x(), end.y());
  }
}

void check_line(const PlacedValue& fields, Line& line) {
  check_line_end(line.from, fields.at("from"));
  check_line_end(line.to, fields.at("to"));
  const double length = (line.to - line.from).norm();
  if (length < kMinLineLength) {
    fail(fields.at("to"),
         "expected a point at least {} lattice spacing away from [{}, {}], found [{}, {}]",
         kMinLineLength, line.from.x(), line.from.y(), line.to.x(), line.to.y());
  }
}

void check_source(const PlacedValue& fields, Source& source) {
  source.location = location_text(fields);
  if (const auto* at = std::get_if<Eigen::Vector2d>(&source.position)) {
    const Box& box = fields.scene.box;
    if (!lattice_of(box).contains(lattice::nearest_site(*at))) {
      fail(fields.at("at"), "expected a point in the box, {} wide and {} high, found [{}, {}]",
           box.width, box.height, at->x(), at->y());
    }
  } else {
    check_region(std::get<lattice::Rectangle>(source.position), fields.at("region"));
  }
  if (source.species_weights.empty()) {
    source.species_weights.assign(fields.scene.species.size(), 1);
  }
}

}  // namespace

Type<std::vector<Source>> sources_type() {
  return by_name<Source>(
      "sources", {.keys = {alternative_key("at", &Source::position, point_type(),
                                           "emits at the site nearest to this point")
                               .with_condition("this or `region`"),
                           alternative_key("region", &Source::position, region_type(),
                                           "emits at any site of this region of the box")
                               .with_condition("this or `at`"),
                           key("species", &Source::species_weights, weights_type(),
                               "weights of what is emitted")
                               .defaults_to("all alike"),
                           required_key("rate", &Source::particles_per_step,
                                        number_type(1e-6, 1000), "particles per step"),
                           key("count", &Source::max_particles, count_type(1, kMaxParticles),
                               "closes for good after so many")
                               .defaults_to("no end")},
                  .one_of = {"at", "region"},
                  .check = check_source});
}

Type<std::vector<Outlet>> outlets_type() {
  return by_name<Outlet>(
      "outlets", {.keys = {required_key("region", &Outlet::region, region_type(),
                                        "where particles are removed that lie wholly inside")},
                  .check = [](const PlacedValue& fields, Outlet& outlet) {
                    outlet.location = location_text(fields.at("region"));
                  }});
}

Type<std::vector<Probe>> probes_type() {
  const Type<lattice::Rectangle> edges = region_type().checked(check_region);
  auto type = by_name("probes", member_type(&Probe::region, edges));
  type.allowed = edges.allowed + " by name";
  return type;
}

Type<std::vector<Line>> lines_type() {
  return by_name<Line>(
      "lines",
      {.keys = {required_key("from", &Line::from, point_type(), "start of the line, in the box"),
                required_key(
                    "to", &Line::to, point_type(),
                    "its end; what passes to the right of this direction counts as positive"),
                key("parts", &Line::part_count, integer_type(1, 1000),
                    "of equal length, each with a row in the table")},
       .check = check_line});
}

}  // namespace clca::scene
