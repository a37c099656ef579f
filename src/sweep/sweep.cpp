#include "clca/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "clca/image/png.hpp"
#include "clca/render/painter.hpp"
#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "sweep/earlier.hpp"
#include "sweep/folder.hpp"
#include "sweep/overview.hpp"
#include "sweep/run_pool.hpp"
#include "sweep/tables.hpp"

namespace clca::sweep {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void tell(const std::function<void(const std::string&)>& event, const std::string& text) {
  if (event) {
    event(text);
  }
}

/// Refuses once, before anything is written, what would fail in every run.
void prepare_drawing(const Plan& plan) {
  const auto drawn =
      std::find_if(plan.variants.begin(), plan.variants.end(),
                   [](const Variant& variant) { return variant.scene.output.frames.has_value(); });
  if (drawn == plan.variants.end()) {
    return;
  }
  try {
    render::prepare_environment();
  } catch (const render::RenderError& error) {
    throw run::SceneRunError(
        fmt::format("{}: error: {}", drawn->scene.output.frames->location, error.what()));
  }
}

class Sweep {
 public:
  Sweep(const Plan& plan, const Options& options, const Events& events)
      : plan_(plan),
        options_(options),
        events_(events),
        folder_(options.folder),
        results_(plan.run_count()) {
    const Part part = options.part.value_or(Part());
    for (std::size_t run = part.number - 1; run < plan.run_count(); run += part.of) {
      runs_.push_back(run);
    }
    progress_.runs = runs_.size();
    if (!options.part) {
      folder_.begin(plan);
    }
  }

  Progress execute();

 private:
  /// Takes over what earlier sweeps have left; returns the runs that remain.
  std::vector<std::size_t> remaining_runs();
  void carry_out(const std::vector<std::size_t>& runs);
  void take(FinishedRun one);
  void show_progress();
  void write_tables();
  void refresh_tables();
  void write_overview();

  bool stop_asked() const { return options_.stop != nullptr && options_.stop->load() != 0; }

  const Plan& plan_;
  const Options& options_;
  const Events& events_;
  Folder folder_;
  std::vector<std::size_t> runs_;  // to be done, of the plan
  std::vector<Result> results_;    // in the order of the plan
  Progress progress_;
  std::string store_error_;  // the first
  Clock::time_point start_ = Clock::now();
  Clock::time_point tables_due_ = Clock::now();
  bool tables_stale_ = true;
};

Progress Sweep::execute() {
  const std::vector<std::size_t> runs = remaining_runs();
  if (progress_.reused > 0) {
    tell(events_.message,
         fmt::format("{} of {} runs are there from before", progress_.reused, progress_.runs));
  }
  start_ = Clock::now();
  carry_out(runs);
  if (!store_error_.empty()) {
    throw store::StoreError(store_error_);
  }
  if (!options_.part) {
    write_tables();
    write_overview();
  }
  return progress_;
}

std::vector<std::size_t> Sweep::remaining_runs() {
  std::vector<std::size_t> remaining;
  for (const std::size_t run : runs_) {
    auto earlier = stop_asked() ? std::nullopt
                                : earlier_run(folder_.run(plan_.name(run)), plan_.scene(run),
                                              options_.all_pictures);
    if (earlier) {
      results_[run] = {Status::done, std::move(*earlier), {}};
      ++progress_.reused;
    } else {
      remaining.push_back(run);
    }
  }
  progress_.done = progress_.reused;
  return remaining;
}

void Sweep::carry_out(const std::vector<std::size_t>& runs) {
  constexpr std::chrono::milliseconds kPause(100);
  if (stop_asked()) {
    return;
  }
  RunPool pool(plan_, folder_, runs, options_);
  if (pool.at_a_time() < pool.wanted()) {
    tell(events_.warning, fmt::format("only {} of {} runs at a time, as no more threads can be "
                                      "started",
                                      pool.at_a_time(), pool.wanted()));
  }
  while (!pool.finished()) {
    for (FinishedRun& one : pool.take_finished(kPause)) {
      take(std::move(one));
    }
    if (stop_asked() || !store_error_.empty()) {
      pool.stop();
    }
    show_progress();
    refresh_tables();
  }
}

void Sweep::take(FinishedRun one) {
  const std::string name = plan_.name(one.run);
  for (const std::string& warning : one.warnings) {
    tell(events_.warning, fmt::format("{}: {}", name, warning));
  }
  if (!one.store_error.empty()) {
    // What one run cannot write the next cannot either: this is an end, not a failed run.
    store_error_ = store_error_.empty() ? one.store_error : store_error_;
  } else if (one.result.status == Status::failed) {
    ++progress_.failed;
    tell(events_.warning, fmt::format("{} failed: {}", name, one.result.error));
  } else if (one.result.status == Status::done) {
    ++progress_.done;
  }
  results_[one.run] = std::move(one.result);
  tables_stale_ = true;
}

void Sweep::show_progress() {
  const std::size_t ended = progress_.done + progress_.failed;
  const auto executed = static_cast<double>(ended - progress_.reused);
  if (executed > 0) {
    progress_.runs_per_second = executed / seconds_since(start_);
    progress_.seconds_left =
        static_cast<double>(progress_.runs - ended) / progress_.runs_per_second;
  }
  if (events_.progress) {
    events_.progress(progress_);
  }
}

void Sweep::write_tables() {
  folder_.write_tables(runs_table(plan_, results_), measures_table(plan_, results_));
}

/// Every so often, and never for more than a small part of the time.
void Sweep::refresh_tables() {
  constexpr std::chrono::seconds kInterval(5);
  constexpr int kShare = 20;
  const Clock::time_point now = Clock::now();
  if (options_.part || !tables_stale_ || now < tables_due_) {
    return;
  }
  write_tables();
  tables_stale_ = false;
  tables_due_ = Clock::now() + std::max<Clock::duration>(kInterval, kShare * (Clock::now() - now));
}

void Sweep::write_overview() {
  const auto image = overview(plan_, results_, folder_);
  if (!image) {
    return;
  }
  const std::string title = plan_.variants.front().scene.title;
  folder_.write_overview(image::encode_png(
      *image, {{"Title", title}, {"Software", fmt::format("clca {}", run::version())}}));
  const std::size_t shown = selection(plan_).runs.size();
  if (shown < progress_.runs) {
    tell(events_.message, fmt::format("the overview shows {} of {} runs", shown, progress_.runs));
  }
}

}  // namespace

Progress execute(const Plan& plan, const Options& options, const Events& events) {
  prepare_drawing(plan);
  return Sweep(plan, options, events).execute();
}

}  // namespace clca::sweep
