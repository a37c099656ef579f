#include "scene/yaml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace clca::scene {

namespace {

constexpr std::size_t kLineWidth = 100;
constexpr std::size_t kIndent = 2;

std::string joined(char open, const std::vector<std::string>& parts, char close) {
  return fmt::format("{}{}{}", open, fmt::join(parts, ", "), close);
}

/// What follows `KEY:` or `-`, with the end of the line.
std::string value_text(const Yaml& value, std::size_t indent, std::size_t column);

std::string entries_text(const Yaml& map, std::size_t indent) {
  std::string result;
  bool after_section = false;
  for (const auto& [key, value] : map.entries) {
    const std::string text = value_text(value, indent + kIndent, indent + key.size() + 1);
    const bool is_section = indent == 0 && text.front() == '\n';
    result +=
        fmt::format("{}{:{}}{}:{}", is_section || after_section ? "\n" : "", "", indent, key, text);
    after_section = is_section;
  }
  return result;
}

std::string value_text(const Yaml& value, std::size_t indent, std::size_t column) {
  const std::string flow = flow_text(value);
  const bool is_top = indent == kIndent;
  const bool has_maps =
      std::any_of(value.entries.begin(), value.entries.end(),
                  [](const auto& entry) { return entry.value.kind == Yaml::Kind::map; });
  const bool fits =
      !value.in_lines && !(is_top && has_maps) && column + 1 + flow.size() <= kLineWidth;
  if (value.kind == Yaml::Kind::map && !fits && !value.entries.empty()) {
    return "\n" + entries_text(value, indent);
  }
  if (value.kind == Yaml::Kind::list && value.in_lines) {
    std::string result = "\n";
    for (const Yaml& item : value.items) {
      const std::string lines = item.kind == Yaml::Kind::map
                                    ? entries_text(item, indent + kIndent).substr(indent + kIndent)
                                    : flow_text(item) + "\n";
      result += fmt::format("{:{}}- {}", "", indent, lines);
    }
    return result;
  }
  return fmt::format(" {}\n", flow);
}

}  // namespace

Yaml Yaml::scalar(std::string text) {
  return {Kind::scalar, std::move(text), {}, {}};
}

Yaml Yaml::list(std::vector<Yaml> items) {
  return {Kind::list, {}, std::move(items), {}};
}

Yaml Yaml::map(std::vector<YamlEntry> entries) {
  return {Kind::map, {}, {}, std::move(entries)};
}

Yaml Yaml::number(double number) {
  return scalar(fmt::format("{}", number));
}

Yaml quoted_text(std::string_view text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      result += '\\';
    }
    result += letter;
  }
  return Yaml::scalar(result + '"');
}

Yaml name_text(std::string_view name) {
  const bool special = name.starts_with('-') || name == "null" || name == "Null" || name == "NULL";
  return special ? quoted_text(name) : Yaml::scalar(std::string(name));
}

std::string flow_text(const Yaml& value) {
  std::vector<std::string> parts;
  switch (value.kind) {
    case Yaml::Kind::scalar:
      return value.text;
    case Yaml::Kind::list:
      std::transform(value.items.begin(), value.items.end(), std::back_inserter(parts), flow_text);
      return joined('[', parts, ']');
    case Yaml::Kind::map:
      for (const auto& [key, item] : value.entries) {
        parts.push_back(fmt::format("{}: {}", key, flow_text(item)));
      }
      return joined('{', parts, '}');
  }
  return {};
}

std::string block_text(const Yaml& map) {
  return entries_text(map, 0);
}

Json to_json(const Yaml& value) {
  switch (value.kind) {
    case Yaml::Kind::scalar: {
      const Json number = Json::parse(value.text, nullptr, false);
      return number.is_discarded() ? Json(value.text) : number;
    }
    case Yaml::Kind::list: {
      Json result = Json::array();
      std::transform(value.items.begin(), value.items.end(), std::back_inserter(result), to_json);
      return result;
    }
    case Yaml::Kind::map: {
      Json result = Json::object();
      for (const auto& [key, item] : value.entries) {
        result[key] = to_json(item);
      }
      return result;
    }
  }
  return {};
}

}  // namespace clca::scene
