// Title, box and rules of the automaton.

#include <algorithm>

#include "clca/text/message.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

using Priority = std::array<automaton::UpdateClass, 3>;

Priority read_priority(const Value& value, const std::string& path, const Scene& /*scene*/) {
  const std::vector<Value>& items = read_list(value, path, 3, 3);
  Priority order = {};
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

Type<Priority> priority_type() {
  const Type<automaton::UpdateClass> update_class = choice(kUpdateClassNames);
  return own_type<Priority>("`rest`, `inertia`, `gravity`, each once",
                            unique(array_schema(update_class.schema, 3, 3)), read_priority,
                            [update_class](const Priority& order, const Scene& scene) {
                              Yaml list = Yaml::list({});
                              for (const automaton::UpdateClass next : order) {
                                list.items.push_back(update_class.text(next, scene));
                              }
                              return list;
                            });
}

std::string read_title(const Value& value, const std::string& path, const Scene& /*scene*/) {
  const std::string& title = read_text(value, path);
  const std::optional<std::size_t> characters = line_length(title);
  if (!characters) {
    fail(value.location,
         fmt::format("{}: expected one line of text, found {}", path, text::shown(title)));
  }
  if (*characters == 0 || *characters > kMaxTitleLength) {
    fail(value.location, fmt::format("{}: expected 1 to {} characters, found {}", path,
                                     kMaxTitleLength, *characters));
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
      [](const std::string& title, const Scene& /*scene*/) { return quoted_text(title); });
}

Type<Box> box_type() {
  return type_of<Box>(
      {.keys =
           {required("width", &Box::width, number(1, kMaxBoxWidth),
                     "width; columns stand 0.866 apart"),
            required("height", &Box::height, number(1, kMaxBoxHeight), "height"),
            key("periodic", &Box::periodic, yes_or_no(),
                "what leaves on the right comes back on the left; the number of columns is made "
                "even")},
       .check = [](const KeyedMap& fields, Box& box, const Scene& /*scene*/) {
         box.location = FileReference(to_string(fields.location()));
       }});
}

Type<automaton::Rules> rules_type() {
  return type_of<automaton::Rules>({.keys = rules_keys()});
}

Type<automaton::Rules> stage_rules_type() {
  return changed(&Scene::rules, rules_keys());
}

}  // namespace clca::scene
