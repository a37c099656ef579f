#pragma once
// Parts of the JSON Schema.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clca::scene {

/// An object of a JSON Schema, as text: only `clca explain` needs it as anything else.
using Schema = std::string;

struct KeyDescription;
/// Shared, since types and keys are copied into each other.
using Descriptions = std::shared_ptr<const std::vector<KeyDescription>>;

/// The schema with more members: what is between the brackets of an object.
Schema with(const Schema& schema, std::string_view more);

/// Text that matches the pattern.
Schema text_schema(std::string_view pattern);
/// The same for text that need not be in quotes.
Schema scalar_schema(std::string_view pattern);
Schema word_schema(std::string_view word);

/// Of an array without equal items.
inline constexpr std::string_view kUnique = R"("uniqueItems": true)";

Schema any_of(const std::vector<Schema>& schemas);
Schema array_schema(const Schema& items);
Schema array_schema(const Schema& items, std::size_t least, std::size_t most);
/// An object whose names match the pattern.
Schema object_schema(const Schema& value, std::string_view pattern);
/// A map with these keys, and exactly one of some. `conditions`: further members.
Schema map_schema(const std::vector<KeyDescription>& keys, const std::vector<std::string>& one_of,
                  std::string_view conditions);

/// Paths of the keys of this name below `top`, the shortest first; `walls.NAME.motion` where a name
/// of the scene stands in between.
std::vector<std::string> paths_of_key(const Descriptions& top, std::string_view name);

/// Paths of the keys below `top` that say this word about themselves, the shortest first.
std::vector<std::string> paths_about(const Descriptions& top, std::string_view word);

/// `; did you mean 'rules.inertia'?` for a key of this or a similar name below `top`, or nothing.
std::string path_suggestion(const Descriptions& top, std::string_view name);

}  // namespace clca::scene
