#include "cli/scene_options.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <system_error>
#include <thread>

#include "clca/process/data_folder.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/resolve.hpp"
#include "clca/text/message.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"

namespace clca::cli {

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

/// A path on the command line begins at the current folder.
scene::Override begin_override(const std::string& folder) {
  std::string quoted;
  for (const char letter : std::filesystem::absolute(folder).string()) {
    quoted += letter == '\'' ? "''" : std::string(1, letter);
  }
  return fmt::format("begin={{run: '{}'}}", quoted);
}

/// The scene with the options applied. Throws scene::SceneError if it does not fit into memory.
scene::Scene fitting(scene::Scene scene, const SceneOptions& options) {
  run::find_begin(scene, memory_limit(options));
  scene::check_resolved(scene::to_yaml(scene), options.file);
  check_memory(scene, memory_limit(options));
  return scene;
}

/// The file of an installed scene if `name` is the name of one and of no file. Throws
/// scene::SceneError for what may be meant as one.
std::string find_scene(const std::string& name) {
  std::error_code error;
  if (name.find_first_of("/.") != std::string::npos || std::filesystem::exists(name, error)) {
    return name;
  }
  std::vector<std::string> known;
  for (const std::filesystem::path& folder : process::data_folders("scenes")) {
    for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
         it.increment(error)) {
      if (it->path().extension() != ".yaml") {
        continue;
      }
      known.push_back(it->path().stem().string());
      if (known.back() == name) {
        return it->path().string();
      }
    }
  }
  std::sort(known.begin(), known.end());
  const std::vector<std::string_view> names(known.begin(), known.end());
  if (text::nearest(name, names)) {
    throw scene::SceneError(
        fmt::format("{}:1:1: error: cannot read the file: No such file or directory{}",
                    text::printable(name), text::suggestion(name, names)));
  }
  return name;
}

std::string standard_input() {
  constexpr auto kMaxSize = static_cast<std::streamsize>(scene::kMaxSceneBytes);
  std::string text(scene::kMaxSceneBytes + 1, '\0');
  std::cin.read(text.data(), kMaxSize + 1);
  if (std::cin.gcount() > kMaxSize || std::cin.bad()) {
    throw scene::SceneError(
        fmt::format("stdin:1:1: error: standard input cannot be read or is larger than {} MiB",
                    scene::kMaxSceneBytes >> 20U));
  }
  text.resize(static_cast<std::size_t>(std::cin.gcount()));
  return text;
}

scene::AnyScene parsed(const SceneOptions& options) {
  return options.file == "-" ? scene::parse_any(standard_input(), "stdin", overrides_of(options))
                             : scene::parse_any_file(options.file, overrides_of(options));
}

}  // namespace

std::vector<scene::Override> overrides_of(const SceneOptions& options) {
  std::vector<scene::Override> overrides;
  if (options.begin) {  // first, so that --set can add the step
    overrides.push_back(begin_override(*options.begin));
  }
  overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
  if (options.seed) {
    overrides.push_back(fmt::format("seed={}", *options.seed));
  }
  if (options.frames_every.value_or(0) > 0) {
    overrides.push_back(fmt::format("output.frames.every={}", *options.frames_every));
  }
  return overrides;
}

double memory_limit(const SceneOptions& options) {
  return options.memory_limit ? static_cast<double>(*options.memory_limit)
                              : kShareOfMemory * available_bytes();
}

void check_memory(const scene::Scene& scene, double limit) {
  const scene::Size size = scene::size_of(scene);
  if (size.bytes > limit) {
    throw scene::SceneError(fmt::format(
        "{}: error: the scene needs about {:.0f} MiB of memory for {} x {} sites and {} particles, "
        "more than the limit of {:.0f} MiB; make the box smaller or raise --memory-limit",
        scene.box.location, size.bytes / kMebibyte, size.columns, size.rows, size.particles,
        limit / kMebibyte));
  }
}

void check_memory(const scene::BoltzmannScene& scene, double limit, int threads) {
  const double bytes = scene::bytes_of(scene, threads);
  if (bytes > limit) {
    throw scene::SceneError(fmt::format(
        "{}: error: the scene needs about {:.0f} MiB of memory for {} particles on {} threads, "
        "more than the limit of {:.0f} MiB; take fewer particles or threads, write fewer rows and "
        "bins, or raise --memory-limit",
        scene.location, bytes / kMebibyte, scene.particles, threads, limit / kMebibyte));
  }
}

void add_scene_and_set(Command& command, SceneOptions& options) {
  command
      .option("SCENE", &options.file,
              "Scene file (YAML), - for standard input, or the name of a scene of this program")
      .required()
      .values({[](std::string& name) {
                 name = find_scene(name);
                 return std::string();
               },
               ""});
  command
      .option("--set", &options.overrides,
              "Set KEY of the scene to VALUE (YAML), such as rules.inertia=0 or "
              "stages.flow.max_steps=500; may be repeated")
      .type("KEY=VALUE")
      .values(assignment("KEY=VALUE"))
      .one_value();
  command
      .option("--begin", &options.begin,
              "Begin with the last state of the run in this folder, in place of the scene's begin")
      .type("FOLDER");
}

void add_memory_limit(Command& command, SceneOptions& options) {
  command
      .option("--memory-limit", &options.memory_limit,
              "Refuse scenes that need more memory, such as 4GiB [80 % of the free memory]")
      .type("SIZE")
      .values(byte_size());
}

void add_scene_options(Command& command, SceneOptions& options) {
  add_scene_and_set(command, options);
  command.option("--seed", &options.seed, "Seed of the random draws, in place of the scene's")
      .values(whole_number());
  command
      .option("--frames-every", &options.frames_every,
              "A picture every N steps; 0: no pictures for now, with their settings kept for clca "
              "render")
      .values(whole_number());
  add_memory_limit(command, options);
}

int machine_threads() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

scene::AnyScene load_any_scene(const SceneOptions& options, int threads) {
  scene::AnyScene scene = parsed(options);
  if (auto* automaton = std::get_if<scene::Scene>(&scene)) {
    return fitting(std::move(*automaton), options);
  }
  scene::check_resolved(scene::to_yaml(std::get<scene::BoltzmannScene>(scene)), options.file);
  check_memory(std::get<scene::BoltzmannScene>(scene), memory_limit(options), threads);
  return scene;
}

}  // namespace clca::cli
