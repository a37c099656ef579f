#include "run/outputs.hpp"

#include <algorithm>

#include "clca/measure/profile.hpp"
#include "clca/store/file.hpp"
#include "run/contact_tables.hpp"

namespace clca::run {

namespace {

constexpr std::size_t kBlock = 1U << 16U;  // bytes of rows that are written at once

}  // namespace

Outputs::Outputs(const scene::Scene& scene, const grains::State& state, const RunOptions& options)
    : scene_(scene), wanted_pictures_(options.pictures) {
  if (scene.output.frames && wanted_pictures_ != WantedPictures::none) {
    pictures_.emplace(scene, state, options.threads);
  }
  if (scene.output.series) {
    series_.emplace(scene);
  }
  if (!scene.probes.empty()) {
    probes_.emplace(scene);
  }
}

std::vector<std::string> Outputs::file_names() const {
  std::vector<std::string> names = {
      store::table_name("series"),
      store::table_name("cycles"),
      store::table_name("fields"),
      store::table_name("probes"),
      "trajectory.h5",
      "trajectory/part-000000.h5",
      store::frame_path("", scene_.name, 0, scene::step_digits(scene_)).string()};
  for (const scene::Stage& stage : scene_.stages) {
    for (const char* kind : {"profile", "convection", "fluctuation", "lines", "mixing", "contacts",
                             "forces", "loads", "walls", "stress"}) {
      names.push_back(store::table_name(kind, stage.name));
    }
  }
  return names;
}

std::set<std::string> Outputs::planned_names() const {
  std::set<std::string> names;
  if (scene_.output.checkpoint) {
    names.insert(store::kCheckpointBefore);
  }
  if (scene_.output.series) {
    names.insert(store::table_name("series"));
  }
  if (scene_.output.trajectory) {
    names.insert({"trajectory.h5", "trajectory/part-000000.h5"});
  }
  if (requests(scene::Measure::profile)) {
    for (const scene::Stage& stage : scene_.stages) {
      names.insert(store::table_name("profile", stage.name));
    }
  }
  return names;
}

void Outputs::GrowingTable::take(store::Table& table, std::size_t least) {
  if (table.waiting() > 0 && table.waiting() >= least) {
    const std::string header = file.bytes() == 0 ? table.header() : "";
    file.append(header + table.take());
  }
}

void Outputs::open(const store::RunFolder& folder, const grains::State& state) {
  reopen(folder, state, {.wanted_pictures = wanted_pictures_});
}

void Outputs::reopen(const store::RunFolder& folder, const grains::State& state,
                     const OutputHistory& history) {
  folder_ = &folder;
  wanted_pictures_ = history.wanted_pictures;
  if (wanted_pictures_ == WantedPictures::none) {
    pictures_.reset();
  }
  series_file_.emplace(
      GrowingTable{{folder.files(), store::table_name("series"), history.series_bytes}});
  cycles_file_.emplace(
      GrowingTable{{folder.files(), store::table_name("cycles"), history.cycles_bytes}});
  fields_file_.emplace(
      GrowingTable{{folder.files(), store::table_name("fields"), history.fields_bytes}});
  probes_file_.emplace(
      GrowingTable{{folder.files(), store::table_name("probes"), history.probes_bytes}});
  if (scene_.output.trajectory) {
    trajectory_.emplace(folder.files(), scene_, state, history.trajectory);
    trajectory_step_ = history.trajectory_step;
  }
  folder.remove_frames_after(history.pictures.last_step);
  if (series_) {
    series_->last_step() = history.series_step;
  }
  if (probes_) {
    probes_->last() = history.probes;
  }
  if (pictures_) {
    pictures_->history() = history.pictures;
    folder.files().make_folder(store::kFramesFolder);
  }
}

OutputHistory Outputs::flush(Records& records) {
  write_rows(records, 0);
  OutputHistory history = {.series_bytes = series_file_->file.bytes(),
                           .cycles_bytes = cycles_file_->file.bytes(),
                           .fields_bytes = fields_file_->file.bytes(),
                           .probes_bytes = probes_file_->file.bytes(),
                           .wanted_pictures = wanted_pictures_};
  if (series_) {
    history.series_step = series_->last_step();
  }
  if (probes_) {
    history.probes = probes_->last();
  }
  if (pictures_) {
    pictures_->finish();
    history.pictures = pictures_->history();
  }
  if (trajectory_) {
    trajectory_->flush();
    history.trajectory = trajectory_->written();
    history.trajectory_step = trajectory_step_;
  }
  return history;
}

void Outputs::write_rows(Records& records, std::size_t least) {
  if (series_) {
    series_file_->take(series_->table(), least);
  }
  cycles_file_->take(records.cycle_rows(), least);
  if (store::Table* rows = records.field_rows()) {
    fields_file_->take(*rows, least);
  }
  if (probes_) {
    probes_file_->take(probes_->table(), least);
  }
}

void Outputs::add_rows(const scene::Stage& stage, const Model& model, const Records& records,
                       std::size_t moving, bool always) {
  if (series_ && series_->add(stage.name, model, records, moving, always) && probes_) {
    probes_->add(stage.name, model);
  }
}

void Outputs::begin_stage(const scene::Stage& stage, const Model& model, const Records& records) {
  if (pictures_) {
    pictures_->begin_stage(stage, model.state());
  }
  if (pictures_ && wanted_pictures_ == WantedPictures::all) {
    pictures_->draw(model, records, *folder_);
  }
  add_rows(stage, model, records, 0, true);
  add_to_trajectory(stage, model, records, true);
}

void Outputs::add_to_trajectory(const scene::Stage& stage, const Model& model,
                                const Records& records, bool begins) {
  const grains::State& state = model.state();
  if (!trajectory_ || (!begins && trajectory_step_ == state.step)) {
    return;
  }
  store::ContactFrame contact{.velocities = model.velocities()};
  if (scene_.output.trajectory->contacts) {
    contact.forces = records.contacts()->of_frame(model);
  }
  trajectory_->add(state, static_cast<std::size_t>(&stage - scene_.stages.data()), begins, contact);
  trajectory_step_ = state.step;
}

void Outputs::after_step(const scene::Stage& stage, const Model& model, Records& records,
                         std::uint64_t steps_in_stage, std::size_t moving) {
  if (pictures_ && wanted_pictures_ == WantedPictures::all &&
      steps_in_stage % scene_.output.frames->every == 0) {
    pictures_->draw(model, records, *folder_);
  }
  add_rows(stage, model, records, moving, false);
  if (trajectory_ && steps_in_stage % scene_.output.trajectory->every == 0) {
    add_to_trajectory(stage, model, records, false);
  }
  write_rows(records, kBlock);
}

void Outputs::end_stage(const scene::Stage& stage, const Model& model, Records& records,
                        std::size_t moving, const StageHistory& history) {
  if (pictures_ && (wanted_pictures_ == WantedPictures::all || &stage == &scene_.stages.back())) {
    pictures_->draw(model, records, *folder_);
  }
  add_rows(stage, model, records, moving, true);
  add_to_trajectory(stage, model, records, false);
  write_rows(records, 0);
  write_tables(stage, model, records, history);
}

void Outputs::write_tables(const scene::Stage& stage, const Model& model, const Records& records,
                           const StageHistory& history) {
  const grains::State& state = model.state();
  const auto write = [&](const char* kind, const std::string& csv) {
    folder_->files().write(store::table_name(kind, stage.name), csv);
  };
  if (requests(scene::Measure::profile)) {
    write("profile", profile_table(history.profile_at_start, measure::surface_profile(state)));
  }
  if (requests(scene::Measure::convection) && records.cycles().convection() != nullptr) {
    write("convection", records.cycles().convection_csv());
  }
  if (records.fields() && records.fields()->fluctuations().samples() > 0) {
    write("fluctuation", records.fields()->fluctuation_csv());
  }
  if (records.lines()) {
    write("lines", records.lines()->csv());
  }
  if (records.mixing()) {
    write("mixing", mixing_table(*records.mixing()));
  }
  if (requests(scene::Measure::force) && records.contacts()) {
    const std::vector<contact::Force> forces = records.contacts()->at_end(model);
    write("contacts", contact_forces_csv(scene_, forces));
    write("forces", force_distribution_csv(forces));
    write("loads", grain_loads_csv(scene_, model, forces));
    write("walls", wall_forces_csv(scene_, forces));
    write("stress", stress_csv(state, forces, records.cycles().cell()));
  }
  if (requests(scene::Measure::force) && records.forces()) {
    const auto contacts = measure::contacts(state, model.grains().occupancy());
    const auto summary = measure::force_summary(state, model.grains().occupancy(), contacts);
    write("contacts", records.forces()->contacts_csv(scene_, contacts));
    write("forces", distribution_csv(records.forces()->distribution(contacts)));
    write("loads", loads_csv(scene_, state, contacts));
    write("walls", wall_overlaps_csv(scene_, state, summary, history.profile_at_start));
  }
}

bool Outputs::requests(scene::Measure measure) const {
  const auto& wanted = scene_.measures;
  return std::find(wanted.begin(), wanted.end(), measure) != wanted.end();
}

void Outputs::finish() {
  if (trajectory_) {
    trajectory_->flush();
  }
  if (pictures_) {
    pictures_->finish();
  }
}

}  // namespace clca::run
