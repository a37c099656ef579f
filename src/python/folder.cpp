// Run folders: summaries, tables and trajectories.

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <mutex>

#include "clca/run/setup.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"
#include "clca/store/trajectory.hpp"
#include "python/arrays.hpp"
#include "python/interpreter.hpp"
#include "python/scene.hpp"

namespace clca::python {

namespace {

namespace fs = std::filesystem;

py::dict summary(const fs::path& folder) {
  const store::RunSummary summary = store::read_summary(folder / store::kSummaryFile);
  py::list stages;
  for (const store::StageSummary& stage : summary.stages) {
    stages.append(py::make_tuple(stage.name, stage.steps, stage.ended,
                                 measures(stage.measures, run::known_quantities(summary)),
                                 stage.notes));
  }
  py::dict result;
  result["kind"] = summary.kind;
  result["scene"] = summary.scene;
  result["title"] = summary.title;
  result["version"] = summary.version;
  result["seed"] = summary.seed;
  result["status"] = summary.status;
  result["particles"] = summary.particles;
  result["steps"] = summary.steps;
  result["state_hash"] = summary.state_hash;
  result["stages"] = stages;
  return result;
}

/// Texts of a table, which anything may have written.
template <class Texts>
py::object texts(const store::ReadTable& table, const Texts& texts) {
  try {
    return py::cast(texts);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_UnicodeDecodeError)) {
      throw;
    }
  }
  throw store::StoreError(
      fmt::format("cannot read {}: a text in it is no UTF-8", table.file.string()));
}

/// An array if all cells are numbers or empty and may be, else a list.
py::object cells_of(const store::ReadTable& table, const std::string& key, bool is_text) {
  if (!is_text) {
    try {
      const std::vector<double> numbers = table.numbers(key);
      return py::array(static_cast<py::ssize_t>(numbers.size()), numbers.data());
    } catch (const store::StoreError&) {  // some are names
    }
  }
  return texts(table, *table.find(key));
}

/// Columns as (key, values, quantity).
/// `run`: the folder of one whose units the table has.
py::list table(const fs::path& folder, const std::string& name, const std::set<std::string>& text,
               const std::optional<fs::path>& run) {
  const store::ReadTable table = store::read_table(folder / store::table_name(name));
  run::KnownQuantities all =
      run ? run::known_quantities(store::read_summary(*run / store::kSummaryFile))
          : run::KnownQuantities();
  if (run != folder) {
    all.of = run::KnownQuantities::Of::sweep;
  }
  py::list columns;
  for (const std::string& key : table.names) {
    columns.append(py::make_tuple(texts(table, key), cells_of(table, key, text.contains(key)),
                                  quantity(key, all)));
  }
  return columns;
}

/// May be used from several threads.
class Trajectory {
 public:
  explicit Trajectory(const fs::path& folder)
      : scene_(scene_of(folder)),
        initial_(run::initial_state(scene_)),
        trajectory_(folder, scene_, initial_, run::default_memory_limit()) {}

  /// (step, stage, particles) of each; a step has one, that of the stage that ends with it.
  py::list frames() const {
    py::list result;
    for (const std::size_t number : numbers_) {
      const store::Trajectory::Frame& frame = trajectory_.frames()[number];
      result.append(py::make_tuple(frame.step, scene_.stages[frame.stage].name, frame.particles));
    }
    return result;
  }

  py::tuple frame(std::size_t number) {
    std::optional<FrameData> data;
    {
      const Released free;
      const std::scoped_lock lock(mutex_);
      const std::size_t in_trajectory = numbers_.at(number);
      const grains::State state = trajectory_.state(in_trajectory);
      data.emplace(scene_, state, trajectory_.contact_frame(in_trajectory));
    }
    return std::move(*data).to_python();
  }

  py::list kinds() const { return python::kinds(scene_, initial_.kinds); }
  py::list walls() const { return python::walls(scene_, initial_); }
  py::dict body_names() const { return python::body_names(scene_); }
  py::dict units() const { return python::units(scene_); }

 private:
  static scene::Scene scene_of(const fs::path& folder) {
    scene::Scene scene = scene::parse_file(folder / store::kSceneFile);
    scene.name = store::read_summary(folder / store::kSummaryFile).scene;
    run::check_memory(scene, run::default_memory_limit());
    return scene;
  }
  static std::vector<std::size_t> first_of_each_step(
      const std::vector<store::Trajectory::Frame>& frames) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (i == 0 || frames[i].step != frames[i - 1].step) {
        numbers.push_back(i);
      }
    }
    return numbers;
  }

  scene::Scene scene_;
  grains::State initial_;
  store::Trajectory trajectory_;
  std::vector<std::size_t> numbers_ = first_of_each_step(trajectory_.frames());
  std::mutex mutex_;
};

}  // namespace

}  // namespace clca::python

template <>
class pybind11::detail::type_caster<clca::python::Trajectory>
    : public clca::python::HeldCaster<clca::python::Trajectory> {};

namespace clca::python {

void add_folder(py::module_& module) {
  module.def("summary", summary);
  module.def("table", table);
  py::class_<Trajectory>(module, "Trajectory")
      .def(py::init<fs::path>(), py::call_guard<Released>())
      .def("frames", &Trajectory::frames)
      .def("frame", &Trajectory::frame)
      .def("_kinds", &Trajectory::kinds)
      .def("_walls", &Trajectory::walls)
      .def("_body_names", &Trajectory::body_names)
      .def("_units", &Trajectory::units);
}

}  // namespace clca::python
