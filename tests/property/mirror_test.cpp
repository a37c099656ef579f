// The mirror image of a bed has the mirror image of its tables: no end of a base, no edge of a cell
// and no half of a bed counts other than that on the other side. Beds of all models, in boxes with
// an odd number of columns: the mirror image of another box is none of this lattice.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "clca/measure/convection.hpp"
#include "clca/measure/displacement.hpp"
#include "clca/measure/field_grid.hpp"
#include "clca/measure/line.hpp"
#include "clca/measure/mixing.hpp"
#include "clca/measure/profile.hpp"
#include "clca/measure/weight_paths.hpp"
#include "clca/run/simulation.hpp"
#include "clca/scene/parse.hpp"
#include "property/random_motions.hpp"

namespace clca::mirror_test {
namespace {

using grains::State;
using lattice::Axial;
using lattice::Site;
using testing::within;

/// Grains are hexagons, which have themselves as image.
State mirrored(State state) {
  const int last = state.lattice.columns() - 1;
  const auto mirror = [last](Site site) { return Site{last - site.column, site.row}; };
  for (grains::Particle& grain : state.particles) {
    grain.column = last - grain.column;
  }
  std::transform(state.origins.begin(), state.origins.end(), state.origins.begin(), mirror);
  for (grains::Wall& wall : state.walls) {
    std::transform(wall.sites.begin(), wall.sites.end(), wall.sites.begin(), mirror);
    std::sort(wall.sites.begin(), wall.sites.end());
  }
  return state;
}

/// A bed before and after some steps, and their mirror images.
struct Beds {
  State before;
  State after;
  State mirrored_before = mirrored(before);
  State mirrored_after = mirrored(after);

  const lattice::Lattice& box() const { return before.lattice; }
  double last() const { return lattice::kColumnPitch * (box().columns() - 1); }
};

Beds any_beds() {
  const std::string model =
      *rc::gen::element<std::string>("automaton", "contact", "voids", "baxter");
  const bool one_site = model == "voids" || model == "baxter";
  const int columns = 2 * within(3, 12) + 1;
  const double width = columns * lattice::kColumnPitch - 0.01;
  const int height = within(14, 30);
  std::string text = fmt::format(
      "clca: 1\nmodel: {}\nseed: {}\nbox: {{width: {}, height: {}}}\n"
      "species: {{a: {{shape: {{hexagon: 0}}}}, b: {{shape: {{hexagon: {}}}}}}}\nmeasure: []\n",
      model, within(1, 1000), width, height, one_site ? 0 : 1);
  if (*rc::gen::arbitrary<bool>()) {
    text += fmt::format("walls: {{slope: {{line: {{from: [0, {}], to: [{}, 1]}}}}}}\n",
                        within(1, 5), width / 2);
  }
  text += fmt::format(
      "stages: [{{name: s, fill: {{region: [0, 0, {}, {}], mix: {{a: {}, b: 1}}, method: {}}}, "
      "until: {{steps: 100}}}}]\n",
      width, within(10, height), within(1, 4),
      *rc::gen::element<std::string>("deposition", "random"));
  RC_LOG() << text;
  run::Simulation simulation(scene::parse(text, "scene.yaml"));
  for (int step = within(0, 10); step > 0 && !simulation.is_over(); --step) {
    simulation.step();
  }
  const State before = simulation.state();
  for (int step = within(1, 10); step > 0 && !simulation.is_over(); --step) {
    simulation.step();
  }
  RC_PRE(grains::present_count(before) > 0 && simulation.state().step > before.step);
  RC_ASSERT(simulation.state().lattice.columns() == columns);
  return {before, simulation.state()};
}

bool is_near(double one, double other) {
  return one == other || std::abs(one - other) <= 1e-9 * (1 + std::abs(one)) ||
         (std::isnan(one) && std::isnan(other));
}

bool is_near(const std::optional<double>& one, const std::optional<double>& other) {
  return one.has_value() == other.has_value() && (!one || is_near(*one, *other));
}

/// Of a number for each column or part.
bool are_mirrored(const std::vector<double>& one, const std::vector<double>& other) {
  return std::equal(one.begin(), one.end(), other.rbegin(), other.rend(),
                    [](double a, double b) { return is_near(a, b); });
}

/// Calls check(cell, image) for the cells of a grid, row by row.
template <class Cell, class Check>
void for_each_image(const std::vector<Cell>& cells, const std::vector<Cell>& images,
                    std::size_t columns, const Check& check) {
  RC_ASSERT(cells.size() == images.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    check(cells[i], images[i / columns * columns + columns - 1 - i % columns]);
  }
}

double any_cell() {
  return *rc::gen::element(0.9, 2.0, 3.0, 4.33, 5.0, 8.0);
}

RC_GTEST_PROP(MirrorProperty, OfTheBase, ()) {
  const Beds beds = any_beds();
  const auto pressure = [](const State& state, measure::WeightRule rule) {
    const auto grains = measure::supported_grains(state, grains::Occupancy(state));
    return measure::base_pressures(measure::bed_base(state),
                                   measure::weight_paths(state, grains, rule).forces);
  };
  for (const auto rule : {measure::WeightRule::inner, measure::WeightRule::outer}) {
    RC_ASSERT(are_mirrored(pressure(beds.after, rule), pressure(beds.mirrored_after, rule)));
  }
}

RC_GTEST_PROP(MirrorProperty, OfProfilesAndFronts, ()) {
  const Beds beds = any_beds();
  const std::vector<double> profile = measure::surface_profile(beds.after);
  const std::vector<double> image = measure::surface_profile(beds.mirrored_after);
  RC_ASSERT(are_mirrored(profile, image));
  RC_ASSERT(is_near(measure::repose_angle(profile).left.degrees,
                    measure::repose_angle(image).right.degrees));
  RC_ASSERT(is_near(measure::repose_angle(profile).right.degrees,
                    measure::repose_angle(image).left.degrees));
  RC_ASSERT(is_near(measure::packing_fraction(beds.after),
                    measure::packing_fraction(beds.mirrored_after)));
  RC_ASSERT(
      is_near(measure::runout(beds.after)->front, measure::runout(beds.mirrored_after)->front));
  RC_ASSERT(is_near(measure::runout(beds.after)->percentile_99,
                    measure::runout(beds.mirrored_after)->percentile_99));
}

RC_GTEST_PROP(MirrorProperty, OfFields, ()) {
  const Beds beds = any_beds();
  const double cell = any_cell();
  const auto fields = measure::field_cells(measure::Snapshot(beds.before), beds.after, cell);
  const auto image =
      measure::field_cells(measure::Snapshot(beds.mirrored_before), beds.mirrored_after, cell);
  const std::size_t columns = measure::Grid(beds.after.lattice, cell).columns();
  for_each_image(fields, image, columns, [](const auto& one, const auto& other) {
    RC_ASSERT(is_near(one.packing_fraction, other.packing_fraction));
    RC_ASSERT(is_near(one.particles, other.particles));
    RC_ASSERT(is_near(one.velocity.x(), -other.velocity.x()));
    RC_ASSERT(is_near(one.velocity.y(), other.velocity.y()));
    RC_ASSERT(is_near(one.fluctuation, other.fluctuation));
  });
  RC_ASSERT(is_near(measure::lacey_index(beds.after, cell),
                    measure::lacey_index(beds.mirrored_after, cell)));
}

RC_GTEST_PROP(MirrorProperty, OfStress, ()) {
  const Beds beds = any_beds();
  const double cell = any_cell();
  const auto stress = [&](const State& state) {
    const auto grains = measure::supported_grains(state, grains::Occupancy(state));
    const auto paths = measure::weight_paths(state, grains, measure::WeightRule::outer);
    return measure::stress_field(state, paths.forces, cell);
  };
  for_each_image(stress(beds.after), stress(beds.mirrored_after),
                 measure::Grid(beds.box(), cell).columns(), [](const auto& one, const auto& other) {
                   RC_ASSERT(is_near(one.xx, other.xx));
                   RC_ASSERT(is_near(one.xy, -other.xy));
                   RC_ASSERT(is_near(one.yy, other.yy));
                 });
}

RC_GTEST_PROP(MirrorProperty, OfConvection, ()) {
  const Beds beds = any_beds();
  const double cell = any_cell();
  const auto convection = [&](const State& before, const State& after) {
    measure::Convection result(before.lattice, cell);
    result.begin_cycle(before);
    result.end_cycle(after);
    return result;
  };
  const measure::Convection one = convection(beds.before, beds.after);
  const measure::Convection image = convection(beds.mirrored_before, beds.mirrored_after);
  const measure::Grid grid(beds.box(), cell);
  const auto cells = [&](const measure::Convection& of) {
    std::vector<measure::ConvectionArrow> all(grid.size(), {{0, 0}, {0, 0}, 0});
    for (const measure::ConvectionArrow& arrow : of.arrows()) {
      all[grid.cell_at(arrow.centre)] = arrow;
    }
    return all;
  };
  for_each_image(cells(one), cells(image), grid.columns(), [](const auto& a, const auto& b) {
    RC_ASSERT(is_near(a.weight, b.weight));
    RC_ASSERT(is_near(a.displacement.x(), -b.displacement.x()));
    RC_ASSERT(is_near(a.displacement.y(), b.displacement.y()));
  });
  RC_ASSERT(one.rolls().has_value() == image.rolls().has_value());
  if (one.rolls()) {
    RC_ASSERT(is_near(one.rolls()->centre_minus_wall, image.rolls()->centre_minus_wall));
    RC_ASSERT(is_near(one.rolls()->rotation_left, -image.rolls()->rotation_right));
    RC_ASSERT(is_near(one.rolls()->rotation_right, -image.rolls()->rotation_left));
  }
}

// From beyond the outermost centres: the end of a line does not belong to it.
RC_GTEST_PROP(MirrorProperty, OfWhatPassesALevelLine, ()) {
  const Beds beds = any_beds();
  const auto parts = within<std::size_t>(1, 20);
  const double height = within(0, 8) / 2.0;
  const auto passed = [&](const State& before, const State& after) {
    const double beyond = lattice::kColumnPitch / 2;
    const measure::Line line(after, {-beyond, height}, {beds.last() + beyond, height}, parts);
    measure::LineSums sums(parts);
    const measure::Snapshot snapshot(before);
    line.observe(snapshot, after, grains::Occupancy(after), snapshot.velocities(after), sums);
    std::vector<double> flux;
    std::vector<double> particles;
    for (const measure::LinePart& part : line.part_means(sums)) {
      flux.push_back(part.flux.mean);
      particles.push_back(part.passed_particles);
    }
    return std::pair(flux, particles);
  };
  const auto one = passed(beds.before, beds.after);
  const auto image = passed(beds.mirrored_before, beds.mirrored_after);
  RC_ASSERT(are_mirrored(one.first, image.first));
  RC_ASSERT(are_mirrored(one.second, image.second));
}

}  // namespace
}  // namespace clca::mirror_test
