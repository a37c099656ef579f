#include "scene/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "clca/text/message.hpp"
#include "scene/key.hpp"

namespace clca::scene {

namespace {

using Json = nlohmann::ordered_json;

/// What is between the brackets.
std::string_view members(std::string_view schema) {
  return schema.substr(1, schema.size() - 2);
}

/// Plain scalars become numbers, booleans or strings.
Json to_json(const Value& value) {
  if (value.is(Value::Kind::scalar)) {
    const Json number = value.quoted ? Json(value.text) : Json::parse(value.text, nullptr, false);
    return number.is_discarded() ? Json(value.text) : number;
  }
  Json result = value.is(Value::Kind::map) ? Json::object() : Json::array();
  for (const Value& item : value.items) {
    result.push_back(to_json(item));
  }
  for (const Entry& entry : value.entries) {
    result[entry.key] = to_json(entry.value);
  }
  return result;
}

}  // namespace

Schema with(const Schema& schema, std::string_view more) {
  return fmt::format("{{{}, {}}}", members(schema), more);
}

Schema text_schema(std::string_view pattern) {
  return fmt::format(R"({{"type": "string", "pattern": "{}"}})", pattern);
}

Schema scalar_schema(std::string_view pattern) {
  return fmt::format(R"({{"type": ["string", "number", "boolean"], "pattern": "{}"}})", pattern);
}

Schema word_schema(std::string_view word) {
  return fmt::format(R"({{"const": "{}"}})", word);
}

Schema any_of(const std::vector<Schema>& schemas) {
  return fmt::format(R"({{"anyOf": [{}]}})", fmt::join(schemas, ", "));
}

Schema array_schema(const Schema& items) {
  return fmt::format(R"({{"type": "array", "items": {}}})", items);
}

Schema array_schema(const Schema& items, std::size_t least, std::size_t most) {
  return with(array_schema(items), fmt::format(R"("minItems": {}, "maxItems": {})", least, most));
}

Schema object_schema(const Schema& value, std::string_view pattern) {
  return fmt::format(
      R"({{"type": "object", "propertyNames": {{"pattern": "{}"}}, "additionalProperties": {}}})",
      pattern, value);
}

Schema map_schema(const std::vector<KeyDescription>& keys, const std::vector<std::string>& one_of,
                  std::string_view conditions) {
  std::vector<std::string> properties;
  std::vector<std::string> required;
  for (const KeyDescription& key : keys) {
    const bool says_default = !key.required && !key.otherwise.empty() && !key.default_value;
    const std::string about =
        meaning(key) +
        (says_default ? fmt::format(" (default: {})", without_markup(key.otherwise)) : "");
    const Schema values = may_be_none(key) ? any_of({word_schema("none"), key.schema}) : key.schema;
    properties.push_back(fmt::format(
        R"("{}": {{"description": {}, {}{}}})", key.name, Json(about).dump(), members(values),
        key.default_value ? fmt::format(R"(, "default": {})", to_json(*key.default_value).dump())
                          : ""));
    if (key.required) {
      required.push_back(key.name);
    }
  }
  Schema result =
      fmt::format(R"({{"type": "object", "properties": {{{}}}}})", fmt::join(properties, ", "));
  if (!required.empty()) {
    result = with(result, fmt::format(R"("required": ["{}"])", fmt::join(required, R"(", ")")));
  }
  result = with(result, R"("additionalProperties": false)");
  if (one_of.size() == keys.size()) {
    result = with(result, R"("minProperties": 1, "maxProperties": 1)");
  } else if (!one_of.empty()) {
    const std::string keys_of = fmt::format("{}", fmt::join(one_of, R"("]}, {"required": [")"));
    result = with(result, fmt::format(R"("oneOf": [{{"required": ["{}"]}}])", keys_of));
  }
  return conditions.empty() ? result : with(result, conditions);
}

namespace {

struct PlacedKey {
  const KeyDescription* key = nullptr;
  std::string path;
};

/// All keys, the shortest paths first.
std::vector<PlacedKey> all_keys(const Descriptions& top) {
  std::vector<PlacedKey> all;
  const auto add = [&all](const Descriptions& keys, const std::string& above) {
    for (const KeyDescription& key : *keys) {
      all.push_back({&key, join_path(above, key.name)});
    }
  };
  add(top, "");
  std::size_t next = 0;
  while (next < all.size()) {
    const auto [key, path] = all[next++];
    if (key->keys != nullptr) {
      add(key->keys, key->is_collection ? path + ".NAME" : path);
    }
  }
  return all;
}

}  // namespace

std::vector<std::string> paths_of_key(const Descriptions& top, std::string_view name) {
  std::vector<std::string> paths;
  for (const auto& [key, path] : all_keys(top)) {
    if (key->name == name) {
      paths.push_back(path);
    }
  }
  return paths;
}

std::vector<std::string> paths_about(const Descriptions& top, std::string_view word) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  constexpr std::ptrdiff_t kLeastLetters = 3;  // shorter ones are in too many texts
  std::vector<std::string> paths;
  if (std::ranges::count_if(word, is_letter) < kLeastLetters) {
    return paths;
  }
  for (const auto& [key, path] : all_keys(top)) {
    const std::string about =
        fmt::format(" {} {} ", without_markup(key->about), without_markup(key->allowed));
    for (std::size_t at = about.find(word, 1); at != std::string::npos;
         at = about.find(word, at + 1)) {
      if (!is_letter(about[at - 1]) && !is_letter(about[at + word.size()])) {
        paths.push_back(path);
        break;
      }
    }
  }
  return paths;
}

std::string path_suggestion(const Descriptions& top, std::string_view name) {
  std::vector<std::string_view> names;
  for (const PlacedKey& placed : all_keys(top)) {
    names.push_back(placed.key->name);
  }
  const auto nearest = text::nearest(name, names);
  return nearest ? fmt::format("; did you mean '{}'?", paths_of_key(top, *nearest).front()) : "";
}

}  // namespace clca::scene
