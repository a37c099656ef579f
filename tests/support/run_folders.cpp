#include "support/run_folders.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "clca/model/initial_state.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "support/difference.hpp"
#include "support/runs.hpp"

namespace clca::testing {

namespace {

namespace fs = std::filesystem;

std::set<std::string> files_of(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && !name.starts_with(".clca") && !name.starts_with("checkpoint") &&
        name != "log.txt" && !name.starts_with("trajectory")) {
      files.insert(name);
    }
  }
  return files;
}

nlohmann::json timeless(const fs::path& file) {
  nlohmann::json json = nlohmann::json::parse(bytes_of(file));
  for (const char* key : {"wall_seconds", "step_seconds", "particle_updates_per_second",
                          "collisions_per_second", "threads"}) {
    json.erase(key);
  }
  return json;
}

std::string difference_of_trajectories(const fs::path& a, const fs::path& b) {
  constexpr double kMuch = 1e9;
  if (fs::exists(a / "trajectory.h5") != fs::exists(b / "trajectory.h5")) {
    return "only one has a trajectory";
  }
  if (!fs::exists(a / "trajectory.h5")) {
    return "";
  }
  const scene::Scene scene = scene::parse_file(a / "scene.yaml");
  const grains::State fixed = model::initial_state(scene);
  const store::Trajectory first(a, scene, fixed, kMuch);
  const store::Trajectory second(b, scene, fixed, kMuch);
  if (first.frames().size() != second.frames().size()) {
    return "trajectories of " + std::to_string(first.frames().size()) + " and " +
           std::to_string(second.frames().size()) + " frames";
  }
  for (std::size_t frame = 0; frame < first.frames().size(); ++frame) {
    if (!(first.state(frame) == second.state(frame)) ||
        first.frames()[frame].stage != second.frames()[frame].stage) {
      return "frame " + std::to_string(frame) +
             " of the trajectory: " + difference(first.state(frame), second.state(frame));
    }
  }
  return "";
}

}  // namespace

std::string difference_of_runs(const fs::path& a, const fs::path& b) {
  const auto files = files_of(a);
  if (files != files_of(b)) {
    std::vector<std::string> odd;
    const auto others = files_of(b);
    std::set_symmetric_difference(files.begin(), files.end(), others.begin(), others.end(),
                                  std::back_inserter(odd));
    return "only one has " + odd.front();
  }
  for (const std::string& name : files) {
    const bool same = name == "run.json" ? timeless(a / name) == timeless(b / name)
                                         : bytes_of(a / name) == bytes_of(b / name);
    if (!same) {
      return name;
    }
  }
  return difference_of_trajectories(a, b);
}

}  // namespace clca::testing
