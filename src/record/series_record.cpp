#include "record/series_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clca/scene/units.hpp"

namespace clca::record {

namespace {

Eigen::Vector2d centroid(const std::vector<lattice::Site>& sites) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const lattice::Site site : sites) {
    sum += lattice::position(site);
  }
  return sites.empty() ? sum : Eigen::Vector2d(sum / static_cast<double>(sites.size()));
}

Eigen::Vector2d middle(const lattice::Lattice& box) {
  return lattice::Lattice::corner() + box.size() / 2;
}

/// Of a side of the box.
Eigen::Vector2d middle(const lattice::Lattice& box, grains::Owner side) {
  const Eigen::Vector2d half = box.size() / 2;
  switch (side) {
    case contact::kFloor:
      return middle(box) - Eigen::Vector2d(0, half.y());
    case contact::kCeiling:
      return middle(box) + Eigen::Vector2d(0, half.y());
    case contact::kLeftSide:
      return middle(box) - Eigen::Vector2d(half.x(), 0);
    default:
      return middle(box) + Eigen::Vector2d(half.x(), 0);
  }
}

/// From one point to another; in a periodic box to its nearest image.
Eigen::Vector2d lever(const lattice::Lattice& box, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to) {
  return box.in_box(to - from + middle(box)) - middle(box);
}

}  // namespace

bool has_flow_rates(const scene::Scene& scene) {
  return scene::has_density(scene) && !scene.outlets.empty();
}

SeriesRecord::SeriesRecord(const scene::Scene& scene)
    : series_(*scene.output.series), conversion_(scene::conversion(scene)) {
  if (series_.forces) {
    bodies_ = walls_and_sides(scene);
  }
}

void SeriesRecord::prepare(const StageView& now) {
  const grains::State& state = now.model.state();
  left_ = measure::discharge(state);  // its fill may be in outlets
  clear();
  centre_ = scene::turning_centre(now.scene, now.stage);
  centres_.clear();
  for (const grains::Owner body : bodies_) {
    centres_.push_back(contact::is_side(body)
                           ? middle(state.lattice, body)
                           : centroid(state.walls[grains::wall_number(body)].sites));
  }
}

void SeriesRecord::clear() {
  steps_ = 0;
  loads_.assign(bodies_.size(), {});
  before_ = left_;
}

void SeriesRecord::after_step(const StageView& now) {
  const grains::State& state = now.model.state();
  if ((state.step - 1) % series_.every == 0) {
    clear();  // the step before has a row
  }
  ++steps_;
  left_ = measure::discharge(state);
  if (series_.forces) {
    add_forces(state, now.model.wall_forces());
  }
}

void SeriesRecord::add_forces(const grains::State& state,
                              const std::vector<contact::Force>& forces) {
  const double mass = contact::mean_mass(state);
  for (const contact::Force& force : forces) {
    const auto found = std::ranges::find(bodies_, force.other);
    if (found == bodies_.end()) {
      continue;  // a grain
    }
    const auto body = static_cast<std::size_t>(found - bodies_.begin());
    const Eigen::Vector2d on_body = -mass * force.on_upper();
    const Eigen::Vector2d arm = lever(state.lattice, pivot(state, body), force.point);
    loads_[body].force_x += on_body.x();
    loads_[body].force_y += on_body.y();
    loads_[body].torque += arm.x() * on_body.y() - arm.y() * on_body.x();
  }
}

Eigen::Vector2d SeriesRecord::pivot(const grains::State& state, std::size_t body) const {
  if (centre_) {
    return *centre_;
  }
  const Eigen::Vector2d home = centres_[body];
  return contact::is_side(bodies_[body])
             ? home
             : home + lattice::position(state.walls[grains::wall_number(bodies_[body])].shift());
}

std::vector<std::string> SeriesRecord::force_names(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const grains::Owner body : walls_and_sides(scene)) {
    for (const char* key : {"force_x.", "force_y.", "torque."}) {
      names.push_back(key + body_name(scene, body));
    }
  }
  return names;
}

std::vector<store::Cell> SeriesRecord::force_cells() const {
  std::vector<store::Cell> cells;
  const auto add = [&](double sum, std::string_view unit) {
    cells.emplace_back(steps_ > 0 ? conversion_->in_si(sum / static_cast<double>(steps_), unit)
                                  : std::numeric_limits<double>::quiet_NaN());
  };
  for (const Load& load : loads_) {
    add(load.force_x, scene::kForceUnit);
    add(load.force_y, scene::kForceUnit);
    add(load.torque, scene::kMomentUnit);
  }
  return cells;
}

std::optional<double> SeriesRecord::mass_flow_rate() const {
  return steps_ > 0 ? std::optional(static_cast<double>(left_.sites - before_.sites) *
                                    conversion_->site->mass / conversion_->time(steps_))
                    : std::nullopt;
}

std::optional<double> SeriesRecord::particle_flow_rate() const {
  return steps_ > 0 ? std::optional(static_cast<double>(left_.particles - before_.particles) /
                                    conversion_->time(steps_))
                    : std::nullopt;
}

bool SeriesRecord::precedes(const grains::State& now) const {
  const auto up_to = [](const measure::Discharge& one, const measure::Discharge& later) {
    return one.particles <= later.particles && one.sites <= later.sites;
  };
  return loads_.size() == bodies_.size() && up_to(before_, left_) &&
         up_to(left_, measure::discharge(now)) && std::ranges::all_of(loads_, [](const Load& load) {
           return std::isfinite(load.force_x) && std::isfinite(load.force_y) &&
                  std::isfinite(load.torque);
         });
}

ObserverKind series_record_observer() {
  return observer_kind<SeriesRecord>([](const scene::Scene& scene) {
    return scene.output.series && (scene.output.series->forces || has_flow_rates(scene));
  });
}

}  // namespace clca::record
