
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "clca/scene/parse.hpp"
#include "clca/text/message.hpp"
#include "scene/document.hpp"
#include "scene/keyed_map.hpp"

namespace clca::scene {

namespace {

constexpr std::size_t kMaxPathDepth = 32;

/// True for the maps that hold one key out of several: a new key takes the place of the old one.
bool is_choice(const std::vector<std::string>& parts, std::size_t depth) {
  return depth == 3 && ((parts[0] == "stages" && (parts[2] == "until" || parts[2] == "vessel")) ||
                        (parts[0] == "species" && parts[2] == "shape"));
}

/// The item of a list that `part` means: by number, or by name.
Value& item(Value& list, const std::string& part, const std::string& path,
            const TextLocation& location) {
  std::size_t number = 0;
  const char* end = part.data() + part.size();
  const auto [stop, error] = std::from_chars(part.data(), end, number);
  if (stop == end && error == std::errc() && number < list.items.size()) {
    return list.items[number];
  }
  std::vector<std::string_view> names;
  for (Value& candidate : list.items) {
    const Value* name = candidate.find("name");
    if (name != nullptr && name->is(Value::Kind::scalar)) {
      if (name->text == part) {
        return candidate;
      }
      names.push_back(name->text);
    }
  }
  const std::string called = names.empty() ? "" : ", named " + text::printable(text::listed(names));
  fail(location, "{} has no item {}; it has {}, numbered from 0{}{}", path, text::shown(part),
       list.items.size(), called, text::suggestion(part, names));
}

/// The value under `part`; a map gets the key when it has none.
Value& child(Value& parent, const std::vector<std::string>& parts, std::size_t depth,
             const TextLocation& location) {
  const std::string& part = parts[depth];
  const std::string path = text::printable(fmt::format(
      "{}", fmt::join(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(depth), ".")));
  if (is_choice(parts, depth) && parent.find(part) == nullptr) {
    parent = Value::map(location);
  }
  if (parent.is(Value::Kind::list)) {
    return item(parent, part, path, location);
  }
  if (parent.is(Value::Kind::nothing)) {
    parent = Value::map(location);
  }
  if (parent.is(Value::Kind::scalar)) {
    fail(location, "{} is {}, nothing lies inside it; set it as a whole", path, found(parent));
  }
  if (Value* known = parent.find(part)) {
    return *known;
  }
  parent.entries.push_back({part, location, {}});
  parent.entries.back().value.location = location;
  return parent.entries.back().value;
}

/// The view of pictures stays where they are set to none, for what is drawn of the run later.
void keep_view(Value& root, const std::vector<std::string>& parts, const Value& value) {
  const bool is_none = value.is(Value::Kind::scalar) && !value.quoted && value.text == "none";
  Value* output = root.find("output");
  Value* frames = output != nullptr ? output->find("frames") : nullptr;
  if (!is_none || parts != std::vector<std::string>{"output", "frames"} || frames == nullptr) {
    return;
  }
  if (const Value* view = frames->find("view")) {
    const Value kept = *view;
    std::erase_if(output->entries, [](const Entry& entry) { return entry.key == "view"; });
    output->entries.push_back({"view", kept.location, kept});
  }
}

/// Text of a value in which numbers have one form only.
std::string canonical_text(const Value& value) {
  std::string text;
  switch (value.kind) {
    case Value::Kind::nothing:
      return "null";
    case Value::Kind::scalar: {
      const auto number = value.quoted ? std::nullopt : to_number(value.text);
      return number ? fmt::format("{}", *number + 0.0) : flow_text(Value::quoted_text(value.text));
    }
    case Value::Kind::list:
      for (const Value& item : value.items) {
        text += canonical_text(item) + ",";
      }
      return "[" + text + "]";
    case Value::Kind::map:
      for (const Entry& entry : value.entries) {
        text += flow_text(Value::quoted_text(entry.key)) + ":" + canonical_text(entry.value) + ",";
      }
      return "{" + text + "}";
  }
  return text;
}

}  // namespace

std::string canonical_value(const std::string& text) {
  try {
    Value value = read_document(text, std::make_shared<const Origin>());
    evaluate_expression(value);
    return canonical_text(value);
  } catch (const SceneError&) {
    return text;
  }
}

void apply_override(Value& root, const std::string& text, std::string_view option) {
  const std::size_t equals = text.find('=');
  const std::string value_shown =
      equals == std::string::npos ? "" : "=" + text::shortened(text.substr(equals + 1));
  const auto origin = std::make_shared<const Origin>(Origin{
      fmt::format("{} {}{}", option, text::shortened(text.substr(0, equals)), value_shown), false});
  const TextLocation location = {origin, 1, 1};
  const std::string_view whole = text;
  std::vector<std::string> parts = parts_of_path(whole.substr(0, equals));
  if (equals == std::string::npos || parts.empty() || std::ranges::count(parts, "") > 0) {
    fail(location, "expected KEY=VALUE with a key like rules.inertia");
  }
  if (parts.size() > kMaxPathDepth) {
    fail(location, "a key of more than {} parts", kMaxPathDepth);
  }
  const Value* let = root.find("let");
  if (parts.size() == 1 && let != nullptr && let->find(parts.front()) != nullptr) {
    parts.insert(parts.begin(), "let");
  }
  Value value = read_document(whole.substr(equals + 1), origin);
  keep_view(root, parts, value);
  Value* target = &root;
  for (std::size_t depth = 0; depth < parts.size(); ++depth) {
    target = &child(*target, parts, depth, location);
  }
  *target = std::move(value);
}

}  // namespace clca::scene
