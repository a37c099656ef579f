// lines-STAGE.csv: means over a stage on the lines of a scene.

#include <algorithm>
#include <optional>

#include "clca/measure/line.hpp"
#include "clca/scene/units.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

namespace {

struct LineRow {
  const scene::Line& line;
  const measure::LinePart& part;
  double velocity_unit;  // a spacing per step in the unit of velocities
  double flux_unit;      // a site per step and spacing in kg/(s·m), with a density
};

statistics::SampleStatistics in_units(const statistics::SampleStatistics& mean, double unit) {
  return {.mean = mean.mean * unit, .standard_error = mean.standard_error * unit};
}

TableOf<LineRow> lines_table(const scene::Scene& scene) {
  return {
      {.name = "lines", .kind = TableInfo::Kind::parts},
      {{{"line", "Line", "", "its name"}, [](auto& row) { return row.line.name; }},
       {{"position", "Position on the line", "spacings",
         "of the middle of the part, from the start of the line"},
        [](auto& row) { return row.part.position; }},
       {{"", "Position", "spacings", "of the middle of the part"},
        [](auto& row) { return row.part.middle; }},
       {{"flux", "Flux", "sites/(step·spacing)", "sites that pass"},
        [](auto& row) { return row.part.flux; }},
       {{"v_across", "Velocity across the line", "spacings/step", "mean of what lies on the line"},
        [](auto& row) { return in_units(row.part.across_velocity, row.velocity_unit); }},
       {{"v_along", "Velocity along the line", "spacings/step", "mean of what lies on the line"},
        [](auto& row) { return in_units(row.part.along_velocity, row.velocity_unit); }},
       {{"filling", "Filling", "",
         "share of the part that particles cover, of what no wall covers; 0 if walls cover all"},
        [](auto& row) { return row.part.covered_share; }},
       {{"particles", "Particles", "particles",
         "whose centre has passed, either way; on the edge of two parts half in each"},
        [](auto& row) { return row.part.passed_particles; }}},
      {{"with `units.density`",
        scene::has_density(scene),
        {{{"mass_flux", "Mass flux", "kg/(s·m)", "`flux` in SI units"},
          [](auto& row) { return in_units(row.part.flux, row.flux_unit); }}}}}};
}

/// Observes the lines at the steps that have rows in series.csv.
class LineRecord : public SavedObserver<LineRecord> {
 public:
  explicit LineRecord(const scene::Scene& scene) : table_(scene, lines_table(scene)) {}

  static double bytes(const scene::Scene& scene, double particles) {
    double bytes = 3 * measure::Snapshot::bytes_for(particles) +
                   particles * (sizeof(Eigen::Vector2d) + sizeof(std::optional<Eigen::Vector2d>));
    for (const scene::Line& line : scene.lines) {
      bytes += measure::Line::bytes_for(line.part_count) +
               2 * measure::LineSums::bytes_for(line.part_count);
    }
    return bytes;
  }

  void after_step(const StageView& now) override {
    if (now.model.state().step % now.scene.output.series->every == 0) {
      observe(now);
    }
  }
  void end_stage(const StageView& now) override {
    if (now.model.state().step > last_.step()) {
      observe(now);
    }
    const double spacing_per_step = velocity_factor(now.scene);
    const auto units = scene::unit_conversion(now.scene);
    const double flux_unit = units && units->site_mass ? units->mass_rate(1) / units->spacing : 0;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      for (const measure::LinePart& part : lines_[line].part_means(sums_[line])) {
        table_.add({now.scene.lines[line], part, spacing_per_step, flux_unit});
      }
    }
    table_.write(now.output_folder, now.stage.name);
  }
  std::vector<RunTable*> tables() override { return {&table_}; }

  bool precedes(const grains::State& now) const {
    return last_.precedes(now) &&
           std::equal(lines_.begin(), lines_.end(), sums_.begin(), sums_.end(),
                      [](const measure::Line& line, const measure::LineSums& sums) {
                        return sums.fits_part_count(line.part_count());
                      });
  }
  static constexpr const char* kPath = "records/lines";
  CLCA_FIELDS(last_, sums_);

 private:
  void prepare(const StageView& now) override {
    last_ = measure::Snapshot(now.model.state());
    lines_.clear();
    sums_.clear();
    for (const scene::Line& line : now.scene.lines) {
      const auto parts = static_cast<std::size_t>(line.part_count);
      lines_.emplace_back(now.model.state(), line.from, line.to, parts);
      sums_.emplace_back(parts);
    }
  }
  void observe(const StageView& now) {
    const model::SceneModel& model = now.model;
    const grains::State& state = model.state();
    std::vector<std::optional<Eigen::Vector2d>> velocities;
    if (is_contact_model(now.scene)) {
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

  std::vector<measure::Line> lines_;  // of this stage
  measure::Snapshot last_;            // at the last row
  std::vector<measure::LineSums> sums_;
  TableWriter<LineRow> table_;
};

}  // namespace

ObserverFactory lines_observer() {
  return observer_factory<LineRecord>(
      [](const scene::Scene& scene) { return !scene.lines.empty() && scene.output.series; },
      {lines_table});
}

}  // namespace clca::record
