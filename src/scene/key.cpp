#include "scene/key.hpp"

namespace clca::scene {

Json map_schema(const Descriptions& keys, const Schema& conditions) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}};
  Json required = Json::array();
  for (const KeyDescription& key : *keys) {
    Json& property = schema["properties"][key.name];
    const bool says_default = !key.required && !key.otherwise.empty() && !key.default_value;
    property = {
        {"description",
         meaning(key) +
             (says_default ? fmt::format(" (default: {})", without_markup(key.otherwise)) : "")}};
    property.update(key.schema());
    if (key.default_value) {
      property["default"] = to_json(*key.default_value);
    }
    if (key.required) {
      required.push_back(key.name);
    }
  }
  if (!required.empty()) {
    schema["required"] = required;
  }
  schema["additionalProperties"] = false;
  if (conditions) {
    schema.update(conditions());
  }
  return schema;
}

std::string meaning(const KeyDescription& key) {
  return without_markup(
      (key.model ? fmt::format("with model: {}: ", name_of(kModelNames, *key.model)) : "") +
      key.about);
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

}  // namespace clca::scene
