// Sweeps: many runs.

#include "clca/sweep/sweep.hpp"

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "clca/run/setup.hpp"
#include "python/interrupt.hpp"
#include "python/scene.hpp"

namespace clca::python {

namespace {

using Values = std::vector<std::string>;
/// Keys that vary together, and rows of their values.
using VariedKeys = std::pair<Values, std::vector<Values>>;

/// What the command refuses where it reads the text of options.
void check(const std::vector<VariedKeys>& varied, const std::vector<std::uint64_t>& seeds) {
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

sweep::Plan plan_of(const std::string& source, const std::optional<std::string>& text,
                    const std::vector<scene::Override>& overrides,
                    const std::vector<VariedKeys>& varied, std::vector<std::uint64_t> seeds,
                    Interrupt& interrupt) {
  check(varied, seeds);
  std::ranges::sort(seeds);
  sweep::Request request = {.scene = text ? source : run::scene_file(source),
                            .overrides = overrides,
                            .variations = {},
                            .seeds = std::move(seeds),
                            .text = text};
  for (const auto& [keys, rows] : varied) {
    request.variations.push_back({.keys = keys, .rows = rows});
  }
  return sweep::plan(std::move(request), run::default_memory_limit(), [&] { interrupt.check(); });
}

/// Its folder.
std::filesystem::path sweep_scene(const std::string& source, const std::optional<std::string>& text,
                                  const std::vector<scene::Override>& overrides,
                                  const std::vector<VariedKeys>& varied,
                                  const std::vector<std::uint64_t>& seeds,
                                  const std::optional<std::filesystem::path>& output,
                                  const std::optional<int>& jobs, const py::object& report) {
  Interrupt interrupt;
  Warnings warnings;
  sweep::Plan plan;
  std::filesystem::path folder;
  const bool is_absolute = output && output->is_absolute();
  const std::filesystem::path here =
      is_absolute ? std::filesystem::path() : std::filesystem::current_path();
  interrupt.during([&] {
    plan = plan_of(source, text, overrides, varied, seeds, interrupt);
    folder = here / output.value_or("renders/" + plan.variants.front().scene.name + "-sweep");
    const double memory = run::default_memory_limit();
    const int fitting = sweep::fitting_jobs(plan, jobs.value_or(run::machine_threads()), memory,
                                            [&] { interrupt.check(); });
    sweep::execute(plan,
                   {.folder = folder,
                    .jobs = fitting,
                    .max_bytes = memory / fitting,
                    .stop = interrupt.stop()},
                   {.progress =
                        [&](const sweep::Progress& progress) {
                          interrupt.look([&] {
                            if (!report.is_none()) {
                              report("", progress.done + progress.failed, progress.runs,
                                     progress.seconds_left);
                            }
                          });
                        },
                    .warning = warnings.take()});
  });
  warnings.issue();
  return folder;
}

}  // namespace

void add_sweep(py::module_& module) {
  module.def("sweep", sweep_scene);
}

}  // namespace clca::python
