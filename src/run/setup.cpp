#include "clca/run/setup.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <system_error>
#include <thread>

#include "clca/process/data_folder.hpp"
#include "clca/record/quantity.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/text/message.hpp"
#include "drawing/internal/frame_painter.hpp"
#include "record/internal/observer.hpp"

namespace clca::run {

namespace {

constexpr double kShareOfMemory = 0.8;

/// Available memory without swapping; file caches count as free.
double available_bytes() {
  std::ifstream meminfo("/proc/meminfo");
  std::string key;
  for (double kibibytes = 0; meminfo >> key >> kibibytes;) {
    if (key == "MemAvailable:") {
      return 1024 * kibibytes;
    }
    meminfo.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  const auto pages = static_cast<double>(::sysconf(_SC_AVPHYS_PAGES));
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

std::string scene_file(const std::string& name) {
  std::error_code error;
  const std::filesystem::path path(name);
  const bool is_as_in_documents = path == "scenes" / path.stem().replace_extension(".yaml");
  if ((name.find_first_of("/.") != std::string::npos && !is_as_in_documents) ||
      std::filesystem::exists(path, error)) {
    return name;
  }
  const auto scenes = process::data_files("scenes", ".yaml");
  if (const auto scene = scenes.find(is_as_in_documents ? path.stem().string() : name);
      scene != scenes.end()) {
    return scene->second.string();
  }
  std::vector<std::string_view> names;
  for (const auto& scene : scenes) {
    names.push_back(scene.first);
  }
  if (text::nearest_name(name, names)) {
    throw scene::SceneError(
        fmt::format("{}:1:1: error: cannot read the file: No such file or directory{}",
                    text::printable(name), text::suggestion(name, names)));
  }
  return name;
}

int machine_thread_count() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

double default_memory_limit() {
  return kShareOfMemory * available_bytes();
}

double estimated_run_bytes(const scene::Scene& scene) {
  const scene::ModelSize size = scene::model_size(scene);
  const auto particles = static_cast<double>(size.max_particles);
  return size.memory_bytes + model::checkpoint_bytes(scene, particles) +
         record::observer_bytes(scene, particles) + drawing::picture_memory_bytes(scene, particles);
}

void check_memory(const scene::Scene& scene, double limit) {
  if (const double bytes = estimated_run_bytes(scene); bytes > limit) {
    const scene::ModelSize size = scene::model_size(scene);
    const bool pictures_are_too_large =
        bytes - drawing::picture_memory_bytes(scene, static_cast<double>(size.max_particles)) <=
        limit;
    throw scene::SceneError(fmt::format(
        "{}: error: the scene needs about {:.0f} MiB of memory for {} x {} sites and {} particles, "
        "more than the limit of {:g} MiB; make the {} smaller or raise --memory-limit",
        pictures_are_too_large ? scene.output.frames->location : scene.box.location,
        bytes / kMebibyte, size.columns, size.rows, size.max_particles, limit / kMebibyte,
        pictures_are_too_large ? "pictures" : "box"));
  }
}

void check_memory(const scene::AnyScene& scene, double limit, int threads) {
  if (const auto* grains = std::get_if<scene::Scene>(&scene)) {
    check_memory(*grains, limit);
    return;
  }
  const auto& gas = std::get<scene::BoltzmannScene>(scene);
  if (const double bytes = scene::gas_run_bytes(gas, threads); bytes > limit) {
    throw scene::SceneError(fmt::format(
        "{}: error: the scene needs about {:.0f} MiB of memory for {} particles on {} threads, "
        "more than the limit of {:g} MiB; take fewer particles or threads, write fewer rows and "
        "bins, or raise --memory-limit",
        gas.location, bytes / kMebibyte, gas.particles, threads, limit / kMebibyte));
  }
}

void prepare_scene(scene::AnyScene& scene, const std::string& file, double limit, int threads) {
  if (auto* grains = std::get_if<scene::Scene>(&scene)) {
    record::check_derived(*grains);
    resolve_begin(*grains, limit);
  }
  scene::check_resolved_size(
      std::visit([](const auto& held) { return scene::to_yaml(held); }, scene), file);
  check_memory(scene, limit, threads);
}

void check_output_folder(const std::string& file, const std::filesystem::path& folder) {
  std::error_code unknown;
  if (std::filesystem::equivalent(file, folder / store::kSceneFile, unknown)) {
    throw scene::SceneError(
        fmt::format("{}: error: the run would replace this file; run in another folder, or with "
                    "--keep",
                    file));
  }
}

}  // namespace clca::run
