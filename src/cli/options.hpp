#pragma once
// Validators of options (CLI11 alone takes -1 as 2^64 - 1, 010 as 8 and nan as a number), and
// options that several commands have.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "clca/run/setup.hpp"
#include "clca/scene/parse.hpp"

namespace clca::cli {

/// Digits without sign or leading zeros.
CLI::Validator whole_number_validator(
    std::uint64_t least = 0, std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
/// Pixels or, as `89mm`, a length on paper.
CLI::Validator figure_length_validator();
CLI::Validator finite_number_validator(double least = std::numeric_limits<double>::lowest(),
                                       double most = std::numeric_limits<double>::max());
/// `0:5`; one limit may be left out: `:5`.
CLI::Validator axis_limits_validator();
/// `3/64`: the third of 64 parts.
CLI::Validator part_validator(std::uint64_t most);
/// Any text, since the scene checks it; the words of this key are shown and completed.
CLI::Validator key_value_validator(const std::string& key);
/// A key, `=` and a value. `form`: `KEY=VALUE`, for messages.
CLI::Validator assignment_validator(const std::string& form);
/// `90`, `30min` or `2h` into seconds.
CLI::Validator duration_validator();
/// `4GiB` into bytes.
CLI::Validator byte_size_validator();

/// Adds an option. `type`: what the help calls its values; empty: as their C++ type. `values`:
/// checks the values.
template <class T>
CLI::Option* add_option(CLI::App* command, const char* name, T& value, const char* type,
                        const std::string& what, const std::optional<CLI::Validator>& values = {}) {
  CLI::Option* option = command->add_option(name, value, what);
  if (*type != '\0') {
    option->type_name(type);
  }
  return values ? option->transform(*values) : option;
}

using run::check_memory;
using run::kMebibyte;
using run::machine_thread_count;

struct SceneOptions {
  std::string file;
  std::vector<std::string> overrides;
  std::optional<std::string> begin_folder;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> frames_every;  ///< 0: no pictures, but their settings
  std::optional<std::uint64_t> memory_limit;  ///< bytes
};

struct Completion {
  std::string text;
  std::string description = {};
};

/// Name and title of each scene that comes with the program. Throws scene::SceneError.
std::vector<Completion> installed_scenes();

/// Takes a file, or the name of a scene of the program in place of its file.
CLI::Validator scene_name_validator();

void add_scene_options(CLI::App* command, SceneOptions& options);
/// SCENE, --set and --begin only.
void add_scene_set_begin_options(CLI::App* command, SceneOptions& options);
void add_set_option(CLI::App* command, SceneOptions& options, const std::string& what);
void add_memory_limit_option(CLI::App* command, SceneOptions& options,
                             const std::string& what = "Refuse scenes that need more memory");

/// --begin, --set and its short forms.
std::vector<scene::Override> overrides_of(const SceneOptions& options);

double memory_limit_bytes(const SceneOptions& options);

/// The scene with the options applied. Throws scene::SceneError, also when it would need more
/// memory than the limit; that of a Boltzmann run depends on its threads.
scene::AnyScene load_any_scene(const SceneOptions& options, int threads = machine_thread_count());

}  // namespace clca::cli
