#pragma once
// Whatever stands in a scene file, the answer is a scene or one clear line.

#include <string>
#include <string_view>
#include <variant>

#include "clca/scene/parse.hpp"
#include "clca/scene/resolve.hpp"
#include "clca/scene/walls.hpp"

namespace clca::testing {

/// Empty for one printable line with a place in it.
inline std::string trouble_with_message(std::string_view message) {
  for (const char letter : message) {
    if (static_cast<unsigned char>(letter) < 0x20) {
      return "a control character in: " + std::string(message);
    }
  }
  const bool placed = message.starts_with("scene.yaml:") &&
                      message.find(": error: ") < std::string_view("scene.yaml:99:9999").size();
  return placed ? "" : "no place in: " + std::string(message);
}

/// Empty when the text is refused in one such line, or parses and says the same when it is written
/// and parsed again. Walls are checked where the scene needs less than `most_bytes`.
inline std::string trouble_with_text(std::string_view text, double most_bytes) {
  using namespace scene;
  try {
    const AnyScene any = parse_any(text, "scene.yaml");
    if (const auto* scene = std::get_if<Scene>(&any);
        scene != nullptr && size_of(*scene).bytes < most_bytes) {
      check_walls(*scene);
    }
    const std::string again = std::visit([](const auto& scene) { return to_yaml(scene); }, any);
    return parse_any(again, "scene.yaml") == any ? "" : "differs after a round trip";
  } catch (const SceneError& error) {
    return trouble_with_message(error.what());
  }
}

}  // namespace clca::testing
