#include "scene/value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clca/scene/parse.hpp"
#include "clca/text/message.hpp"

namespace clca::scene {

std::string to_string(const TextLocation& location) {
  const Origin& origin = *location.origin;
  return origin.has_lines ? fmt::format("{}:{}:{}", origin.label, location.line, location.column)
                          : origin.label;
}

void fail(const TextLocation& location, std::string_view message) {
  throw SceneError(fmt::format("{}: error: {}", to_string(location), message));
}

const Value* Value::find(std::string_view key) const {
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [key](const Entry& other) { return other.key == key; });
  return entry == entries.end() ? nullptr : &entry->value;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(std::as_const(*this).find(key));
}

Value scalar_at(const TextLocation& location, const std::string& text) {
  Value value;
  value.kind = Value::Kind::scalar;
  value.location = location;
  value.text = text;
  return value;
}

Value map_at(const TextLocation& location) {
  Value value;
  value.kind = Value::Kind::map;
  value.location = location;
  return value;
}

std::string found(const Value& value) {
  switch (value.kind) {
    case Value::Kind::nothing:
      return "nothing";
    case Value::Kind::list:
      return "a list";
    case Value::Kind::map:
      return "a map";
    case Value::Kind::scalar:
      break;
  }
  return text::shown(value.text) + (value.quoted ? " in quotes" : "") +
         (value.expression.empty() ? "" : ", the value of " + text::shown(value.expression));
}

}  // namespace clca::scene
