#pragma once
// Parts of the JSON Schema.

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace clca::scene {

/// Built on demand: only `clca explain` needs it.
using Json = nlohmann::ordered_json;
using Schema = std::function<Json()>;

struct KeyDescription;
/// Shared, since types and keys are copied into each other.
using Descriptions = std::shared_ptr<const std::vector<KeyDescription>>;

/// As the JSON text says.
Schema schema(std::string_view text);
/// The schema with a further member.
Schema with(const Schema& schema, const std::string& name, std::uint64_t number);

Schema number_schema(double low, double high);
Schema above_zero_schema(double high);
/// Such a number, or text that matches the pattern, since text may stand in place of any number.
Schema number_or_text(const Schema& number, const std::string& pattern);
Schema integer_schema(std::int64_t low, std::int64_t high);
Schema count_schema(std::uint64_t low, std::uint64_t high);
/// Text that matches the pattern.
Schema text_schema(const std::string& pattern);
/// The same for text that need not be in quotes.
Schema scalar_schema(const std::string& pattern = {});
Schema word_schema(const std::string& word);
/// One of the words.
Schema choice_schema(const std::vector<std::string_view>& words);

Schema any_of(const std::vector<Schema>& schemas);
Schema array_schema(const Schema& item);
Schema array_schema(const Schema& item, std::size_t least, std::size_t most);
/// An array with an item of each schema.
Schema tuple_schema(const std::vector<Schema>& items);
/// An array without equal items.
Schema unique(const Schema& array);
/// An object whose names match the pattern, unless it is empty.
Schema object_schema(const Schema& value, const std::string& pattern = {});
/// An object of at least so many things by the names that the scene gives them.
Schema named_schema(const Schema& value, std::size_t least = 0);
/// A map with these keys, and exactly one of some. `conditions`: further members, as JSON.
Schema map_schema(const Descriptions& keys, const std::vector<std::string>& one_of,
                  const std::string& conditions);

/// Paths of the keys of this name below `top`, the shortest first; `walls.NAME.motion` where a name
/// of the scene stands in between.
std::vector<std::string> paths_of_key(const Descriptions& top, std::string_view name);

/// Paths of the keys below `top` that say this word about themselves, the shortest first.
std::vector<std::string> paths_about(const Descriptions& top, std::string_view word);

/// `; did you mean 'rules.inertia'?` for a key of this or a similar name below `top`, or nothing.
std::string path_suggestion(const Descriptions& top, std::string_view name);

}  // namespace clca::scene
