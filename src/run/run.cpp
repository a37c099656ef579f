#include "clca/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "clca/parallel/team.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/format.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/units.hpp"
#include "clca/scene/walls.hpp"
#include "drawing/internal/frame_painter.hpp"
#include "record/internal/meter.hpp"
#include "record/internal/observer.hpp"
#include "record/internal/quantities.hpp"
#include "run/run_base.hpp"
#include "run/saved.hpp"
#include "run/stage.hpp"

namespace clca::run {

namespace {

/// Pictures see a moment last.
record::Observers observers_of(const scene::Scene& scene, const grains::State& state,
                               const RunOptions& options) {
  auto all = record::make_observers(scene);
  if (scene.output.frames && options.pictures != WantedPictures::none) {
    all.push_back(drawing::pictures_observer(scene, state, options.threads,
                                             options.pictures == WantedPictures::last));
  }
  return record::Observers(std::move(all));
}

class Run : public RunBase {
 public:
  Run(const scene::Scene& scene, const RunOptions& options, const RunEvents& events,
      std::optional<store::RunFolder> folder = {})
      : Run(scene, options, events, state_at_start(scene), false) {
    course_.history = prepare_stage(model_, scene_, 0);
    store::Checkpoint start = checkpoint_without_fields();
    reflection::encode(kRequestedPicturesPath, options.pictures, start.fields);
    begin(std::move(folder), start);
  }

  /// Resumes `saved`; `parts` belong to it.
  Run(const scene::Scene& scene, const RunOptions& options, const RunEvents& events,
      SavedRun& saved, SavedParts parts)
      : Run(scene, options, events, std::move(parts.state), true) {
    course_.counters = parts.counters;
    go_on(std::move(saved.folder), parts.counters.log_bytes, parts.counters.wall_seconds);
    course_.history = std::move(parts.history);
    course_.present_particles = grains::present_count(model_.state());
    stage_summaries() = std::move(parts.ended_stages);
    model_.set_rules(stage());
    course_.observers.load({saved.checkpoint.fields, saved.max_bytes}, course_.view());
  }

 private:
  Run(const scene::Scene& scene, const RunOptions& options, const RunEvents& events,
      model::ModelState state, bool in_stage)
      : RunBase({.kind = std::string(scene::name_of_model(scene.model)),
                 .scene = scene.name,
                 .title = scene.title,
                 .seed = scene.seed,
                 .scene_text = scene::to_yaml(scene),
                 .checkpoint_intervals = scene.output.checkpoint},
                options, events),
        scene_(scene),
        conversion_(scene::unit_conversion(scene)),
        model_(scene, std::move(state),
               {.threads = options.threads,
                .min_parallel_particles = options.parallel_from,
                .use_reference = options.use_reference_step}),
        course_{.scene = scene,
                .model = &model_,
                .observers = observers_of(scene, model_.state(), options),
                .warn = [this](const std::string& line) { warning(line); }},
        in_stage_(in_stage) {}

  void open_files() override;
  void carry_out() override;
  void complete_summary(store::RunSummary& summary) const override;
  void run_stage();
  /// Writes the rest of the trajectory; the failure itself is reported by the base.
  void finish_after_failure();
  StageEnd run_steps();  ///< runs steps until the stage ends; returns the reason
  void end_stage(StageEnd end);
  store::Checkpoint checkpoint_now();  ///< of the run between two steps
  void show_progress(bool until_rest, std::optional<double> seconds_left);
  const scene::Stage& stage() const { return course_.stage(); }
  double rate() const {
    const RunCounters& reached = course_.counters;
    return reached.step_seconds > 0 ? reached.updates / reached.step_seconds : 0;
  }

  const scene::Scene& scene_;
  std::optional<scene::UnitConversion> conversion_;
  model::SceneModel model_;
  StageRunner course_;
  bool in_stage_;                                    // one that goes on
  std::optional<store::Checkpoint> end_checkpoint_;  // is written with what comes after it
};

void Run::open_files() {
  course_.files = &folder().output_folder();
  course_.observers.open(folder(), model_.state());
}

void Run::carry_out() {
  const bool has_pictures = scene_.output.frames && options().pictures != WantedPictures::none;
  if (has_pictures && scene_.output.frames->has_caption && !render::font_warning().empty()) {
    warning(render::font_warning());
  }
  try {
    for (; course_.counters.stage < scene_.stages.size() && is_complete();
         ++course_.counters.stage) {
      run_stage();
    }
  } catch (const std::exception&) {
    finish_after_failure();
    throw;
  }
  course_.observers.finish();
  if (end_checkpoint_) {
    save(*std::move(end_checkpoint_));
  }
}

void Run::finish_after_failure() {
  try {
    course_.observers.finish();
  } catch (const std::exception&) {  // of a full disk, say, for which the run has failed
  }
}

void Run::run_stage() {
  if (!std::exchange(in_stage_, false)) {
    if (course_.counters.stage > 0) {
      course_.history = prepare_stage(model_, scene_, course_.counters.stage);
    }
    tell(fmt::format("stage {}: begins at step {} with {} particles", stage().name,
                     model_.state().step, grains::present_count(model_.state())));
    course_.begin_stage();
    if (scene_.initial_state && course_.counters.stage == 0) {
      save(checkpoint_now());  // from here on the other run is not needed
    }
  }
  const StageEnd end = run_steps();
  const bool last = course_.counters.stage + 1 == scene_.stages.size();
  if (end == StageEnd::interrupted) {
    mark_interrupted();
    save(checkpoint_now());
  } else if (last && scene_.output.checkpoint) {
    end_checkpoint_ = checkpoint_now();
  }
  end_stage(end);
}

StageEnd Run::run_steps() {
  record::TimeEstimate estimate;
  while (true) {
    if (const auto ended = stage_end(stage(), model_.state(), course_.history)) {
      return *ended;
    }
    if (stop_is_requested()) {
      return StageEnd::interrupted;
    }
    course_.step();
    if (progress_due()) {
      const std::optional<double> done = done_share(stage(), course_.history);
      estimate.update(done.value_or(0));
      show_progress(!done, estimate.seconds_left());
    }
    if (checkpoint_due(model_.state().step)) {
      save(checkpoint_now());
    }
  }
}

void Run::end_stage(StageEnd end) {
  course_.end_stage(end);
  const record::StageHistory& history = course_.history;
  stage_summaries().push_back({.name = stage().name,
                               .steps = history.steps,
                               .end_reason = to_text(end),
                               .measures = record::stage_measures(course_.view()),
                               .notes = record::measure_notes(scene_, model_),
                               .fills_particles = stage().fill.has_value()});
  const std::string time =
      conversion_ ? fmt::format(" ({})", conversion_->time_text(history.steps)) : "";
  info(fmt::format("stage {}: {} steps{}, ended: {}", stage().name, history.steps, time,
                   to_text(end)));
  const auto* until = std::get_if<scene::UntilDischarged>(&stage().until);
  if (until != nullptr && end == StageEnd::settled) {
    info(fmt::format("stage {}: nothing moves any more, with {:.3g} % discharged, not {:.3g} %",
                     stage().name, 100 * history.discharged_share(),
                     100 * until->discharged_share));
  }
  for (const std::string& note : stage_summaries().back().notes) {
    info(fmt::format("stage {}: {}", stage().name, note));
  }
  for (const std::string& line : record::stall_messages(scene_, model_, history.profile_at_start)) {
    info(line);
  }
  if (end == StageEnd::bound) {
    warning(fmt::format("stage {} was still moving at its bound of {} steps (max_steps)",
                        stage().name, stage().max_steps));
  }
}

store::Checkpoint Run::checkpoint_now() {
  tell(fmt::format("checkpoint of step {}", model_.state().step));
  store::Checkpoint saved = checkpoint_without_fields();
  course_.observers.save(saved.fields);
  course_.counters.wall_seconds = wall_seconds();
  course_.counters.log_bytes = log_bytes();
  model_.save(saved.fields);
  reflection::encode(kCountersPath, course_.counters, saved.fields);
  reflection::encode(kStageHistoryPath, course_.history, saved.fields);
  reflection::encode(kPicturesPath, options().pictures, saved.fields);
  return saved;
}

void Run::show_progress(bool until_rest, std::optional<double> seconds_left) {
  if (events().progress) {
    events().progress({.stage = stage().name,
                       .stage_number = course_.counters.stage + 1,
                       .stage_count = scene_.stages.size(),
                       .step = model_.state().step,
                       .time_text = conversion_ ? conversion_->time_text(model_.state().step) : "",
                       .particles = model_.state().particles.size(),
                       .moving_share = static_cast<double>(course_.counters.moving) /
                                       std::max(1.0, static_cast<double>(course_.counters.stepped)),
                       .particle_updates_per_second = rate(),
                       .ends_at_rest = until_rest,
                       .seconds_left = seconds_left});
  }
}

void Run::complete_summary(store::RunSummary& summary) const {
  summary.particles = model_.state().particles.size();
  summary.steps = model_.state().step;
  summary.units = conversion_;
  const lattice::Lattice& lattice = model_.state().lattice;
  const Eigen::Vector2d low = lattice::Lattice::lower_left_corner();
  const Eigen::Vector2d high = low + lattice.extent();
  summary.box = {.left = low.x(),
                 .right = high.x(),
                 .floor = low.y(),
                 .top = high.y(),
                 .periodic = lattice.periodic()};
  summary.derived_measures = scene_.derived_measures;
  summary.table_descriptions = course_.observers.table_summaries();
  const auto& kinds = model_.state().kinds;
  const std::vector<int> degrees = scene::orientation_degrees(scene_, kinds);
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    summary.kinds.push_back({scene_.species[kinds[kind].species].name, degrees[kind]});
  }
  if (scene_.initial_state) {
    summary.begin = {.run_folder = scene_.initial_state->run_folder,
                     .step = scene_.initial_state->step,
                     .state_hash = scene_.initial_state->state_hash.value_or(0)};
  }
  summary.step_seconds = course_.counters.step_seconds;
  summary.rate_per_second = rate();
  summary.state_hash = model_.hash();
}

/// With the threads that the steps will use started: later there may be no memory for them.
RunOptions with_started_threads(const RunOptions& options, const RunEvents& events) {
  return with_threads(options, parallel::start_team(options.threads), events);
}

/// Throws store::StoreError for a checkpoint that no run of the scene can have saved.
std::unique_ptr<Run> resumed_run(const scene::Scene& scene, RunOptions options,
                                 const RunEvents& events, SavedRun& saved) {
  const std::filesystem::path folder = saved.folder.path();
  try {
    options.pictures = wanted_pictures_of(saved);
    return std::make_unique<Run>(scene, options, events, saved, saved_parts(saved));
  } catch (const reflection::ColumnMismatch& error) {
    throw mismatched_checkpoint(folder, error.what());
  } catch (const std::invalid_argument& error) {
    throw mismatched_checkpoint(folder, error.what());
  }
}

}  // namespace

void try_start(const scene::Scene& scene) {
  scene::check_room(scene);
  model::SceneModel model(scene, state_at_start(scene), {});
  prepare_stage(model, scene, 0);
  if (scene.output.frames) {
    const drawing::FramePainter painter(scene, model.state(), {});
  }
}

store::RunSummary run(const scene::Scene& scene, const RunOptions& options,
                      const RunEvents& events) {
  std::error_code unknown;
  if (scene.initial_state && !options.keep_earlier_run &&
      std::filesystem::equivalent(scene.initial_state->run_folder, options.folder, unknown)) {
    throw scene::SceneError(
        fmt::format("{}: error: begin: this run would replace the one in {}; run in another "
                    "folder, or with --keep",
                    scene.initial_state->location, scene.initial_state->run_folder));
  }
  record::check_derived(scene);
  scene::Scene whole = scene;
  resolve_begin(whole, std::numeric_limits<double>::infinity());
  scene::check_room(whole);
  return Run(whole, with_started_threads(options, events), events).execute();
}

store::RunSummary resume(SavedRun saved, const RunOptions& options, const RunEvents& events) {
  if (!saved.warning.empty() && events.warning) {
    events.warning(saved.warning);
  }
  if (saved.finished_summary) {
    return *saved.finished_summary;
  }
  if (std::holds_alternative<scene::BoltzmannScene>(saved.scene)) {
    return resume_gas(saved, options, events);
  }
  RunOptions startable = with_started_threads(options, events);
  const auto& scene = std::get<scene::Scene>(saved.scene);
  if (saved.checkpoint.is_before_first_step()) {
    startable.pictures = wanted_pictures_of(saved);
    saved.folder.start_over(saved.checkpoint);
    return Run(scene, startable, events, std::move(saved.folder)).execute();
  }
  return resumed_run(scene, startable, events, saved)->execute();
}

}  // namespace clca::run
