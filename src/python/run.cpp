// Runs of scenes, stopped as Python's signal handlers say.

#include "clca/run/run.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "clca/run/load.hpp"
#include "python/interrupt.hpp"
#include "python/scene.hpp"

namespace clca::python {

namespace {

struct Done {
  std::string status;
  std::filesystem::path folder;
};

/// Calls `run_it` without the interpreter. Its warnings become those of Python.
template <class RunIt>
Done carry_out(run::RunOptions options, RunIt run_it) {
  Interrupt interrupt;
  Warnings warnings;
  Done done;
  {
    const py::gil_scoped_release free;
    options.stop = interrupt.stop();
    run::RunEvents events;
    events.progress = [&](const run::Progress& /*progress*/) { interrupt.look(); };
    events.gas_progress = [&](const run::GasProgress& /*progress*/) { interrupt.look(); };
    events.folder = [&](const std::filesystem::path& folder) { done.folder = folder; };
    events.warning = warnings.take();
    done.status = run_it(options, events).status;
  }
  interrupt.raise();
  warnings.issue();
  return done;
}

/// As of the commands.
int default_threads(const scene::AnyScene& scene) {
  return std::holds_alternative<scene::BoltzmannScene>(scene) ? run::machine_threads() : 1;
}

std::filesystem::path run_scene(const LoadedScene& loaded,
                                const std::optional<std::filesystem::path>& output,
                                std::optional<int> threads, bool keep, bool overwrite) {
  const auto run_it = [&](const auto& scene) {
    run::RunOptions options = {.folder = output.value_or("renders/" + scene.name),
                               .threads = threads.value_or(default_threads(loaded.scene)),
                               .overwrite = overwrite,
                               .keep = keep};
    if (!keep) {
      run::check_output(loaded.file, options.folder);
    }
    return carry_out(std::move(options),
                     [&](const run::RunOptions& chosen, const run::RunEvents& events) {
                       return run::run(scene, chosen, events);
                     })
        .folder;
  };
  return std::visit(run_it, loaded.scene);
}

void resume(const std::filesystem::path& folder, const std::optional<std::string>& until,
            std::optional<int> threads) {
  run::SavedRun saved = run::load_run(folder, run::default_memory_limit(), until);
  const int chosen = threads.value_or(default_threads(saved.scene));
  carry_out({.threads = chosen}, [&](const run::RunOptions& options, const run::RunEvents& events) {
    return run::resume(std::move(saved), options, events);
  });
}

}  // namespace

void add_run(py::module_& module) {
  module.def("run", run_scene);
  module.def("resume", resume);
  module.def("version", run::version);
}

}  // namespace clca::python
