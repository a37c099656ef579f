#include "clca/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clca/measure/profile.hpp"
#include "clca/run/setup.hpp"
#include "clca/store/file.hpp"
#include "run/force_measures.hpp"
#include "run/log.hpp"
#include "run/meter.hpp"
#include "run/outputs.hpp"
#include "run/records.hpp"
#include "run/stage.hpp"

namespace clca::run {

namespace {

class Run {
 public:
  Run(const scene::Scene& scene, const RunOptions& options, const RunEvents& events)
      : scene_(scene),
        options_(options),
        events_(events),
        automaton_(initial_state(scene), {.threads = options.threads}),
        outputs_(scene, automaton_.state(), options.last_picture_only),
        records_(scene) {
    prepare_stage(automaton_, scene, scene.stages.front());
    folder_.emplace(options.folder);
    log_.emplace(folder_->log(), events);
  }

  store::RunSummary execute();

 private:
  void run_stages();
  void run_stage(const scene::Stage& stage, std::size_t number);
  /// Steps until the stage ends; returns why.
  StageEnd run_steps(const scene::Stage& stage, std::size_t number, StageHistory& history);
  void show_progress(const scene::Stage& stage, std::size_t number, double moving_share,
                     std::optional<double> seconds_left);
  store::RunSummary summary(const std::string& status) const;
  void write_summary(const std::string& status) const {
    store::write_whole(folder_->summary(), store::to_json(summary(status)));
  }
  /// A disk that is full for the rest may be so for the summary: the first error is the one to
  /// tell.
  void note_failure() {
    try {
      write_summary("failed");
    } catch (const store::StoreError& error) {
      log_->error(error.what());
    }
  }

  bool stop_asked() const { return options_.stop != nullptr && options_.stop->load() != 0; }
  double rate() const { return step_clock_.seconds() > 0 ? updates_ / step_clock_.seconds() : 0; }

  const scene::Scene& scene_;
  const RunOptions& options_;
  const RunEvents& events_;
  WallClock wall_clock_;
  Stopwatch step_clock_;
  automaton::Automaton automaton_;
  Outputs outputs_;
  Records records_;
  std::optional<store::RunFolder> folder_;  // made when the first stage is known to fit
  std::optional<Log> log_;
  Ticker ticker_{std::chrono::milliseconds(100)};
  double updates_ = 0;      // particles x steps
  std::size_t moving_ = 0;  // in the last step
  bool interrupted_ = false;
  std::vector<store::StageSummary> stages_;
};

store::RunSummary Run::execute() {
  write_summary("running");
  try {
    run_stages();
  } catch (const std::exception& error) {
    log_->error(error.what());
    note_failure();
    throw;
  }
  const std::string status = interrupted_ ? "interrupted" : "done";
  write_summary(status);
  return summary(status);
}

void Run::run_stages() {
  outputs_.open(*folder_);
  if (scene_.output.frames && scene_.output.frames->caption && !render::font_problem().empty()) {
    log_->warning(render::font_problem());
  }
  for (std::size_t i = 0; i < scene_.stages.size() && !interrupted_; ++i) {
    if (i > 0) {
      prepare_stage(automaton_, scene_, scene_.stages[i]);
    }
    run_stage(scene_.stages[i], i + 1);
  }
  outputs_.finish();
}

void Run::run_stage(const scene::Stage& stage, std::size_t number) {
  StageHistory history = {.profile_at_start = measure::surface_profile(automaton_.state()),
                          .particles_at_start = automaton::present_count(automaton_.state()),
                          .steps = 0,
                          .cycles = 0,
                          .emitted = 0,
                          .outflow = measure::Outflow(measure::discharge(automaton_.state()))};
  records_.begin_stage(stage, automaton_);
  outputs_.begin_stage(stage, automaton_, records_);
  const StageEnd end = run_steps(stage, number, history);
  history.settled = end == StageEnd::settled || end == StageEnd::stalled;
  interrupted_ = end == StageEnd::interrupted;
  records_.end_stage(automaton_);
  outputs_.end_stage(stage, automaton_, records_, moving_, history);
  stages_.push_back({.name = stage.name,
                     .steps = history.steps,
                     .ended = to_text(end),
                     .measures = stage_measures(scene_, automaton_, history, records_)});
  log_->info(fmt::format("stage {}: {} steps, ended: {}", stage.name, history.steps, to_text(end)));
  for (const std::string& line : stall_lines(scene_, automaton_, history.profile_at_start)) {
    log_->info(line);
  }
  if (end == StageEnd::bound) {
    log_->warning(fmt::format("stage {} was still moving at its bound of {} steps (max_steps)",
                              stage.name, stage.max_steps));
  }
}

StageEnd Run::run_steps(const scene::Stage& stage, std::size_t number, StageHistory& history) {
  Forecast forecast;
  double most_moving = 0;
  while (!stop_asked()) {
    step_clock_.start();
    const automaton::StepReport report = automaton_.step();
    step_clock_.stop();
    ++history.steps;
    moving_ = report.moved;
    history.emitted += report.emitted;
    history.outflow.add(measure::discharge(automaton_.state()));
    const auto particles = static_cast<double>(automaton_.state().particles.size());
    updates_ += particles;
    records_.after_step(automaton_, history.steps);
    history.cycles = records_.cycles().cycles();
    outputs_.after_step(stage, automaton_, records_, history.steps, report.moved);
    if (const auto ended = stage_end(stage, automaton_.state(), report, history)) {
      return *ended;
    }
    const double moving_share = static_cast<double>(report.moved) / std::max(1.0, particles);
    most_moving = std::max(most_moving, moving_share);
    if (ticker_.due()) {
      forecast.update(done_share(stage, history, moving_share, most_moving));
      show_progress(stage, number, moving_share, forecast.seconds_left());
    }
  }
  return StageEnd::interrupted;
}

void Run::show_progress(const scene::Stage& stage, std::size_t number, double moving_share,
                        std::optional<double> seconds_left) {
  if (events_.progress) {
    events_.progress({.stage = stage.name,
                      .stage_number = number,
                      .stage_count = scene_.stages.size(),
                      .step = automaton_.state().step,
                      .particles = automaton_.state().particles.size(),
                      .moving_share = moving_share,
                      .updates_per_second = rate(),
                      .seconds_left = seconds_left});
  }
}

store::RunSummary Run::summary(const std::string& status) const {
  store::RunSummary summary = provenance();
  summary.scene = scene_.name;
  summary.seed = scene_.seed;
  summary.threads = options_.threads;
  summary.status = status;
  summary.particles = automaton_.state().particles.size();
  summary.steps = automaton_.state().step;
  summary.wall_seconds = wall_clock_.seconds();
  summary.step_seconds = step_clock_.seconds();
  summary.rate = rate();
  summary.state_hash = automaton::hash(automaton_.state());
  summary.stages = stages_;
  return summary;
}

}  // namespace

store::RunSummary run(const scene::Scene& scene, const RunOptions& options,
                      const RunEvents& events) {
  return Run(scene, options, events).execute();
}

}  // namespace clca::run
