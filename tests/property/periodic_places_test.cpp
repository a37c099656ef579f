// Random scenes in periodic boxes, by both models: every place that a run writes lies in the box.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <filesystem>

#include "clca/store/table.hpp"
#include "drawing/internal/frame_painter.hpp"
#include "model/internal/scene_model.hpp"
#include "property/random_motions.hpp"
#include "run/stage.hpp"
#include "store/trajectory_part.hpp"
#include "support/runs.hpp"

namespace clca::periodic_places_test {
namespace {

namespace fs = std::filesystem;

/// A bed that slides over a slope without end, many widths of its box.
std::string any_contact_scene() {
  return fmt::format(
      "model: contact\nbox: {{width: {}, height: 40, periodic: true}}\n"
      "contact: {{rolling: {}, wall_friction: 0.02}}\n"
      "walls: {{left: {{box: [0, 0, 9, 2]}}}}\n"
      "stages:\n  - {{name: slide, fill: {{region: [0, 2, 60, 40], counts: {{s: {}, l: {}}}}},\n"
      "     vessel: {{tilt: {}}}, until: {{steps: {}}}}}\n",
      testing::within(12, 50), *rc::gen::element("none", "free", "resistance"),
      testing::within(1, 12), testing::within(1, 8), *rc::gen::element(-60, 60, -85, 85),
      testing::within(300, 700));
}

/// A bed that falls aside without end, then a plate that goes into it with gravity downwards.
std::string any_automaton_scene() {
  const int width = testing::within(14, 50);
  const bool right = *rc::gen::arbitrary<bool>();
  const std::string across = right ? "right" : "left";
  return fmt::format(
      "box: {{width: {}, height: 40, periodic: true}}\n"
      "rules: {{gravity: down_{}, scatter: 0.5}}\n"
      "walls: {{plate: {{box: [3, 30, 9, 32], passive: overlap,\n"
      "  motion: {{direction: down_{}, period: 2, distance: 40}}}}}}\n"
      "stages:\n  - {{name: slide, fill: {{region: [0, 0, 60, 28], counts: {{s: {}, l: {}}}}},\n"
      "     until: {{steps: {}}}}}\n"
      "  - {{name: push, insert: [plate], move: [plate], until: {{steps: {}}}}}\n",
      width, across, across, testing::within(1, 40), testing::within(1, 10),
      testing::within(60, 200), testing::within(20, 90));
}

std::string any_scene(bool contact) {
  return fmt::format(
      "clca: 1\nseed: {}\nspecies: {{s: {{shape: {{hexagon: 1}}}}, l: {{shape: {{hexagon: 2}}}}}}\n"
      "lines: {{across: {{from: [0, 5], to: [10, 5], parts: 3}}}}\n{}"
      "output: {{series: {{every: 10}}, fields: {{every: 50, cell: {}}},\n"
      "  trajectory: {{every: 40{}}}}}\n",
      testing::within(0, 1000), contact ? any_contact_scene() : any_automaton_scene(),
      *rc::gen::element(1, 4, 8), contact ? ", contacts: true" : "");
}

class Places {
 public:
  explicit Places(const lattice::Lattice& lattice)
      : low_(lattice::Lattice::lower_left_corner()), high_(low_ + lattice.extent()) {}

  void require(double x, double y, const std::string& where) {
    if (!(x >= low_.x() && x <= high_.x() && y >= low_.y() && y <= high_.y())) {
      RC_FAIL(fmt::format("{}: [{}, {}]", where, x, y));
    }
    ++count_;
  }
  std::size_t count() const { return count_; }

 private:
  Eigen::Vector2d low_;
  Eigen::Vector2d high_;
  std::size_t count_ = 0;
};

void look_at_tables(const fs::path& folder, Places& places) {
  for (const fs::directory_entry& file : fs::directory_iterator(folder)) {
    if (file.path().extension() != ".csv") {
      continue;
    }
    const store::ParsedTable table = store::read_table(file.path());
    if (table.find_column("x") == nullptr) {
      continue;
    }
    const std::vector<double> x = table.column_numbers("x");
    const std::vector<double> y = table.find_column("y") != nullptr
                                      ? table.column_numbers("y")
                                      : std::vector<double>(x.size(), 0.0);
    for (std::size_t row = 0; row < x.size(); ++row) {
      if (!std::isnan(x[row])) {  // a contact that is gone
        places.require(x[row], y[row], file.path().filename());
      }
    }
  }
}

void look_at_parts(const fs::path& folder, bool contact, Places& places) {
  for (const fs::directory_entry& file : fs::directory_iterator(folder / "trajectory")) {
    std::vector<double> particles;
    std::vector<double> contacts;
    std::vector<store::Hdf5Dataset> datasets = {{"particles/position", &particles, 2}};
    if (contact) {
      datasets.push_back({"contacts/place", &contacts, 2});
    }
    store::read_hdf5(file.path(), store::kTrajectoryKind, datasets, 1e9);
    for (const auto* all : {&particles, &contacts}) {
      for (std::size_t at = 0; at < all->size(); at += 2) {
        places.require((*all)[at], (*all)[at + 1], all == &contacts ? "contacts" : "particles");
      }
    }
  }
}

/// The lines of forces in pictures.
void look_at_pictures(const store::Trajectory& trajectory, bool contact, Places& places) {
  drawing::OverlayScales scales;
  scales.strongest_force = 1;
  for (std::size_t frame = 0; frame < trajectory.frames().size(); ++frame) {
    const grains::State state = trajectory.state(frame);
    drawing::PictureContent content = {.state = state, .occupancy = grains::Occupancy(state)};
    if (contact) {
      content.contact = trajectory.contact_frame(frame);
    }
    const render::Overlay overlay =
        drawing::overlay_of(scene::Overlay::forces, content, {}, scales);
    for (const render::Stroke& stroke : overlay.strokes) {
      places.require(stroke.from.x(), stroke.from.y(), "the beginning of a line");
      places.require(stroke.to.x(), stroke.to.y(), "the end of a line");
      // Not across the picture.
      RC_ASSERT(std::abs(stroke.to.x() - stroke.from.x()) < state.lattice.extent().x() / 2 + 1e-9);
    }
  }
}

void look_at_a_run(bool contact) {
  const scene::Scene scene = scene::parse(any_scene(contact), "any.yaml");
  const testing::ScratchFolder folder;
  const fs::path run = folder.path() / "run";
  try {
    run::run(scene, {.folder = run});
  } catch (const scene::SceneError&) {
    RC_DISCARD("the fill does not fit");
  }
  const grains::State fixed = model::grains_of(run::state_at_start(scene));
  Places places(fixed.lattice);
  look_at_tables(run, places);
  look_at_parts(run, contact, places);
  const store::Trajectory trajectory(run, scene, fixed, 1e9);
  look_at_pictures(trajectory, contact, places);
  RC_ASSERT(places.count() > 0);
  const grains::State last = trajectory.state(trajectory.frames().size() - 1);
  const bool has_gone_round =
      std::any_of(last.particles.begin(), last.particles.end(), [&](const auto& one) {
        return one.present && one.column != fixed.lattice.wrapped(one.column);
      });
  RC_CLASSIFY(has_gone_round, "has gone round");
}

RC_GTEST_PROP(APeriodicBox, HoldsEveryPlaceThatTheAutomatonWrites, ()) {
  look_at_a_run(false);
}

RC_GTEST_PROP(APeriodicBox, HoldsEveryPlaceThatTheContactModelWrites, ()) {
  look_at_a_run(true);
}

}  // namespace
}  // namespace clca::periodic_places_test
