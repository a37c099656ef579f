// Runs and sweeps of scenes, and pictures of their folders, stopped as Python's signal handlers
// say.

#include "clca/run/run.hpp"

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "clca/drawing/redraw.hpp"
#include "clca/image/png.hpp"
#include "clca/run/setup.hpp"
#include "clca/store/summary.hpp"
#include "clca/sweep/sweep.hpp"
#include "python/binding.hpp"
#include "python/interpreter.hpp"

namespace clca::python {

namespace {

namespace fs = std::filesystem;
using Values = std::vector<std::string>;
/// Keys that vary together, and rows of their values.
using VariedKeys = std::pair<Values, std::vector<Values>>;

/// What runs tell while the interpreter is free: how far they are, and warnings.
class Reporter : public SignalWatch {
 public:
  /// `report`: None, or called as in _clca.pyi.
  explicit Reporter(const py::object& report) : report_(report) {}

  void report(const std::string& stage, std::uint64_t done, std::optional<std::uint64_t> of,
              std::optional<double> seconds_left) {
    check_signals([&] {
      if (!report_.is_none()) {
        report_(stage, done, of, seconds_left);
      }
    });
  }
  std::function<void(const std::string&)> warning() {
    return [this](const std::string& text) { warnings_.push_back(text); };
  }
  /// SignalWatch::run_without_interpreter(), then gives Python the warnings.
  template <class DoIt>
  void run_without_interpreter(DoIt do_it) {
    SignalWatch::run_without_interpreter(do_it);
    for (const std::string& text : warnings_) {
      if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 2) != 0) {
        throw py::error_already_set();
      }
    }
  }

 private:
  const py::object& report_;
  std::vector<std::string> warnings_;
};

/// Calls `run_it`; the folder that it names.
template <class RunIt>
fs::path carry_out(run::RunOptions options, const py::object& report, RunIt run_it) {
  Reporter work(report);
  fs::path used;
  work.run_without_interpreter([&] {
    options.stop_signal = work.stop_signal();
    run::RunEvents events;
    events.progress = [&](const run::Progress& now) {
      work.report(now.stage, now.step, {}, now.seconds_left);
    };
    events.gas_progress = [&](const run::GasProgress& now) {
      work.report(now.stage, now.done_gases, now.gas_count, now.seconds_left);
    };
    events.folder_known = [&](const fs::path& folder) { used = folder; };
    events.warning = work.warning();
    run_it(options, events);
  });
  return used;
}

/// As of the commands.
int default_threads(const scene::AnyScene& scene) {
  return std::holds_alternative<scene::BoltzmannScene>(scene) ? run::machine_thread_count() : 1;
}

fs::path run_scene(const LoadedScene& loaded, const fs::path& folder, std::optional<int> threads,
                   bool keep, bool overwrite, const py::object& report) {
  if (!keep) {
    run::check_output_folder(loaded.usable_path(), folder);
  }
  return carry_out({.folder = folder,
                    .threads = threads.value_or(default_threads(loaded.scene)),
                    .replace_interrupted = overwrite,
                    .keep_earlier_run = keep},
                   report, [&](const run::RunOptions& options, const run::RunEvents& events) {
                     std::visit([&](const auto& scene) { run::run(scene, options, events); },
                                loaded.scene);
                   });
}

void resume(const fs::path& folder, const std::optional<std::string>& until,
            std::optional<int> threads, const py::object& report) {
  const double limit = run::default_memory_limit();
  run::SavedRun saved = run::load_run(folder, limit, until);
  if (saved.finished_summary) {
    return;
  }
  const int chosen = threads.value_or(default_threads(saved.scene));
  run::check_memory(saved.scene, limit, chosen);
  carry_out({.threads = chosen}, report,
            [&](const run::RunOptions& options, const run::RunEvents& events) {
              run::resume(std::move(saved), options, events);
            });
}

/// What the command refuses where it reads the text of options.
void check_variations_and_seeds(const std::vector<VariedKeys>& varied,
                                const std::vector<std::uint64_t>& seeds) {
  if (seeds.empty() || std::set(seeds.begin(), seeds.end()).size() < seeds.size()) {
    throw std::invalid_argument("expected seeds, each once");
  }
  for (const auto& [keys, rows] : varied) {
    std::set<Values> known;
    for (Values row : rows) {
      if (row.size() != keys.size()) {
        throw std::invalid_argument(fmt::format("{}: expected {} values, found {}",
                                                fmt::join(keys, ", "), keys.size(), row.size()));
      }
      std::ranges::transform(row, row.begin(), document::canonical_value);
      known.insert(std::move(row));
    }
    if (rows.empty() || known.size() < rows.size()) {
      throw std::invalid_argument(
          fmt::format("{}: expected values, each once", fmt::join(keys, ", ")));
    }
  }
}

void sweep_scene(const std::string& source, const std::optional<std::string>& text,
                 const std::vector<std::string>& overrides, const std::vector<VariedKeys>& varied,
                 std::vector<std::uint64_t> seeds, const fs::path& folder,
                 const std::optional<int>& jobs, const py::object& report) {
  Reporter work(report);
  work.run_without_interpreter([&] {
    check_variations_and_seeds(varied, seeds);
    std::ranges::sort(seeds);
    sweep::Request request = {.scene_file = text ? source : run::scene_file(source),
                              .overrides = {overrides.begin(), overrides.end()},
                              .variations = {},
                              .seeds = std::move(seeds),
                              .scene_text = text};
    for (const auto& [keys, rows] : varied) {
      request.variations.push_back({.keys = keys, .value_rows = rows});
    }
    const double memory = run::default_memory_limit();
    const auto look = [&] { work.throw_if_stopped(); };
    const sweep::Plan plan = sweep::plan(std::move(request), memory, look);
    const int fitting =
        sweep::fitting_jobs(plan, jobs.value_or(run::machine_thread_count()), memory, look);
    sweep::execute(plan,
                   {.folder = folder,
                    .jobs = fitting,
                    .max_bytes = memory / fitting,
                    .stop_signal = work.stop_signal()},
                   {.progress =
                        [&](const sweep::Progress& now) {
                          work.report("", now.done_runs + now.failed_runs, now.total_runs,
                                      now.seconds_left);
                        },
                    .warning = work.warning()});
  });
}

drawing::RunToDraw run_to_draw(const fs::path& folder, const std::vector<std::string>& overrides) {
  drawing::RunToDraw drawn = {
      .scene = drawing::scene_for_drawing(folder, {overrides.begin(), overrides.end()}),
      .run_folder = folder};
  run::check_memory(drawn.scene, run::default_memory_limit());
  return drawn;
}

py::array picture(const fs::path& folder, std::uint64_t step,
                  const std::vector<std::string>& overrides) {
  image::Image image;
  {
    const ReleasedInterpreter free;
    image =
        drawing::picture_of_step(run_to_draw(folder, overrides), step, run::default_memory_limit());
  }
  return pixel_array(image);
}

void movie(const fs::path& folder, const fs::path& file, int frames_per_second,
           std::optional<double> duration, const std::optional<std::string>& stage,
           const std::vector<std::string>& overrides) {
  SignalWatch interrupt;
  interrupt.run_without_interpreter([&] {
    drawing::Redraw redraw({run_to_draw(folder, overrides)},
                           {.movie_file = file,
                            .frames_per_second = frames_per_second,
                            .movie_seconds = duration,
                            .only_stage = stage,
                            .max_bytes = run::default_memory_limit(),
                            .stop_signal = interrupt.stop_signal()});
    drawing::RedrawEvents events;
    events.progress = [&](const drawing::RedrawProgress& /*progress*/) {
      interrupt.check_signals();
    };
    redraw.draw(events);
  });
}

py::bytes png(const py::array_t<std::uint8_t, py::array::c_style>& pixels) {
  if (pixels.ndim() != 3 || pixels.shape(2) != 3) {
    throw std::invalid_argument("expected rows x columns x 3");
  }
  image::Image image(static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)), {});
  if (image.pixels.empty()) {
    throw std::invalid_argument("a picture without pixels is no PNG");
  }
  std::copy_n(pixels.data(), pixels.size(), &image.pixels.data()->red);
  const std::vector<std::uint8_t> bytes = image::encode_png(image, {});
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void add_run(py::module_& module) {
  module.def("run", run_scene);
  module.def("resume", resume);
  module.def("sweep", sweep_scene);
  module.def("picture", picture);
  module.def("movie", movie);
  module.def("png", png);
  module.def("version", store::version);
}

}  // namespace clca::python
