#include "clca/scene/format.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scene/sections.hpp"

namespace clca::scene {

namespace {

using Json = nlohmann::ordered_json;

/// A key and how users write where it is.
struct FoundKey {
  const AnyKey* key = nullptr;  ///< none at the top
  AnyKeys keys;                 ///< below it; null if there is no such key
  std::string path;
};

/// The key at the path below these, or null. A name may follow a key such as `walls`.
FoundKey find(const AnyKeys& top, const std::vector<std::string>& parts) {
  FoundKey found = {.key = nullptr, .keys = top, .path = ""};
  static const AnyKeys kNone = std::make_shared<const std::vector<AnyKey>>();
  bool name_allowed = false;
  for (const std::string& part : parts) {
    const auto next = std::find_if(found.keys->begin(), found.keys->end(),
                                   [&](const AnyKey& key) { return key.name == part; });
    if (next != found.keys->end()) {
      found = {.key = &*next,
               .keys = next->type->keys ? next->type->keys : kNone,
               .path = join_path(found.path, part)};
      name_allowed = next->type->is_collection;
      found.path += name_allowed ? ".NAME" : "";
    } else if (part.empty() || !std::exchange(name_allowed, false)) {
      return {};
    }
  }
  return found;
}

/// Keys of this name anywhere in scenes of both kinds.
std::vector<std::string> paths_anywhere(std::string_view name) {
  std::vector<std::string> paths = paths_of_key(scene_type().keys, name);
  for (std::string& path : paths_of_key(boltzmann_type().keys, name)) {
    if (std::ranges::find(paths, path) == paths.end()) {
      paths.push_back(std::move(path));
    }
  }
  return paths;
}

/// The keys in scenes of grains and of gases, where they differ; `boltzmann:PATH`: gases only.
std::vector<FoundKey> found_keys(std::string_view path) {
  constexpr std::string_view kGasOnly = "boltzmann:";
  const bool gas_only = path.starts_with(kGasOnly);
  path.remove_suffix(path.size() > 1 && path.ends_with('.') && !path.ends_with("..") ? 1 : 0);
  const std::vector<std::string> parts =
      document::path_parts(path.substr(gas_only ? kGasOnly.size() : 0));
  const std::vector<AnyKeys> tops = gas_only
                                        ? std::vector{boltzmann_type().keys}
                                        : std::vector{scene_type().keys, boltzmann_type().keys};
  std::vector<FoundKey> found;
  for (const AnyKeys& top : tops) {
    const FoundKey match = find(top, parts);
    if (match.keys != nullptr && (found.empty() || match.key == nullptr ||
                                  match.key->type->schema != found.front().key->type->schema)) {
      found.push_back(match);
    }
  }
  if (!found.empty()) {
    return found;
  }
  std::vector<std::string_view> names;
  const std::vector<std::string> parents(parts.begin(), parts.end() - (parts.empty() ? 0 : 1));
  for (const AnyKeys& top : tops) {
    if (const AnyKeys keys = find(top, parents).keys) {
      const auto more = names_of(*keys);
      names.insert(names.end(), more.begin(), more.end());
    }
  }
  const std::string& last = parts.back();  // the top has been found
  const auto nearest = text::nearest_name(last, names);
  std::string suggestion;
  if (nearest) {
    std::vector<std::string> meant = parents;
    meant.emplace_back(*nearest);
    suggestion = fmt::format("; did you mean '{}'?", fmt::join(meant, "."));
  }
  const std::vector<std::string> about = paths_about(scene_type().keys, last);
  if (suggestion.empty() && !about.empty()) {
    suggestion =
        "; see " + text::comma_separated(std::vector<std::string_view>(about.begin(), about.end()));
  } else if (suggestion.empty()) {
    suggestion = path_suggestion(scene_type().keys, last);
  }
  throw UnknownKeyError(
      fmt::format("the scene format has no key {}{}", text::quoted(path), suggestion));
}

std::string values_text(const AnyKey& key) {
  const bool is_value = key.default_value || may_be_none(key);
  const std::string phrase = key.required                 ? "required"
                             : key.default_phrase.empty() ? ""
                             : key.is_condition           ? key.default_phrase
                             : is_value                   ? "default: " + key.default_phrase
                                                          : "if left out: " + key.default_phrase;
  return without_markup(key.type->allowed + (phrase.empty() ? "" : "; " + phrase));
}

std::string explained(const FoundKey& found) {
  std::string text;
  if (found.key != nullptr) {
    text = fmt::format("{}: {}\n  {}\n", found.path, meaning(*found.key), values_text(*found.key));
  }
  for (const AnyKey& key : *found.keys) {
    text += fmt::format("\n  {}: {}\n    {}\n", key.name, meaning(key), values_text(key));
  }
  return text;
}

/// Adds the words that the schema allows and `words` does not have yet.
void add_words(const Json& schema, std::vector<std::string>& words) {
  Json values = schema.value("enum", Json::array());
  if (schema.contains("const")) {
    values.push_back(schema["const"]);
  }
  if (schema.value("type", Json()) == "boolean") {
    values.insert(values.end(), {true, false});
  }
  for (const Json& value : values) {
    const std::string word = value.is_string() ? value.get<std::string>() : value.dump();
    if (std::ranges::find(words, word) == words.end()) {
      words.push_back(word);
    }
  }
  for (const Json& part : schema.value("anyOf", Json::array())) {
    add_words(part, words);
  }
}

std::string cell(std::string text) {
  for (std::size_t bar = text.find('|'); bar != std::string::npos; bar = text.find('|', bar + 2)) {
    text.insert(bar, "\\");
  }
  return text;
}

std::string row(const std::string& prefix, const AnyKey& key) {
  const std::string model =
      key.model ? fmt::format("with `model: {}`: ", name_of(kModelNames, *key.model)) : "";
  return fmt::format("| `{}{}` | {} | {} | {}{} |\n", prefix, key.name, cell(key.type->allowed),
                     key.required ? "required" : cell(key.default_phrase), model, cell(key.about));
}

/// Allows expressions wherever the schema has a number.
void allow_expressions(Json& schema) {
  if (schema.is_object() && schema.contains("type") &&
      (schema["type"] == "number" || schema["type"] == "integer")) {
    // The limits hold for numbers only, the pattern for strings only.
    schema["type"] = {schema["type"], "string"};
    schema["pattern"] = schema.contains("pattern") ? "^=|" + std::string(schema["pattern"]) : "^=";
  } else if (schema.is_object() && schema.contains("enum") && schema["enum"].front().is_number()) {
    schema = {{"anyOf", {schema, {{"type", "string"}, {"pattern", "^="}}}}};
    return;
  }
  if (schema.is_structured()) {
    for (Json& part : schema) {
      allow_expressions(part);
    }
  }
}

}  // namespace

std::string explanation(std::string_view path) {
  const bool at_top = find(scene_type().keys, {std::string(path)}).keys != nullptr ||
                      find(boltzmann_type().keys, {std::string(path)}).keys != nullptr;
  const std::vector<std::string> paths =
      path.empty() || at_top ? std::vector<std::string>() : paths_anywhere(path);
  if (!paths.empty()) {
    std::string all;
    for (const std::string& found_path : paths) {
      all += (all.empty() ? "" : "\n") + explanation(found_path);
    }
    return all;
  }
  const std::vector<FoundKey> found = found_keys(path);
  std::string text = explained(found.front());
  if (found.size() > 1) {
    text = fmt::format("In a scene of grains:\n\n{}\nIn a scene of the Boltzmann equation:\n\n{}",
                       text, explained(found.back()));
  }
  return text;
}

std::vector<KeySummary> keys_with_prefix(std::string_view begun) {
  if (begun.starts_with('.')) {
    return {};
  }
  const std::size_t length = begun.rfind('.') + 1;  // 0 without a dot
  const std::vector<std::string> parents =
      document::path_parts(begun.substr(0, std::max<std::size_t>(length, 1) - 1));
  std::vector<KeySummary> names;
  for (const AnyKeys& top : {scene_type().keys, boltzmann_type().keys}) {
    const FoundKey found = find(top, parents);
    const bool name_follows =
        found.key != nullptr && found.key->type->is_collection && found.key->name == parents.back();
    if (found.keys == nullptr || name_follows) {
      continue;
    }
    for (const AnyKey& key : *found.keys) {
      const std::string path = std::string(begun.substr(0, length)) + key.name;
      const bool is_known =
          std::ranges::any_of(names, [&](const KeySummary& name) { return name.path == path; });
      if (path.starts_with(begun) && !is_known) {
        names.push_back({path, meaning(key), key.type->keys != nullptr});
      }
    }
  }
  return names;
}

std::vector<std::string> allowed_words(std::string_view path) {
  std::vector<std::string> words;
  for (const AnyKeys& top : {scene_type().keys, boltzmann_type().keys}) {
    const FoundKey found = find(top, document::path_parts(path));
    if (found.key != nullptr) {
      add_words(Json::parse(found.key->type->schema), words);
    }
  }
  return words;
}

std::string markdown_table(const std::vector<std::string>& paths) {
  std::string table = "| key | values | default | what |\n|---|---|---|---|\n";
  for (const std::string& path : paths) {
    const std::string& first = paths.front();
    const std::string inside = path.starts_with(first + ".") ? path.substr(first.size() + 1) : path;
    const std::string prefix = path == first ? "" : inside + ".";
    for (const AnyKey& key : *found_keys(path).front().keys) {
      table += row(prefix, key);
    }
  }
  return table;
}

std::string_view name_of_measure(Measure measure) {
  return name_of(kMeasureNames, measure);
}

std::string_view name_of_model(Model model) {
  return name_of(kModelNames, model);
}

std::string json_schema() {
  Json schema = Json::parse(R"({
    "$schema": "http://json-schema.org/draft-07/schema#",
    "title": "Scene of clca",
    "description": "Everything about a run: of grains, or of the Boltzmann equation. Written by clca explain --format schema.",
    "type": "object",
    "oneOf": [{"$ref": "#/definitions/grains"}, {"$ref": "#/definitions/boltzmann"}]})");
  const auto define = [&](const char* name, const AnyType& type, std::string_view about) {
    Json& definition = schema["definitions"][name];
    definition["description"] = about;
    definition.update(Json::parse(type.schema));
  };
  define("grains", scene_type(),
         "A scene of grains on the lattice. Lengths in lattice spacings from the lower left site, "
         "time in steps, angles in degrees.");
  define("boltzmann", boltzmann_type(),
         "A scene of the Boltzmann equation: a homogeneous gas of inelastic, rough spheres. "
         "Velocities in v0, the root of a third of the mean square at time 0; time in 1 / (pi N "
         "(2 a)^2 v0).");
  allow_expressions(schema);
  return schema.dump(2) + "\n";
}

}  // namespace clca::scene
