// Title, box and rules.

#include <fmt/format.h>

#include <algorithm>

#include "clca/text/message.hpp"
#include "clca/text/utf8.hpp"
#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

std::array<automaton::UpdateClass, 3> read_priority(const Value& value, const std::string& path) {
  const std::vector<Value>& items = read_list(value, path, 3, 3);
  std::array<automaton::UpdateClass, 3> order = {};
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = read_choice(items[i], path, kUpdateClassNames);
    if (std::find(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(i), order[i]) !=
        order.begin() + static_cast<std::ptrdiff_t>(i)) {
      fail(items[i].location,
           fmt::format("{}: {} is named twice; name each class once", path, found(items[i])));
    }
  }
  return order;
}

}  // namespace

std::string read_title(const Value& value) {
  const std::string& title = read_text(value, "title");
  std::size_t characters = 0;
  for (std::size_t i = 0; i < title.size(); ++characters) {
    const std::size_t length = text::character_length(title, i);
    if (length == 0 || text::is_control(text::character_at(title, i))) {
      fail(value.location, "title: expected one line of text, found " + text::shown(title));
    }
    i += length;
  }
  if (characters == 0 || characters > kMaxTitleLength) {
    fail(value.location,
         fmt::format("title: expected 1 to {} characters, found {}", kMaxTitleLength, characters));
  }
  return title;
}

Box read_box(const Value& value) {
  const KeyedMap fields(value, "box", kBoxKeys);
  return {.width = fields.number("width", 1, kMaxBoxWidth),
          .height = fields.number("height", 1, kMaxBoxHeight),
          .periodic = fields.boolean("periodic", false),
          .location = to_string(value.location)};
}

lattice::Lattice lattice_of(const Box& box) {
  return lattice::Lattice::covering(box.width, box.height, box.periodic);
}

automaton::Rules read_rules(const Value& value) {
  const KeyedMap fields(value, "rules", kRulesKeys);
  automaton::Rules rules;
  rules.inertia = fields.number("inertia", 0, 1, rules.inertia);
  rules.scatter = fields.number("scatter", 0, 1, rules.scatter);
  rules.candidates = fields.choice("candidates", kCandidateNames, rules.candidates);
  rules.gravity = fields.choice("gravity", kDirectionNames, rules.gravity);
  if (const Value* priority = fields.find("update_priority")) {
    rules.update_priority = read_priority(*priority, fields.path("update_priority"));
  }
  rules.ties = fields.choice("ties", kTiesNames, rules.ties);
  return rules;
}

}  // namespace clca::scene
