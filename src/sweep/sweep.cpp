#include "clca/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>

#include "clca/image/png.hpp"
#include "clca/record/quantity.hpp"
#include "clca/render/painter.hpp"
#include "clca/statistics/sample.hpp"
#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/tasks/pool.hpp"
#include "sweep/results.hpp"

namespace clca::sweep {

namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Refuses once, before anything is written, what would fail in every run.
void prepare_drawing(const Plan& plan) {
  const auto drawn = std::ranges::find_if(plan.variants, [](const Variant& variant) {
    const auto& frames = variant.scene.output.frames;
    return frames && frames->drawing == scene::DrawingMethod::polygons;
  });
  if (drawn == plan.variants.end()) {
    return;
  }
  try {
    render::prepare_opengl();
  } catch (const render::RenderError& error) {
    throw scene::SceneError(
        fmt::format("{}: error: {}", drawn->scene.output.frames->location, error.what()));
  }
}

/// For Ranks::begin(): the same for all ranks that do the same runs in the same way.
std::string work_description(const Plan& plan, const Options& options) {
  const Part part = options.part.value_or(Part());
  return fmt::format("sweep {}",
                     hash_of(plan, fmt::format("{} {} {} {}", options.folder.string(), part.number,
                                               part.count, options.all_pictures)));
}

/// Which pictures a run draws: those that the overview does not show are not asked for.
run::WantedPictures pictures_of(const Plan& plan, const Options& options, std::size_t run) {
  const std::vector<std::size_t> shown = overview_runs(plan).runs;
  return options.all_pictures                           ? run::WantedPictures::all
         : std::ranges::find(shown, run) != shown.end() ? run::WantedPictures::last
                                                        : run::WantedPictures::none;
}

constexpr const char* kRequestFile = "sweep.json";
constexpr const char* kOverview = "overview.png";

/// The request, with what the columns of the tables are, and the measures that no run has.
std::string to_json(const Plan& plan, const std::vector<store::TableSummary>& tables,
                    const std::vector<store::ColumnSummary>& measures) {
  Json variations = Json::array();
  for (const Variation& variation : plan.request.variations) {
    variations.push_back({{"keys", variation.keys}, {"rows", variation.value_rows}});
  }
  Json set = Json::array();
  std::ranges::transform(plan.request.overrides, std::back_inserter(set), &scene::Override::text);
  const Json object = {{"clca", store::version()},
                       {"scene", plan.request.scene_file.string()},
                       {"title", plan.title()},
                       {"set", std::move(set)},
                       {"vary", std::move(variations)},
                       {"seeds", to_text(plan.request.seeds)},
                       {"runs", plan.run_count()},
                       {"measures", store::to_json_list(measures)},
                       {"tables", store::to_json_object(tables)}};
  constexpr int kIndent = 2;
  // Names of files need not be UTF-8.
  return object.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

class Sweep {
 public:
  Sweep(const Plan& plan, const Options& options, const Events& events)
      : plan_(plan),
        options_(options),
        events_(events),
        ranks_(options.ranks != nullptr ? *options.ranks : alone_),
        files_(options.folder),
        results_(plan.run_count()) {
    for (const auto& [file, kind] :
         {std::pair(store::kSummaryFile, "run"), {store::kCalibrationFile, "calibration"}}) {
      if (files_.owns(file)) {
        throw store::StoreError(
            fmt::format("cannot sweep in {}: it is the folder of a {}; write elsewhere",
                        files_.path().string(), kind));
      }
    }
    const Part part = options.part.value_or(Part());
    for (std::size_t run = part.number - 1; run < plan.run_count(); run += part.count) {
      runs_.push_back(run);
    }
    progress_.total_runs = runs_.size();
    files_.make_clca_folder(kRunsFolder);  // of parts of it, brought together from other machines
    if (!options.part) {
      lock_.emplace(options.folder);
      files_.write(kRequestFile, to_json(plan, {}, {}));
      files_.remove(kOverview);
      files_.make_folder(kRunsFolder);
    }
  }

  Progress execute() {
    if (ranks_.size() > 1 && !options_.collect_only) {
      ranks_.begin(work_description(plan_, options_));
    }
    const std::vector<std::size_t> runs = remaining_runs();
    if (progress_.reused_runs > 0) {
      events_.message(fmt::format("{} of {} runs are there from before", progress_.reused_runs,
                                  progress_.total_runs));
    }
    if (replaced_runs_ > 0 && !options_.collect_only) {
      events_.message(
          fmt::format("replaces {} of the finished runs in the folder, which have another scene, "
                      "other settings, "
                      "another version or other pictures",
                      replaced_runs_));
    }
    start_ = Clock::now();
    if (!options_.collect_only && !runs.empty() && !stop_asked()) {
      carry_out(runs);
    }
    if (!store_error_.empty()) {
      throw store::StoreError(store_error_);
    }
    if (!options_.part) {
      const auto means = mean_tables(
          plan_, results_, [this](std::size_t run) { return folder_of(run); }, events_.warning);
      remove_means_but(means);
      write_tables(means);
      write_overview();
    }
    return progress_;
  }

 private:
  using Pool = tasks::Pool<RunOutcome>;

  std::filesystem::path folder_of(std::size_t run) const {
    return run_folder(files_.path(), plan_.run_name(run));
  }
  bool stop_asked() const {
    return options_.stop_signal != nullptr && options_.stop_signal->load() != 0;
  }

  /// The run that was once done; takes over its result if it is whole.
  std::optional<EarlierRun> take_earlier(std::size_t run) {
    auto earlier = earlier_run(folder_of(run), plan_.scene(run), pictures_of(plan_, options_, run));
    if (earlier && earlier->is_reusable) {
      results_[run] = {Status::done, earlier->summary, {}};
      ++progress_.done_runs;
    }
    return earlier;
  }

  /// Takes over what earlier sweeps have left; returns the runs that remain, the longest first as
  /// far as earlier runs tell.
  std::vector<std::size_t> remaining_runs() {
    std::vector<std::size_t> remaining;
    std::vector<double> seconds(plan_.run_count(), std::numeric_limits<double>::infinity());
    std::vector<std::vector<double>> seconds_of_variants(plan_.variants.size());
    const auto variant = [&](std::size_t run) { return run / plan_.request.seeds.size(); };
    for (const std::size_t run : runs_) {
      const auto earlier = stop_asked() ? std::nullopt : take_earlier(run);
      if (earlier) {
        seconds[run] = earlier->summary.wall_seconds;
        seconds_of_variants[variant(run)].push_back(seconds[run]);
      }
      if (!earlier || !earlier->is_reusable) {
        remaining.push_back(run);
        replaced_runs_ += earlier ? 1 : 0;
      }
    }
    progress_.reused_runs = progress_.done_runs;
    std::vector<double> means;
    for (const std::vector<double>& known : seconds_of_variants) {
      means.push_back(statistics::sample_statistics(known).mean);
    }
    for (const std::size_t run : remaining) {
      seconds[run] = std::fmin(seconds[run], means[variant(run)]);  // the mean of none is ignored
    }
    // Those of which nothing is known may be the longest.
    std::ranges::stable_sort(remaining,
                             [&](std::size_t a, std::size_t b) { return seconds[a] > seconds[b]; });
    return remaining;
  }

  RunOutcome carry_out(std::size_t run, const std::atomic<int>& stop) {
    RunOutcome finished =
        execute_run(plan_.scene(run), folder_of(run), options_, pictures_of(plan_, options_, run),
                    &stop, [&](const run::Progress& progress) {
                      const std::lock_guard lock(mutex_);
                      under_way_[run] = progress;
                    });
    const std::lock_guard lock(mutex_);
    under_way_.erase(run);
    return finished;
  }

  void carry_out(const std::vector<std::size_t>& runs) {
    ranks_.hand_out_work([&](int /*rank*/) { return Json::to_cbor(runs); });
    constexpr std::chrono::milliseconds kPause(100);
    const std::size_t wanted = std::min(runs.size(), static_cast<std::size_t>(options_.jobs));
    Pool pool(
        wanted, ranks_, runs,
        {.carry_out = [this](std::size_t run, const auto& stop) { return carry_out(run, stop); },
         .result = [](std::size_t /*run*/,
                      const tasks::Bytes& answer) { return run_outcome(answer); }},
        options_.stop_signal);
    if (pool.tasks_at_a_time() < wanted) {
      events_.warning(fmt::format("only {} of {} runs at a time, as no more threads can be started",
                                  pool.tasks_at_a_time(), wanted));
    }
    while (!pool.finished()) {
      for (auto& [run, finished] : pool.take_finished(kPause)) {
        take_outcome(run, std::move(finished));
      }
      if (!store_error_.empty()) {
        pool.stop();
      }
      if (pool.finished() && !retries_in_use_) {
        retries_in_use_ = true;
        std::ranges::for_each(in_use_, [&](std::size_t run) { pool.add(run); });
      }
      show_progress();
      refresh_tables();
    }
    look_elsewhere();
    tell_shares(pool.carried_out());
  }

  void take_outcome(std::size_t run, RunOutcome finished) {
    const std::string name = plan_.run_name(run);
    for (const std::string& warning : finished.warnings) {
      events_.warning(fmt::format("{}: {}", name, warning));
    }
    if (!finished.store_error.empty()) {
      // What one run cannot write the next cannot either: this is an end, not a failed run.
      store_error_ = store_error_.empty() ? finished.store_error : store_error_;
    } else if (finished.result.status == Status::failed) {
      ++progress_.failed_runs;
      events_.warning(fmt::format("{} failed: {}", name, finished.result.error));
    } else if (finished.result.status == Status::done) {
      ++progress_.done_runs;
    } else if (finished.is_in_use) {
      (retries_in_use_ ? elsewhere_ : in_use_).push_back(run);
      progress_.runs_elsewhere = elsewhere_.size();
    }
    results_[run] = std::move(finished.result);
    tables_stale_ = true;
  }

  /// Takes over what other processes have done meanwhile.
  void look_elsewhere() {
    std::erase_if(elsewhere_, [this](std::size_t run) {
      const auto earlier = take_earlier(run);
      return earlier && earlier->is_reusable;
    });
    progress_.runs_elsewhere = elsewhere_.size();
  }

  void tell_shares(const std::vector<std::size_t>& runs) const {
    if (runs.size() > 1) {
      const auto [least, most] = std::ranges::minmax_element(runs);
      events_.message(fmt::format("{} ranks, with {} to {} runs each", runs.size(), *least, *most));
    }
  }

  void show_progress() {
    const std::size_t ended =
        progress_.done_runs + progress_.failed_runs + progress_.runs_elsewhere;
    const auto executed = static_cast<double>(ended - progress_.reused_runs);
    if (executed > 0) {
      progress_.runs_per_second = executed / seconds_since(start_);
      progress_.seconds_left =
          static_cast<double>(progress_.total_runs - ended) / progress_.runs_per_second;
    }
    if (events_.progress) {
      progress_.running.clear();
      {
        const std::lock_guard lock(mutex_);
        for (const auto& [run, progress] : under_way_) {
          progress_.running.push_back({plan_.run_name(run), progress});
        }
      }
      events_.progress(progress_);
    }
  }

  void remove_means_but(const std::vector<NamedTable>& means) const {
    for (const std::string& name : files_.listed_files()) {
      const auto file_of = [](const NamedTable& table) { return store::table_name(table.name); };
      if (name.starts_with("mean-") && std::ranges::count(means, name, file_of) == 0) {
        files_.remove(name);
      }
    }
  }

  /// Of finished runs, one for each set of units; that of runs without any comes last.
  std::vector<record::KnownQuantities> known_quantities_by_units() const {
    std::map<std::string, store::RunSummary, std::greater<>> by_units;
    for (const RunResult& result : results_) {
      if (result.status == Status::done) {
        const auto& units = result.summary.units;
        by_units.try_emplace(units ? units->time_unit + (units->site_mass ? ", kg" : "") : "",
                             result.summary);
      }
    }
    if (by_units.empty()) {
      by_units.emplace();
    }
    std::vector<record::KnownQuantities> all;
    for (const auto& [units, summary] : by_units) {
      all.push_back(record::known_quantities(summary));
      all.back().kind = record::KnownQuantities::Kind::sweep;
    }
    return all;
  }

  void write_tables(const std::vector<NamedTable>& means = {}) {
    const std::vector<NamedTable> tables = {runs_table(plan_, results_),
                                            measures_table(plan_, results_)};
    const std::vector<record::KnownQuantities> known = known_quantities_by_units();
    std::vector<store::TableSummary> summaries;
    for (const auto* list : {&tables, &means}) {
      for (const auto& [name, table] : *list) {
        files_.write(store::table_name(name), table.to_csv());
        summaries.emplace_back(name,
                               record::sweep_column_summaries(name, table.column_names(), known));
      }
    }
    files_.write(kRequestFile,
                 to_json(plan_, summaries,
                         record::sweep_column_summaries("", record::sweep_measure_names(), known)));
  }

  /// Every so often, and never for more than a small part of the time.
  void refresh_tables() {
    constexpr std::chrono::seconds kInterval(5);
    constexpr int kShare = 20;  // writing takes a 20th of the time at most
    const Clock::time_point now = Clock::now();
    if (options_.part || !tables_stale_ || now < tables_due_) {
      return;
    }
    write_tables();
    tables_stale_ = false;
    tables_due_ =
        Clock::now() + std::max<Clock::duration>(kInterval, kShare * (Clock::now() - now));
  }

  void write_overview() {
    const auto image = overview_image(plan_, results_, files_.path());
    if (!image) {
      return;
    }
    files_.write(kOverview, image::encode_png(
                                *image, {{"Title", plan_.title()},
                                         {"Software", fmt::format("clca {}", store::version())}}));
    const std::size_t shown = overview_runs(plan_).runs.size();
    if (shown < progress_.total_runs) {
      events_.message(fmt::format("the overview shows {} of {} runs", shown, progress_.total_runs));
    }
  }

  const Plan& plan_;
  const Options& options_;
  const Events& events_;
  tasks::OneRank alone_;  // for ranks_, where none are given
  tasks::Ranks& ranks_;
  store::OutputFolder files_;
  std::optional<store::FolderLock> lock_;
  std::vector<std::size_t> runs_;       // to be done, of the plan
  std::size_t replaced_runs_ = 0;       // of these, finished ones of other settings
  std::vector<RunResult> results_;      // in the order of the plan
  std::vector<std::size_t> in_use_;     // by other processes, to be tried again
  bool retries_in_use_ = false;         // those have been queued again
  std::vector<std::size_t> elsewhere_;  // under way in other processes
  Progress progress_;
  std::mutex mutex_;                                // of under_way_
  std::map<std::size_t, run::Progress> under_way_;  // in threads of this process
  std::string store_error_;                         // the first
  Clock::time_point start_ = Clock::now();
  Clock::time_point tables_due_ = Clock::now();
  bool tables_stale_ = true;
};

}  // namespace

Progress execute(const Plan& plan, const Options& options, const Events& events) {
  prepare_drawing(plan);
  return Sweep(plan, options, events).execute();
}

void work_for_rank_0(const Plan& plan, const Options& options) {
  prepare_drawing(plan);
  options.ranks->begin(work_description(plan, options));
  while (const auto work = options.ranks->wait_for_work(options.stop_signal)) {
    const auto runs = Json::from_cbor(*work).get<std::vector<std::size_t>>();
    const std::size_t jobs = std::min(runs.size(), static_cast<std::size_t>(options.jobs));
    const auto execute_one = [&](std::size_t run, const std::atomic<int>& stop) {
      return to_bytes(execute_run(plan.scene(run), run_folder(options.folder, plan.run_name(run)),
                                  options, pictures_of(plan, options, run), &stop, {}));
    };
    tasks::Pool<tasks::Bytes> pool(jobs, *options.ranks, runs, {.carry_out = execute_one},
                                   options.stop_signal);
    tasks::send_results(pool, *options.ranks);
  }
}

}  // namespace clca::sweep
