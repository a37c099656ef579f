#include "cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <regex>
#include <string_view>
#include <system_error>

#include "clca/process/data_folder.hpp"
#include "clca/scene/format.hpp"
#include "clca/text/message.hpp"
#include "clca/text/read.hpp"

namespace clca::cli {

namespace {

/// One without a sign or leading zeros, in this range.
bool is_whole(std::string_view text, std::uint64_t least, std::uint64_t most) {
  const auto found = text::number<std::uint64_t>(text);
  return found && (text.size() == 1 || text.front() != '0') && *found >= least && *found <= most;
}

bool is_number(std::string_view text, double least = std::numeric_limits<double>::lowest(),
               double most = std::numeric_limits<double>::max()) {
  const double found = text::number<double>(text).value_or(NAN);
  return found >= least && found <= most;
}

/// Takes what `converted` turns into another text. `shown`: in the help, after the type.
CLI::Validator conversion_validator(
    const std::string& what, const std::string& shown,
    const std::function<std::optional<std::string>(const std::string&)>& converted) {
  const auto convert = [=](std::string& text) -> std::string {
    const auto result = converted(text);
    if (!result) {
      return fmt::format("expected {}, found {}", what, text::quoted(text));
    }
    text = *result;
    return {};
  };
  return {convert, shown};
}

CLI::Validator check_validator(const std::string& what, const std::string& shown,
                               const std::function<bool(const std::string&)>& is_right) {
  return conversion_validator(what, shown, [=](const std::string& text) {
    return is_right(text) ? std::optional(text) : std::nullopt;
  });
}

/// Takes a number with a unit and makes a plain number of it by `unit`, which alone would take
/// spaces, and 010 as 8; from `least` to `most`.
CLI::Validator unit_validator(const std::string& what, const CLI::AsNumberWithUnit& unit,
                              double least, double most) {
  return conversion_validator(what, "", [=](std::string text) -> std::optional<std::string> {
    static const std::regex kForm(
        R"((0|[1-9][0-9]{0,19})(\.[0-9]{1,19})?(e[0-9]{1,2})?[A-Za-z]{0,3})");
    try {
      const bool is_known = std::regex_match(text, kForm) && unit(text).empty();
      return is_known && is_number(text, least, most) ? std::optional(text) : std::nullopt;
    } catch (const CLI::ValidationError&) {
      return std::nullopt;
    }
  });
}

/// The override of the whole key begin by the run in a folder; a relative path starts at the
/// current folder.
scene::Override override_of_begin(const std::string& folder) {
  const std::string path = std::filesystem::absolute(folder).string();
  return {fmt::format("begin={{run: '{}'}}", std::regex_replace(path, std::regex("'"), "''")),
          "--begin " + folder};
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

CLI::Validator whole_number_validator(std::uint64_t least, std::uint64_t most) {
  const bool is_any = least == 0 && most == std::numeric_limits<std::uint64_t>::max();
  return check_validator(fmt::format("a whole number from {} to {}", least, most),
                         is_any ? "" : fmt::format("in [{} - {}]", least, most),
                         [=](const std::string& text) { return is_whole(text, least, most); });
}

CLI::Validator figure_length_validator() {
  return check_validator("a whole number of pixels from 100 to 10000, or 20mm to 1000mm",
                         "in [100 - 10000] or [20mm - 1000mm]", [](const std::string& text) {
                           const bool is_mm = text.ends_with("mm");
                           return is_mm ? is_whole(text.substr(0, text.size() - 2), 20, 1000)
                                        : is_whole(text, 100, 10'000);
                         });
}

CLI::Validator finite_number_validator(double least, double most) {
  const bool is_any = least == std::numeric_limits<double>::lowest();
  return check_validator(is_any ? "a number" : fmt::format("a number from {} to {}", least, most),
                         "", [=](const std::string& text) { return is_number(text, least, most); });
}

CLI::Validator axis_limits_validator() {
  return check_validator("two numbers, as 0:5 or :5", "", [](const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto is_limit = [](const std::string& part) { return part.empty() || is_number(part); };
    return colon < text.size() && text.size() > 1 && is_limit(text.substr(0, colon)) &&
           is_limit(text.substr(colon + 1));
  });
}

CLI::Validator part_validator(std::uint64_t most) {
  return check_validator(fmt::format("K/N with K from 1 to N and N up to {}", most), "",
                         [most](const std::string& text) {
                           const std::size_t slash = text.find('/');
                           const auto of = slash < text.size() ? text.substr(slash + 1) : "";
                           return is_whole(of, 1, most) &&
                                  is_whole(text.substr(0, slash), 1,
                                           *text::number<std::uint64_t>(of));
                         });
}

CLI::Validator key_value_validator(const std::string& key) {
  const std::vector<std::string> words = scene::allowed_words(key);
  return CLI::Validator(words.empty() ? "" : fmt::format("{{{}}}", fmt::join(words, ",")));
}

CLI::Validator assignment_validator(const std::string& form) {
  return check_validator(form + ", as in rules.inertia=0.5", "", [](const std::string& text) {
    return text.find('=') != std::string::npos;
  });
}

CLI::Validator duration_validator() {
  const std::map<std::string, double> seconds = {{"s", 1}, {"min", 60}, {"h", 3600}};
  return unit_validator("a time up to 1e9 seconds, as in 90, 30min or 2h",
                        CLI::AsNumberWithUnit(seconds, CLI::AsNumberWithUnit::CASE_SENSITIVE), 0,
                        1e9);
}

CLI::Validator byte_size_validator() {
  return unit_validator("a size from 1 to 4EiB, as in 512MiB or 4GiB", CLI::AsSizeValue(false), 1,
                        0x1p62);
}

std::vector<scene::Override> overrides_of(const SceneOptions& options) {
  std::vector<scene::Override> overrides;
  if (options.begin_folder) {  // first, so that --set can add the step
    overrides.push_back(override_of_begin(*options.begin_folder));
  }
  overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
  if (options.seed) {
    overrides.emplace_back(fmt::format("seed={}", *options.seed));
  }
  if (options.frames_every.value_or(0) > 0) {
    overrides.emplace_back(fmt::format("output.frames.every={}", *options.frames_every),
                           fmt::format("--frames-every {}", *options.frames_every));
  }
  return overrides;
}

double memory_limit_bytes(const SceneOptions& options) {
  return options.memory_limit ? static_cast<double>(*options.memory_limit)
                              : run::default_memory_limit();
}

std::vector<Completion> installed_scenes() {
  std::vector<Completion> scenes;
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

void add_set_option(CLI::App* command, SceneOptions& options, const std::string& what) {
  add_option(command, "--set", options.overrides, "KEY=VALUE", what,
             assignment_validator("KEY=VALUE"))
      ->allow_extra_args(false);
}

void add_memory_limit_option(CLI::App* command, SceneOptions& options, const std::string& what) {
  add_option(command, "--memory-limit", options.memory_limit, "SIZE",
             what + ", such as 4GiB [80 % of the free memory]", byte_size_validator());
}

void add_scene_set_begin_options(CLI::App* command, SceneOptions& options) {
  add_option(command, "SCENE", options.file, "",
             "Scene file (YAML), - for standard input, or the name of a scene of this program",
             scene_name_validator())
      ->required();
  add_set_option(command, options,
                 "Set KEY of the scene to VALUE (YAML), such as rules.inertia=0 or "
                 "stages.flow.max_steps=500; may be repeated");
  add_option(command, "--begin", options.begin_folder, "FOLDER",
             "Begin with the last state of the run in this folder, in place of the scene's begin");
}

void add_scene_options(CLI::App* command, SceneOptions& options) {
  add_scene_set_begin_options(command, options);
  add_option(command, "--seed", options.seed, "",
             "Seed of the random draws, in place of the scene's", whole_number_validator());
  add_option(command, "--frames-every", options.frames_every, "",
             "A picture every N steps; 0: no pictures for now, with their settings kept for "
             "clca render",
             whole_number_validator());
  add_memory_limit_option(command, options);
}

scene::AnyScene load_any_scene(const SceneOptions& options, int threads) {
  scene::AnyScene scene = options.file == "-"
                              ? scene::parse_any(standard_input(), "stdin", overrides_of(options))
                              : scene::parse_any_file(options.file, overrides_of(options));
  run::prepare_scene(scene, options.file, memory_limit_bytes(options), threads);
  return scene;
}

}  // namespace clca::cli
