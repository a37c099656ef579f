#pragma once
// The scene format as users read it, from the same declarations as the parser.

#include <string>
#include <string_view>
#include <vector>

#include "clca/scene/scene.hpp"
#include "clca/text/read.hpp"

namespace clca::scene {

/// A key that the format does not have; what() names the nearest one.
class UnknownKeyError : public text::InputError {
 public:
  using InputError::InputError;
};

/// What a key means, its values and default, and the keys in it. `path` is as for `--set`
/// (`rules.inertia`, `walls.motion`, `stages.flow.until`), or the name of keys anywhere
/// (`inertia`); empty: the top of a scene. Throws UnknownKeyError.
std::string explanation(std::string_view path);

struct KeySummary {
  std::string path;  ///< as for `--set`
  std::string about;
  bool has_keys = false;  ///< the value is a map
};

/// The keys whose paths begin with this text, without the keys below them.
std::vector<KeySummary> keys_with_prefix(std::string_view begun);

/// The words that a key allows as its value; none if there is no such key.
std::vector<std::string> allowed_words(std::string_view path);

/// A Markdown table of the keys of these maps, at least one; those of the second and further ones
/// have their path in front, from the first map where they are inside it. Throws UnknownKeyError.
std::string markdown_table(const std::vector<std::string>& paths);

// Words of the scene format: `repose`, `contact`.
std::string_view name_of_measure(Measure measure);
std::string_view name_of_model(Model model);

/// JSON Schema, draft 07, of both kinds of scenes.
std::string json_schema();

}  // namespace clca::scene
