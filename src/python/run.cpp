// Runs of scenes, stopped as Python's signal handlers say.

#include "clca/run/run.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "clca/record/provenance.hpp"
#include "clca/run/setup.hpp"
#include "python/interrupt.hpp"
#include "python/scene.hpp"

namespace clca::python {

namespace {

/// Calls `run_it` without the interpreter; the folder that it names. Its warnings become those of
/// Python. `report`: None, or called as in _clca.pyi.
template <class RunIt>
std::filesystem::path carry_out(run::RunOptions options, const py::object& report, RunIt run_it) {
  Interrupt interrupt;
  Warnings warnings;
  std::filesystem::path used;
  interrupt.during([&] {
    options.stop = interrupt.stop();
    run::RunEvents events;
    const auto look = [&](const auto& progress, std::uint64_t done,
                          std::optional<std::uint64_t> of) {
      interrupt.look([&] {
        if (!report.is_none()) {
          report(progress.stage, done, of, progress.seconds_left);
        }
      });
    };
    events.progress = [&](const run::Progress& progress) { look(progress, progress.step, {}); };
    events.gas_progress = [&](const run::GasProgress& progress) {
      look(progress, progress.gases_done, progress.gases);
    };
    events.folder = [&](const std::filesystem::path& folder) { used = folder; };
    events.warning = warnings.take();
    run_it(options, events);
  });
  warnings.issue();
  return used;
}

/// As of the commands.
int default_threads(const scene::AnyScene& scene) {
  return std::holds_alternative<scene::BoltzmannScene>(scene) ? run::machine_threads() : 1;
}

std::filesystem::path run_scene(const LoadedScene& loaded,
                                const std::optional<std::filesystem::path>& output,
                                std::optional<int> threads, bool keep, bool overwrite,
                                const py::object& report) {
  const auto run_it = [&](const auto& scene) {
    // The current folder may change while the run goes on.
    const std::filesystem::path folder = output.value_or("renders/" + scene.name);
    run::RunOptions options = {.folder = std::filesystem::absolute(folder),
                               .threads = threads.value_or(default_threads(loaded.scene)),
                               .overwrite = overwrite,
                               .keep = keep};
    if (!keep) {
      run::check_output(loaded.place(), options.folder);
    }
    return carry_out(std::move(options), report,
                     [&](const run::RunOptions& chosen, const run::RunEvents& events) {
                       return run::run(scene, chosen, events);
                     });
  };
  return std::visit(run_it, loaded.scene);
}

void resume(const std::filesystem::path& folder, const std::optional<std::string>& until,
            std::optional<int> threads, const py::object& report) {
  const double limit = run::default_memory_limit();
  run::SavedRun saved = run::load_run(folder, limit, until);
  if (saved.finished) {
    return;
  }
  const int chosen = threads.value_or(default_threads(saved.scene));
  run::check_memory(saved.scene, limit, chosen);
  carry_out({.threads = chosen}, report,
            [&](const run::RunOptions& options, const run::RunEvents& events) {
              return run::resume(std::move(saved), options, events);
            });
}

}  // namespace

void add_run(py::module_& module) {
  module.def("run", run_scene);
  module.def("resume", resume);
  module.def("version", record::version);
}

}  // namespace clca::python
