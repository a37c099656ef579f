// Title, box and rules of the automaton.

#include "clca/text/message.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

using Priority = std::array<automaton::UpdateClass, 3>;

Type<Priority> priority_type() {
  const auto list = set_of(choice(kUpdateClassNames), 3, 3, found, "; name each class once");
  return converted<Priority>(
      "`rest`, `inertia`, `gravity`, each once", list,
      [](const std::vector<automaton::UpdateClass>& order) {
        return Priority{order[0], order[1], order[2]};
      },
      [](const Priority& order) { return std::vector(order.begin(), order.end()); });
}

std::string read_title(const Place& place) {
  const std::string& title = read_text(place);
  const std::optional<std::size_t> characters = line_length(title);
  if (!characters) {
    fail(place, "expected one line of text, found {}", text::shown(title));
  }
  if (*characters == 0 || *characters > kMaxTitleLength) {
    fail(place, "expected 1 to {} characters, found {}", kMaxTitleLength, *characters);
  }
  return title;
}

Keys<automaton::Rules> rules_keys() {
  using automaton::Rules;
  return {key("inertia", &Rules::inertia, number(0, 1),
              "probability to keep the direction of the last step, if free"),
          key("scatter", &Rules::scatter, number(0, 1),
              "probability to take any free candidate, all alike, instead"),
          key("candidates", &Rules::candidates, choice(kCandidateNames),
              "directions a particle may take by itself: gravity and its neighbours, or all six"),
          key("gravity", &Rules::gravity, choice(kDirectionNames), "direction of gravity"),
          key("update_priority", &Rules::update_priority, priority_type(),
              "who moves first: those at rest, those that keep their direction, those that fall "
              "straight"),
          key("ties", &Rules::ties, choice(kTiesNames),
              "order within a class: by a draw for each particle, or for each direction")};
}

}  // namespace

Type<std::string> title_type() {
  return own_type<std::string>(
      fmt::format("1 to {} characters", kMaxTitleLength),
      with(with(scalar_schema(), "minLength", 1), "maxLength", kMaxTitleLength), read_title,
      [](const std::string& title) { return Value::quoted_text(title); });
}

Type<Box> box_type() {
  return type_of<Box>(
      {.keys =
           {required("width", &Box::width, length(number(1, kMaxBoxWidth)),
                     "width; columns stand 0.866 apart"),
            required("height", &Box::height, length(number(1, kMaxBoxHeight)), "height"),
            key("periodic", &Box::periodic, yes_or_no(),
                "what leaves on the right comes back on the left; the number of columns is made "
                "even")},
       .check = [](const KeyedMap& fields, Box& box) { box.location = reference(fields); }});
}

Type<automaton::Rules> rules_type() {
  return type_of<automaton::Rules>({.keys = rules_keys()});
}

Type<automaton::Rules> stage_rules_type() {
  return changed(&Scene::rules, rules_keys());
}

}  // namespace clca::scene
