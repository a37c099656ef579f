// Values: found in a tree, read as numbers, written.

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "clca/document/document.hpp"
#include "clca/text/message.hpp"
#include "clca/text/read.hpp"
#include "document/internal/document.hpp"

namespace clca::document {

std::string to_string(const TextLocation& location) {
  const Origin& origin = *location.origin;
  return origin.has_lines ? fmt::format("{}:{}:{}", origin.label, location.line, location.column)
                          : origin.label;
}

void throw_error(std::string_view location, std::string_view message) {
  throw Error(fmt::format("{}: error: {}", location, message));
}

Value Value::scalar(std::string text, const TextLocation& location) {
  Value value;
  value.kind = Kind::scalar;
  value.location = location;
  value.text = std::move(text);
  return value;
}

Value Value::number(double number) {
  return scalar(fmt::format("{}", number));
}

Value Value::quoted_text(std::string_view text) {
  Value value = scalar(std::string(text));
  value.quoted = true;
  return value;
}

Value Value::name(std::string_view name) {
  const bool special = name.starts_with('-') || name == "null" || name == "Null" || name == "NULL";
  return special ? quoted_text(name) : scalar(std::string(name));
}

Value Value::list() {
  Value value;
  value.kind = Kind::list;
  return value;
}

Value Value::map(const TextLocation& location) {
  Value value;
  value.kind = Kind::map;
  value.location = location;
  return value;
}

void Value::add(std::string key, Value value) {
  entries.push_back({std::move(key), value.location, std::move(value)});
}

const Value* Value::find(std::string_view key) const {
  const auto entry = std::ranges::find(entries, key, &Entry::key);
  return entry == entries.end() ? nullptr : &entry->value;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(std::as_const(*this).find(key));
}

const Value* Value::find_path(std::string_view path) const {
  const Value* at = this;
  for (const std::string& key : path_parts(path)) {
    at = at != nullptr ? at->find(key) : nullptr;
  }
  return at;
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
  return text::quoted(value.text) + (value.quoted ? " in quotes" : "") +
         (value.expression.empty() ? "" : ", the value of " + text::quoted(value.expression));
}

std::vector<std::string> path_parts(std::string_view path) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; !path.empty() && start <= path.size();) {
    const std::size_t dot = std::min(path.find('.', start), path.size());
    parts.emplace_back(path.substr(start, dot - start));
    start = dot + 1;
  }
  return parts;
}

std::string join_path(std::string_view path, std::string_view key) {
  return path.empty() ? text::printable(key) : fmt::format("{}.{}", path, text::printable(key));
}

namespace {

/// Digits without a superfluous zero in front, which elsewhere would mean octal.
bool is_plain_integer(std::string_view text) {
  if (text.starts_with('-')) {
    text.remove_prefix(1);
  }
  return !text.empty() && std::ranges::all_of(text, is_digit) &&
         (text.size() == 1 || text.front() != '0');
}

/// Such digits, with a fraction and an exponent or without; std::from_chars checks the rest.
bool is_plain_number(std::string_view text) {
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  const std::size_t end = std::min(text.find_first_of(".eE"), text.size());
  const std::string_view whole = text.substr(sign, end - sign);
  const bool fraction = end + 1 < text.size() && text[end] == '.' && is_digit(text[end + 1]);
  return is_plain_integer(whole) || (whole.empty() && fraction);
}

constexpr std::size_t kLineWidth = 100;
constexpr std::size_t kIndent = 2;

std::string key_text(const Entry& entry) {
  return flow_text(Value::name(entry.key));
}

/// What follows `KEY:` or `-`, with the end of the line.
std::string value_text(const Value& value, std::size_t indent, std::size_t column);

std::string entries_text(const Value& map, std::size_t indent) {
  std::string result;
  bool after_section = false;
  for (const Entry& entry : map.entries) {
    const std::string key = key_text(entry);
    const std::string text = value_text(entry.value, indent + kIndent, indent + key.size() + 1);
    const bool is_section = indent == 0 && text.front() == '\n';
    result +=
        fmt::format("{}{:{}}{}:{}", is_section || after_section ? "\n" : "", "", indent, key, text);
    after_section = is_section;
  }
  return result;
}

std::string value_text(const Value& value, std::size_t indent, std::size_t column) {
  const std::string flow = flow_text(value);
  const bool is_top = indent == kIndent;
  const bool has_maps = std::ranges::any_of(
      value.entries, [](const Entry& entry) { return entry.value.is(Value::Kind::map); });
  const bool fits =
      !value.one_entry_per_line && !(is_top && has_maps) && column + 1 + flow.size() <= kLineWidth;
  if (value.is(Value::Kind::map) && !fits && !value.entries.empty()) {
    return "\n" + entries_text(value, indent);
  }
  if (value.is(Value::Kind::list) && value.one_entry_per_line) {
    std::string result = "\n";
    for (const Value& item : value.items) {
      const std::string lines = item.is(Value::Kind::map)
                                    ? entries_text(item, indent + kIndent).substr(indent + kIndent)
                                    : flow_text(item) + "\n";
      result += fmt::format("{:{}}- {}", "", indent, lines);
    }
    return result;
  }
  return fmt::format(" {}\n", flow);
}

}  // namespace

std::string flow_text(const Value& value) {
  if (value.is(Value::Kind::scalar) && !value.quoted) {
    return value.text;
  }
  if (value.quoted) {
    std::string result = "\"";
    for (const char letter : value.text) {
      result += letter == '"' || letter == '\\' ? "\\" : "";
      result += letter;
    }
    return result + '"';
  }
  std::vector<std::string> parts;
  for (const Value& item : value.items) {
    parts.push_back(flow_text(item));
  }
  for (const Entry& entry : value.entries) {
    parts.push_back(fmt::format("{}: {}", key_text(entry), flow_text(entry.value)));
  }
  const std::string joined = fmt::format("{}", fmt::join(parts, ", "));
  return value.is(Value::Kind::map) ? "{" + joined + "}" : "[" + joined + "]";
}

std::string block_text(const Value& map) {
  return entries_text(map, 0);
}

template <class T>
std::optional<T> number_in(std::string_view text) {
  const bool plain = std::is_integral_v<T> ? is_plain_integer(text) : is_plain_number(text);
  return plain ? text::number<T>(text) : std::nullopt;
}

template std::optional<int> number_in(std::string_view text);
template std::optional<std::uint64_t> number_in(std::string_view text);
template std::optional<double> number_in(std::string_view text);

}  // namespace clca::document
