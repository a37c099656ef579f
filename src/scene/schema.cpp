#include "scene/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "clca/text/message.hpp"
#include "scene/key.hpp"
#include "scene/limits.hpp"

namespace clca::scene {

namespace {

/// The schema with a further member.
Schema extended(const Schema& schema, const std::string& name, const Json& value) {
  return [=] {
    Json result = schema();
    result[name] = value;
    return result;
  };
}

Schema of_range(std::string_view type, const Json& low, const Json& high) {
  return [=] { return Json{{"type", type}, {"minimum", low}, {"maximum", high}}; };
}

Json list_of_schemas(const std::vector<Schema>& schemas) {
  Json result = Json::array();
  for (const Schema& schema : schemas) {
    result.push_back(schema());
  }
  return result;
}

Schema sized(const Schema& array, std::size_t least, std::size_t most) {
  return with(with(array, "minItems", least), "maxItems", most);
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

Schema schema(std::string_view text) {
  return [text = std::string(text)] { return Json::parse(text); };
}

Schema with(const Schema& schema, const std::string& name, std::uint64_t number) {
  return extended(schema, name, number);
}

Schema number_schema(double low, double high) {
  return of_range("number", low, high);
}

Schema above_zero_schema(double high) {
  return [=] { return Json{{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", high}}; };
}

Schema number_or_text(const Schema& number, const std::string& pattern) {
  return extended(number, "pattern", Json(pattern));
}

Schema integer_schema(std::int64_t low, std::int64_t high) {
  return of_range("integer", low, high);
}

Schema count_schema(std::uint64_t low, std::uint64_t high) {
  // Readers of schemas take whole numbers as signed ones.
  constexpr std::uint64_t kMaxSigned = std::numeric_limits<std::int64_t>::max();
  return of_range("integer", low, high > kMaxSigned ? Json(static_cast<double>(high)) : Json(high));
}

Schema text_schema(const std::string& pattern) {
  return [=] { return Json{{"type", "string"}, {"pattern", pattern}}; };
}

Schema scalar_schema(const std::string& pattern) {
  const Schema any = schema(R"({"type": ["string", "number", "boolean"]})");
  return pattern.empty() ? any : extended(any, "pattern", pattern);
}

Schema word_schema(const std::string& word) {
  return [=] { return Json{{"const", word}}; };
}

Schema choice_schema(const std::vector<std::string_view>& words) {
  return [=] { return Json{{"enum", words}}; };
}

Schema any_of(const std::vector<Schema>& schemas) {
  return [=] { return Json{{"anyOf", list_of_schemas(schemas)}}; };
}

Schema array_schema(const Schema& item) {
  return [=] { return Json{{"type", "array"}, {"items", item()}}; };
}

Schema array_schema(const Schema& item, std::size_t least, std::size_t most) {
  return sized(array_schema(item), least, most);
}

Schema tuple_schema(const std::vector<Schema>& items) {
  return sized(array_schema([=] { return list_of_schemas(items); }), items.size(), items.size());
}

Schema unique(const Schema& array) {
  return extended(array, "uniqueItems", true);
}

Schema object_schema(const Schema& value, const std::string& pattern) {
  return [=] {
    Json object = {{"type", "object"}};
    if (!pattern.empty()) {
      object["propertyNames"] = {{"pattern", pattern}};
    }
    object["additionalProperties"] = value();
    return object;
  };
}

Schema named_schema(const Schema& value, std::size_t least) {
  const Schema object =
      with(object_schema(value, std::string(kNamePattern)), "maxProperties", kMaxItems);
  return least > 0 ? with(object, "minProperties", least) : object;
}

Schema map_schema(const Descriptions& keys, const std::vector<std::string>& one_of,
                  const std::string& conditions) {
  return [=] {
    Json result;
    result["type"] = "object";
    Json& properties = result["properties"] = Json::object();
    std::vector<std::string> required;
    for (const KeyDescription& key : *keys) {
      Json property;
      const bool says_default = !key.required && !key.otherwise.empty() && !key.default_value;
      property["description"] =
          meaning(key) +
          (says_default ? fmt::format(" (default: {})", without_markup(key.otherwise)) : "");
      property.update(may_be_none(key) ? any_of({word_schema("none"), key.schema})()
                                       : key.schema());
      if (key.default_value) {
        property["default"] = to_json(*key.default_value);
      }
      if (key.required) {
        required.push_back(key.name);
      }
      properties[key.name] = property;
    }
    if (!required.empty()) {
      result["required"] = required;
    }
    result["additionalProperties"] = false;
    if (one_of.size() == keys->size()) {
      result.update({{"minProperties", 1}, {"maxProperties", 1}});
    } else {
      for (const std::string& name : one_of) {
        result["oneOf"].push_back({{"required", {name}}});
      }
    }
    if (!conditions.empty()) {
      result.update(Json::parse(conditions));
    }
    return result;
  };
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
