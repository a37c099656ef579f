#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "clca/document/document.hpp"
#include "clca/text/message.hpp"
#include "clca/text/read.hpp"
#include "document/internal/document.hpp"

namespace clca::document {

Value read_value(std::string_view text, const std::shared_ptr<const Origin>& origin) {
  Value value = read_document(text, origin);
  if (value.is(Value::Kind::scalar) && !value.quoted && text.find(" #") != std::string_view::npos) {
    fail({origin}, "' #' begins a comment; put a text that has it in quotes");
  }
  return value;
}

namespace {

constexpr std::size_t kMaxPathDepth = 32;

using IsChoice = bool (*)(const std::vector<std::string>& path);

/// An option other than `origin` that has set the value or something inside it; else null.
const Origin* option_in(const Value& value, const std::shared_ptr<const Origin>& origin) {
  if (!value.location.origin->has_lines && value.location.origin != origin &&
      !value.is(Value::Kind::map)) {
    return value.location.origin.get();
  }
  const Origin* found = nullptr;
  for (std::size_t i = 0; i < value.items.size() && found == nullptr; ++i) {
    found = option_in(value.items[i], origin);
  }
  for (std::size_t i = 0; i < value.entries.size() && found == nullptr; ++i) {
    found = option_in(value.entries[i].value, origin);
  }
  return found;
}

/// The item of a list that `part` means: by number, or by name.
Value& item(Value& list, const std::string& part, const std::string& path,
            const TextLocation& location) {
  if (const auto number = text::number<std::size_t>(part); number && *number < list.items.size()) {
    return list.items[*number];
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
  const std::string called =
      names.empty() ? "" : ", named " + text::printable(text::comma_separated(names));
  fail(location, "{} has no item {}; it has {}, numbered from 0{}{}", path, text::quoted(part),
       list.items.size(), called, text::suggestion(part, names));
}

/// The value under `part`; a map gets the key when it has none. `replace` replaces a value.
template <class Replace>
Value& child(Value& parent, const std::vector<std::string>& above, const std::string& part,
             const TextLocation& location, IsChoice is_choice, Replace replace) {
  const std::string path = text::printable(fmt::format("{}", fmt::join(above, ".")));
  if (is_choice(above) && parent.find(part) == nullptr) {
    replace(parent, Value::map(location));
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

}  // namespace

void apply_override(Value& root, const std::string& text, std::string_view option,
                    const std::string& given, IsChoice is_choice, bool after_others) {
  const std::size_t equals = text.find('=');
  const std::string value_shown =
      equals == std::string::npos ? "" : "=" + text::shortened(text.substr(equals + 1));
  const std::string label =
      fmt::format("{} {}{}", option, text::shortened(text.substr(0, equals)), value_shown);
  const auto origin =
      std::make_shared<const Origin>(Origin{given.empty() ? label : text::shortened(given), false});
  const TextLocation location = {origin, 1, 1};
  const std::string_view whole = text;
  std::vector<std::string> parts = path_parts(whole.substr(0, equals));
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
  if (parts.size() == 2 && parts.front() == "let" &&
      (let == nullptr || let->find(parts.back()) == nullptr)) {
    std::vector<std::string_view> names;
    for (const Entry& entry : let != nullptr ? let->entries : std::vector<Entry>()) {
      names.push_back(entry.key);
    }
    fail(location, "nothing is called {} under let{}", text::quoted(parts.back()),
         text::suggestion(parts.back(), names));
  }
  const auto replace = [&](Value& old, Value value) {
    if (const Origin* other = after_others ? option_in(old, origin) : nullptr) {
      fail(location, "it would replace what {} sets", other->label);
    }
    old = std::move(value);
  };
  Value value = read_value(whole.substr(equals + 1), origin);
  Value* target = &root;
  std::vector<std::string> above;
  for (const std::string& part : parts) {
    target = &child(*target, above, part, location, is_choice, replace);
    above.push_back(part);
  }
  replace(*target, std::move(value));
}

}  // namespace clca::document
