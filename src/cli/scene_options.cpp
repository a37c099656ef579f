#include "cli/scene_options.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "clca/process/data_folder.hpp"
#include "cli/option_values.hpp"

namespace clca::cli {

namespace {

/// Sets the key begin.run to a folder; a relative path starts at the current folder.
scene::Override override_of_begin(const std::string& folder) {
  std::string quoted;
  for (const char letter : std::filesystem::absolute(folder).string()) {
    quoted += letter == '\'' ? "''" : std::string(1, letter);
  }
  return fmt::format("begin={{run: '{}'}}", quoted);
}

std::string standard_input() {
  constexpr auto kMaxSize = static_cast<std::streamsize>(document::kMaxBytes);
  std::string text(document::kMaxBytes + 1, '\0');
  std::cin.read(text.data(), kMaxSize + 1);
  if (std::cin.gcount() > kMaxSize || std::cin.bad()) {
    throw scene::SceneError(
        fmt::format("stdin:1:1: error: standard input cannot be read or is larger than {} MiB",
                    document::kMaxBytes >> 20U));
  }
  text.resize(static_cast<std::size_t>(std::cin.gcount()));
  return text;
}

}  // namespace

std::vector<scene::Override> overrides_of(const SceneOptions& options) {
  std::vector<scene::Override> overrides;
  if (options.begin) {  // first, so that --set can add the step
    overrides.push_back(override_of_begin(*options.begin));
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
                              : run::default_memory_limit();
}

std::vector<Candidate> scenes_of_program() {
  std::vector<Candidate> scenes;
  for (const auto& [name, file] : process::data_files("scenes", ".yaml")) {
    const auto title = [](const auto& scene) { return scene.title; };
    scenes.push_back({name, std::visit(title, scene::parse_any_file(file))});
  }
  return scenes;
}

CLI::Validator scene_name_validator() {
  return {[](std::string& name) {
            name = run::scene_file(name);
            return std::string();
          },
          ""};
}

void add_set(CLI::App* command, SceneOptions& options, const std::string& what) {
  add_option(command, "--set", options.overrides, "KEY=VALUE", what, assignment("KEY=VALUE"))
      ->allow_extra_args(false);
}

void add_memory_limit(CLI::App* command, SceneOptions& options, const std::string& what) {
  add_option(command, "--memory-limit", options.memory_limit, "SIZE",
             what + ", such as 4GiB [80 % of the free memory]", byte_size());
}

void add_scene_and_set(CLI::App* command, SceneOptions& options) {
  add_option(command, "SCENE", options.file, "",
             "Scene file (YAML), - for standard input, or the name of a scene of this program",
             scene_name_validator())
      ->required();
  add_set(command, options,
          "Set KEY of the scene to VALUE (YAML), such as rules.inertia=0 or "
          "stages.flow.max_steps=500; may be repeated");
  add_option(command, "--begin", options.begin, "FOLDER",
             "Begin with the last state of the run in this folder, in place of the scene's begin");
}

void add_scene_options(CLI::App* command, SceneOptions& options) {
  add_scene_and_set(command, options);
  add_option(command, "--seed", options.seed, "",
             "Seed of the random draws, in place of the scene's", whole_number());
  add_option(command, "--frames-every", options.frames_every, "",
             "A picture every N steps; 0: no pictures for now, with their settings kept for "
             "clca render",
             whole_number());
  add_memory_limit(command, options);
}

scene::AnyScene load_any_scene(const SceneOptions& options, int threads) {
  scene::AnyScene scene = options.file == "-"
                              ? scene::parse_any(standard_input(), "stdin", overrides_of(options))
                              : scene::parse_any_file(options.file, overrides_of(options));
  run::complete(scene, options.file, memory_limit(options), threads);
  return scene;
}

}  // namespace clca::cli
