#include "run/line_record.hpp"

#include <algorithm>

#include "clca/store/table.hpp"

namespace clca::run {

LineRecord::LineRecord(const scene::Scene& scene)
    : every_(scene.output.series->every),
      conversion_(scene::conversion(scene)),
      scene_lines_(scene.lines) {}

void LineRecord::begin_stage(const grains::State& state) {
  last_ = measure::Snapshot(state);
  lines_.clear();
  sums_.clear();
  for (const scene::Line& line : scene_lines_) {
    const auto parts = static_cast<std::size_t>(line.parts);
    lines_.emplace_back(state, line.from, line.to, parts);
    sums_.emplace_back(parts);
  }
}

void LineRecord::after_step(const Model& model) {
  if (model.state().step % every_ == 0) {
    observe(model);
  }
}

void LineRecord::end_stage(const Model& model) {
  if (model.state().step > last_.step()) {
    observe(model);
  }
}

void LineRecord::observe(const Model& model) {
  const grains::State& state = model.state();
  std::vector<std::optional<Eigen::Vector2d>> velocities;
  if (conversion_) {
    const std::vector<Eigen::Vector2d> at_row = model.velocities();
    velocities.assign(at_row.begin(), at_row.end());
  } else {
    velocities = last_.velocities(state);
  }
  for (std::size_t line = 0; line < lines_.size(); ++line) {
    lines_[line].observe(last_, state, model.grains().occupancy(), velocities, sums_[line]);
  }
  last_ = measure::Snapshot(state);
}

std::string LineRecord::csv() const {
  store::Table table({"line", "position", "x", "y", "flux", "flux_se", "v_across", "v_across_se",
                      "v_along", "v_along_se", "filling", "particles"});
  const double speed = conversion_ ? conversion_->velocity(1) : 1;
  for (std::size_t line = 0; line < lines_.size(); ++line) {
    for (const measure::LinePart& part : lines_[line].means(sums_[line])) {
      table.add_row({scene_lines_[line].name, part.position, part.middle.x(), part.middle.y(),
                     part.flux.value, part.flux.error, part.across.value * speed,
                     part.across.error * speed, part.along.value * speed, part.along.error * speed,
                     part.filling, part.particles});
    }
  }
  return table.to_csv();
}

bool LineRecord::precedes(const grains::State& now) const {
  return last_.precedes(now) &&
         std::equal(lines_.begin(), lines_.end(), sums_.begin(), sums_.end(),
                    [](const measure::Line& line, const measure::LineSums& sums) {
                      return sums.fit(line.parts());
                    });
}

}  // namespace clca::run
