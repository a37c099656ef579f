#pragma once
// Options that several commands have.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clca/run/setup.hpp"
#include "clca/scene/parse.hpp"

namespace clca::cli {

using run::check_memory;
using run::kMebibyte;
using run::machine_threads;

struct SceneOptions {
  std::string file;
  std::vector<std::string> overrides;
  std::optional<std::string> begin;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> frames_every;  ///< 0: no pictures, but their settings
  std::optional<std::uint64_t> memory_limit;  ///< bytes
};

/// What may stand in place of a word that has been begun.
struct Candidate {
  std::string text;
  std::string about = {};
};

/// Name and title of each scene that comes with the program. Throws scene::SceneError.
std::vector<Candidate> scenes_of_program();

/// Takes a file, or the name of a scene of the program in place of its file.
CLI::Validator scene_name_validator();

void add_scene_options(CLI::App* command, SceneOptions& options);
/// SCENE, --set and --begin only.
void add_scene_and_set(CLI::App* command, SceneOptions& options);
void add_set(CLI::App* command, SceneOptions& options, const std::string& what);
void add_memory_limit(CLI::App* command, SceneOptions& options,
                      const std::string& what = "Refuse scenes that need more memory");

/// --begin, --set and its short forms.
std::vector<scene::Override> overrides_of(const SceneOptions& options);

/// Memory limit in bytes.
double memory_limit(const SceneOptions& options);

/// The scene with the options applied. Throws scene::SceneError, also when it would need more
/// memory than the limit; that of a Boltzmann run depends on its threads.
scene::AnyScene load_any_scene(const SceneOptions& options, int threads = machine_threads());

}  // namespace clca::cli
