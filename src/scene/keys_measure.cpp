// The key `measure`: groups of measures by name, and measures that the scene derives from them.

#include <algorithm>

#include "clca/scene/output.hpp"
#include "clca/text/message.hpp"
#include "scene/document.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

std::string read_expression(const Value& value, const std::string& path, const Scene& /*scene*/) {
  const bool is_line =
      value.is(Value::Kind::scalar) &&
      line_length(value.text).value_or(kMaxExpressionLength + 1) <= kMaxExpressionLength;
  if (!is_line || !value.text.starts_with('=')) {
    fail(value.location, fmt::format("{}: expected an expression like '=runout_99 / 87', found {}",
                                     path, found(value)));
  }
  check_expression(value);
  return value.text;
}

Type<std::string> expression_type() {
  return own_type<std::string>(
      "`=` and an expression", text_schema("^="), read_expression,
      [](const std::string& text, const Scene& /*scene*/) { return quoted_text(text); });
}

Type<DerivedMeasure> derived_type() {
  const Type<std::string> expression = expression_type();
  Type<DerivedMeasure> type = type_of<DerivedMeasure>(
      {.keys = {required("value", &DerivedMeasure::value, expression,
                         "an [expression](#expressions) of measures of the stage, of those derived "
                         "before, of numbers under `let` and of keys of the scene by their paths"),
                key("unit", &DerivedMeasure::unit, title_type(), "its unit; of a pure number 1"),
                key("about", &DerivedMeasure::about, title_type(),
                    "what it is, as axes and reports name it")
                    .defaults_to("the name")}});
  type.schema = any_of({expression.schema, type.schema});
  type.read_into = [expression, map = type.read_into](const Value& value, const std::string& path,
                                                      const Scene& scene, void* result) {
    auto& derived = *static_cast<DerivedMeasure*>(result);
    const Value* written = value.is(Value::Kind::map) ? value.find("value") : &value;
    if (value.is(Value::Kind::map)) {
      map(value, path, scene, result);
    } else {
      derived.value = expression.read(value, path, scene);
    }
    derived.location = FileReference(to_string(written->location));
  };
  return type;
}

void read_derived(const Value& value, Scene& scene) {
  static const Type<DerivedMeasure> kType = derived_type();
  for (const Entry& entry : read_map(value, "measure")) {
    const std::string path = join_path("measure", entry.key);
    if (!is_expression_name(entry.key)) {
      fail(entry.location,
           fmt::format("{}: a name has up to {} letters, digits and '_', no digit first, and is "
                       "not that of a function or constant",
                       path, kMaxNameLength));
    }
    const bool is_twice = std::ranges::count(scene.derived, entry.key, &DerivedMeasure::name) > 0;
    if (is_twice || scene.derived.size() == kMaxDerived) {
      fail(entry.location, is_twice ? path + ": it is named twice"
                                    : fmt::format("{}: expected at most {}", path, kMaxDerived));
    }
    DerivedMeasure derived = kType.read(entry.value, path, scene);
    derived.name = entry.key;
    scene.derived.push_back(std::move(derived));
  }
}

void read_measures(const KeyedMap& fields, Scene& scene, const Scene& /*scene*/) {
  const Value* value = fields.find("measure");
  if (value == nullptr) {
    return;
  }
  if (value->is(Value::Kind::map)) {
    read_derived(*value, scene);
    return;
  }
  scene.measures.clear();
  for (const Value& item : read_list(*value, "measure", 0, kMeasureNames.size() + kMaxDerived)) {
    if (item.is(Value::Kind::map)) {
      read_derived(item, scene);
      continue;
    }
    const Measure measure = read_choice(item, "measure", kMeasureNames);
    if (std::ranges::count(scene.measures, measure) > 0) {
      fail(item.location, fmt::format("measure: {} is named twice", found(item)));
    }
    if (measure == Measure::weight_paths) {
      check_weight_paths(item.location, "measure", scene);
    }
    scene.measures.push_back(measure);
  }
}

std::optional<Yaml> measures_text(const Scene& scene, const Scene& /*scene*/) {
  static const Type<DerivedMeasure> kType = derived_type();
  Yaml list = Yaml::list({});
  for (const Measure measure : scene.measures) {
    list.items.push_back(Yaml::scalar(std::string(name_of(kMeasureNames, measure))));
  }
  Yaml derived = Yaml::map({});
  for (const DerivedMeasure& measure : scene.derived) {
    derived.entries.push_back({measure.name, kType.text(measure, scene)});
  }
  if (!scene.derived.empty()) {
    list.items.push_back(std::move(derived));
  }
  return list;
}

/// The number at a path of maps; none if there is no number.
std::optional<double> number_at(const Yaml& root, std::string_view path) {
  const Yaml* at = &root;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const auto next =
        std::ranges::find(at->entries, path.substr(begin, end - begin), &YamlEntry::key);
    if (next == at->entries.end()) {
      return std::nullopt;
    }
    at = &next->value;
    begin = end + 1;
  }
  return at->kind == Yaml::Kind::scalar ? to_number(at->text) : std::nullopt;
}

}  // namespace

Key<Scene> measure_key() {
  const Type<Measure> word = choice(kMeasureNames);
  const Type<DerivedMeasure> derived = derived_type();
  const Schema by_name =
      with(object_schema(derived.schema, kExpressionNamePattern), "maxProperties", kMaxDerived);
  return own_key<Scene>(
      {.name = "measure",
       .about = "what is measured at the end of each stage: [measures](#measures)",
       .allowed = "list of " + word.allowed +
                  " and of maps of "
                  "[derived measures](#derived-measures) by name, or such a map beside the default",
       .otherwise = "all but `mixing` and `weight_paths`",
       .is_collection = true,
       .schema = any_of({unique(array_schema(any_of({word.schema, by_name}))), by_name}),
       .keys = derived.keys},
      read_measures, measures_text);
}

void put_numbers_into_derived(Scene& scene) {
  if (scene.derived.empty()) {
    return;
  }
  const Yaml whole = scene_type().text(scene, scene);
  for (DerivedMeasure& derived : scene.derived) {
    derived.value = with_numbers(derived.value, [&](std::string_view name) {
      return name.find('.') == std::string_view::npos ? std::nullopt : number_at(whole, name);
    });
  }
}

}  // namespace clca::scene
