#include "scene/key.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

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

std::optional<Value> key_text(const AnyKey& key, const void* owner, const Scene& scene) {
  if (key.text) {
    return key.text(owner, scene);
  }
  // Of an owner that is not changed.
  const void* value = key.access ? key.access(const_cast<void*>(owner), false) : nullptr;
  return value != nullptr ? std::optional(key.type->text_of(value, scene)) : std::nullopt;
}

/// Reads the key, or refuses it in another model.
void read_key(const AnyKey& key, const PlacedValue& fields, void* owner) {
  const Value* value = fields.find(key.name);
  if (key.model && *key.model != fields.scene.model) {
    if (value != nullptr) {
      const std::string_view model = name_of(kModelNames, *key.model);
      const auto entry = std::ranges::find(fields.value.entries, key.name, &Entry::key);
      fail(entry->location, "{}: only model {} has it; remove it, or say 'model: {}'",
           fields.at(*entry).path, model, model);
    }
    return;
  }
  if (key.action) {
    key.action(fields, owner);
  }
  if (!key.access || (value == nullptr && !key.required)) {
    return;
  }
  const PlacedValue place = fields.at(key.name);
  if (void* result = key.access(owner, true)) {
    key.type->read_into(place, result);
  }
}

/// A map with these keys, and exactly one of some. `schema_members`: further members.
Schema map_schema(const std::vector<AnyKey>& keys, const std::vector<std::string>& one_of,
                  std::string_view schema_members) {
  std::vector<std::string> properties;
  std::vector<std::string> required;
  for (const AnyKey& key : keys) {
    const bool says_default = !key.required && !key.default_phrase.empty() && !key.default_value;
    const std::string about =
        meaning(key) +
        (says_default ? fmt::format(" (default: {})", without_markup(key.default_phrase)) : "");
    const Schema& schema = key.type->schema;
    const Schema values = may_be_none(key) ? any_of({word_schema("none"), schema}) : schema;
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
  return schema_members.empty() ? result : with(result, schema_members);
}

struct PlacedKey {
  const AnyKey* key = nullptr;
  std::string path;
};

/// All keys, the shortest paths first.
std::vector<PlacedKey> all_keys(const AnyKeys& top) {
  std::vector<PlacedKey> all;
  const auto add = [&all](const AnyKeys& keys, const std::string& above) {
    for (const AnyKey& key : *keys) {
      all.push_back({&key, join_path(above, key.name)});
    }
  };
  add(top, "");
  std::size_t next = 0;
  while (next < all.size()) {
    const auto [key, path] = all[next++];
    if (key->type->keys != nullptr) {
      add(key->type->keys, key->type->is_collection ? path + ".NAME" : path);
    }
  }
  return all;
}

/// Paths of the keys that are meant.
template <class IsMeant>
std::vector<std::string> paths_of(const AnyKeys& top, const IsMeant& is_meant) {
  std::vector<std::string> paths;
  for (const auto& [key, path] : all_keys(top)) {
    if (is_meant(*key)) {
      paths.push_back(path);
    }
  }
  return paths;
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

std::vector<std::string> paths_of_key(const AnyKeys& top, std::string_view name) {
  return paths_of(top, [&](const AnyKey& key) { return key.name == name; });
}

std::vector<std::string> paths_about(const AnyKeys& top, std::string_view word) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  constexpr std::ptrdiff_t kLeastLetters = 3;  // shorter ones are in too many texts
  if (std::ranges::count_if(word, is_letter) < kLeastLetters) {
    return {};
  }
  return paths_of(top, [&](const AnyKey& key) {
    const std::string about =
        fmt::format(" {} {} ", without_markup(key.about), without_markup(key.type->allowed));
    std::size_t at = about.find(word, 1);
    while (at != std::string::npos &&
           (is_letter(about[at - 1]) || is_letter(about[at + word.size()]))) {
      at = about.find(word, at + 1);
    }
    return at != std::string::npos;
  });
}

std::string path_suggestion(const AnyKeys& top, std::string_view name) {
  std::vector<std::string_view> names;
  for (const PlacedKey& placed : all_keys(top)) {
    names.push_back(placed.key->name);
  }
  const auto nearest = text::nearest_name(name, names);
  return nearest ? fmt::format("; did you mean '{}'?", paths_of_key(top, *nearest).front()) : "";
}

bool may_be_none(const AnyKey& key) {
  return !key.required && !key.default_value &&
         (key.default_phrase == "none" || key.default_phrase.starts_with("none:"));
}

void remove_none_entries(Value& value, const std::vector<AnyKey>& keys) {
  for (const AnyKey& key : keys) {
    Value* given = value.find(key.name);
    if (given == nullptr) {
      continue;
    }
    if (may_be_none(key) && !given->quoted && given->text == "none") {
      std::erase_if(value.entries, [&](const Entry& entry) { return entry.key == key.name; });
    } else if (const AnyKeys& inner = key.type->keys; inner != nullptr) {
      if (!key.type->is_collection) {
        remove_none_entries(*given, *inner);
      }
      for (Value& item : given->items) {
        remove_none_entries(item, *inner);
      }
      for (Entry& named : given->entries) {
        if (key.type->is_collection) {
          remove_none_entries(named.value, *inner);
        }
      }
    }
  }
}

std::string meaning(const AnyKey& key) {
  // A link at the end says where to read on.
  std::string about = key.about;
  const std::size_t link = about.rfind('[');
  if (about.ends_with(")") && link != std::string::npos && link >= 2 &&
      about.find("](", link) != std::string::npos && about[link - 1] == ' ' &&
      (about[link - 2] == ':' || about[link - 2] == ';')) {
    about.erase(link - 2);
  }
  return without_markup(
      (key.model ? fmt::format("with model: {}: ", name_of(kModelNames, *key.model)) : "") + about);
}

std::string without_markup(std::string text) {
  // Links first: [text](address).
  for (std::size_t end = text.find("]("); end != std::string::npos; end = text.find("](")) {
    text.erase(end, text.find(')', end) - end + 1);
    text.erase(text.rfind('[', end), 1);
  }
  std::erase(text, '`');
  return text;
}

AnyKey any_key(std::string_view name, const Access& access, const AnyType& type,
               std::string_view about, const void* default_value) {
  AnyKey key = {.name = std::string(name),
                .about = std::string(about),
                .type = std::make_shared<const AnyType>(type),
                .access = access};
  if (default_value != nullptr) {
    key.default_value = type.text_of(default_value, Scene());
    key.default_phrase = fmt::format("`{}`", flow_text(*key.default_value));
  }
  return key;
}

Access composed_access(const Access& first, const Access& second) {
  return [=](void* object, bool make) {
    void* between = first(object, make);
    return between != nullptr ? second(between, make) : nullptr;
  };
}

AnyType map_type(const std::vector<AnyKey>& keys, const std::vector<std::string>& one_of,
                 const AnyAction& check, std::string_view schema_members) {
  const auto all = std::make_shared<const std::vector<AnyKey>>(keys);
  AnyType type = {
      .allowed = "map", .schema = map_schema(keys, one_of, schema_members), .keys = all};
  type.read_into = [=](const PlacedValue& fields, void* owner) {
    check_keys(fields, names_of(*all));
    for (const AnyKey& key : *all) {
      read_key(key, fields, owner);
    }
    if (!one_of.empty()) {
      fields.only_key(std::vector<std::string_view>(one_of.begin(), one_of.end()));
    }
    if (check) {
      check(fields, owner);
    }
  };
  type.text_of = [=](const void* owner, const Scene& scene) {
    Value result = Value::map();
    for (const AnyKey& key : *all) {
      auto text = key.model.value_or(scene.model) == scene.model ? key_text(key, owner, scene)
                                                                 : std::nullopt;
      if (text) {
        result.add(key.name, std::move(*text));
      }
    }
    return result;
  };
  return type;
}

}  // namespace clca::scene
