#pragma once
// Whatever stands in a scene file, the answer is a scene or one clear line.

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"

namespace clca::testing {

/// Whether it begins with `scene.yaml:LINE:COLUMN: error: `.
inline bool has_place(std::string_view message) {
  constexpr std::string_view kDigits = "0123456789";
  constexpr std::string_view kFile = "scene.yaml:";
  if (!message.starts_with(kFile)) {
    return false;
  }
  const std::size_t colon =
      std::min(message.find_first_not_of(kDigits, kFile.size()), message.size());
  const std::size_t end = std::min(message.find_first_not_of(kDigits, colon + 1), message.size());
  return colon > kFile.size() && message.substr(colon, 1) == ":" && end > colon + 1 &&
         message.substr(end).starts_with(": error: ");
}

/// Empty for one printable line with a place in it: in the file, or in an override.
inline std::string trouble_with_message(std::string_view message) {
  for (const char letter : message) {
    if (static_cast<unsigned char>(letter) < 0x20) {
      return "a control character in: " + std::string(message);
    }
  }
  const bool placed = has_place(message) || (message.starts_with("--set ") &&
                                             message.find(": error: ") != std::string_view::npos);
  return placed ? "" : "no place in: " + std::string(message);
}

/// Checks the walls unless that takes long.
inline void check_walls_of(const scene::Scene& scene) {
  constexpr double kMaxBytes = 1e6;
  if (scene::model_size(scene).memory_bytes < kMaxBytes) {
    scene::check_walls(scene);
  }
}

/// Empty when the text is refused in one such line, or parses and says the same when it is written
/// and parsed again.
inline std::string trouble_with_text(std::string_view text,
                                     const std::vector<scene::Override>& overrides = {}) {
  using namespace scene;
  try {
    const AnyScene any = parse_any(text, "scene.yaml", overrides);
    if (const auto* scene = std::get_if<Scene>(&any)) {
      check_walls_of(*scene);
    }
    const auto text_of = [](const AnyScene& read) {
      return std::visit([](const auto& scene) { return to_yaml(scene); }, read);
    };
    const std::string written = text_of(any);
    return text_of(parse_any(written, "scene.yaml")) == written ? "" : "differs after a round trip";
  } catch (const SceneError& error) {
    return trouble_with_message(error.what());
  }
}

}  // namespace clca::testing
