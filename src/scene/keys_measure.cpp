// The key `measure`: groups of measures by name, and measures that the scene derives from them.

#include <algorithm>

#include "clca/scene/output.hpp"
#include "clca/scene/units.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr std::size_t kMaxExpressionLength = 1000;
constexpr std::size_t kMaxDerived = 100;

std::string read_expression(const PlacedValue& place) {
  const Value& value = place.value;
  const bool is_line =
      value.is(Value::Kind::scalar) &&
      line_length(value.text).value_or(kMaxExpressionLength + 1) <= kMaxExpressionLength;
  if (!is_line || !value.text.starts_with('=')) {
    fail(place, "expected an expression like '=runout_99 / 87', found {}", found(place));
  }
  document::check_expression(value);
  return value.text;
}

Type<std::string> expression_type() {
  return custom_type<std::string>("`=` and an expression", text_schema("^="), read_expression,
                                  [](const std::string& text) { return Value::quoted_text(text); });
}

Type<DerivedMeasure> derived_type() {
  const Type<std::string> expression = expression_type();
  Type<DerivedMeasure> type = type_of<DerivedMeasure>(
      {.keys = {
           required_key("value", &DerivedMeasure::expression, expression,
                        "an [expression](#expressions) of measures of the stage, of those derived "
                        "before, of numbers under `let` and of keys of the scene by their paths"),
           key("unit", &DerivedMeasure::unit, text_line_type(), "its unit; of a pure number 1"),
           key("about", &DerivedMeasure::about, text_line_type(),
               "what it is, as axes and reports name it")
               .defaults_to("the name")}});
  type = or_map("", expression.schema, type, [=](const PlacedValue& place) {
    DerivedMeasure derived;
    derived.expression = expression.read(place);
    return derived;
  });
  type.read_into = [read = type.read_into](const PlacedValue& place, void* derived) {
    read(place, derived);
    const Value* value = place.value.find("value");
    static_cast<DerivedMeasure*>(derived)->location =
        to_string((value != nullptr ? *value : place.value).location);
  };
  return type;
}

void read_derived(const PlacedValue& place, Scene& scene) {
  static const Type<DerivedMeasure> kType = derived_type();
  for (const Entry& entry : read_map(place)) {
    const PlacedValue inside = place.at(entry);
    if (!document::is_expression_name(entry.key)) {
      fail(entry.location,
           "{}: a name has up to {} letters, digits and '_', no digit first, and is not that of a "
           "function or constant",
           inside.path, document::kMaxNameLength);
    }
    const bool is_twice =
        std::ranges::count(scene.derived_measures, entry.key, &DerivedMeasure::name) > 0;
    if (is_twice || scene.derived_measures.size() == kMaxDerived) {
      fail(entry.location, "{}: {}", inside.path,
           is_twice ? "it is named twice" : fmt::format("expected at most {}", kMaxDerived));
    }
    DerivedMeasure derived = kType.read(inside);
    derived.name = entry.key;
    scene.derived_measures.push_back(std::move(derived));
  }
}

void read_measures(const PlacedValue& fields, Scene& scene) {
  for (const auto& named : kMeasureNames) {
    // Mixing takes time in each step; paths of weight are of beds at rest only.
    if (named.value != Measure::mixing && named.value != Measure::weight_paths) {
      scene.measures.push_back(named.value);
    }
  }
  if (fields.find("measure") == nullptr) {
    return;
  }
  const PlacedValue place = fields.at("measure");
  if (place.value.is(Value::Kind::map)) {
    read_derived(place, scene);
    return;
  }
  const Type<Measure> word = choice_type(kMeasureNames);
  scene.measures.clear();
  for (const PlacedValue& item : read_list(place, 0, kMeasureNames.size() + kMaxDerived,
                                           [&](auto& item) { word.read(item); })) {
    if (item.value.is(Value::Kind::map)) {
      read_derived(item, scene);
      continue;
    }
    const Measure measure = word.read(item);
    if (std::ranges::count(scene.measures, measure) > 0) {
      fail(item, "{} is named twice", found(item));
    }
    if (measure == Measure::weight_paths) {
      check_weight_paths(item);
    }
    scene.measures.push_back(measure);
  }
}

std::optional<Value> measures_text(const Scene& scene) {
  static const Type<DerivedMeasure> kType = derived_type();
  Value list = Value::list();
  for (const Measure measure : scene.measures) {
    list.items.push_back(Value::scalar(std::string(name_of(kMeasureNames, measure))));
  }
  Value derived = Value::map();
  for (const DerivedMeasure& measure : scene.derived_measures) {
    derived.add(measure.name, kType.text(measure, scene));
  }
  if (!scene.derived_measures.empty()) {
    list.items.push_back(std::move(derived));
  }
  return list;
}

}  // namespace

Key<Scene> measure_key() {
  const Type<Measure> word = choice_type(kMeasureNames);
  const Type<DerivedMeasure> derived = derived_type();
  const Schema by_name = with(object_schema(derived.schema, kExpressionNamePattern),
                              fmt::format(R"("maxProperties": {})", kMaxDerived));
  const AnyType type = {
      .allowed = "list of " + word.allowed +
                 " and of maps of [derived measures](#derived-measures) by name, or such a map "
                 "beside the default",
      .schema = any_of({with(array_schema(any_of({word.schema, by_name})), kUniqueItems), by_name}),
      .keys = derived.keys,
      .is_collection = true};
  return custom_key<Scene>("measure", type,
                           "what is measured at the end of each stage: [measures](#measures)",
                           read_measures)
      .defaults_to("all but `mixing` and `weight_paths`")
      .written_as(measures_text);
}

void put_numbers_into_derived(Scene& scene) {
  if (scene.derived_measures.empty()) {
    return;
  }
  const Value whole = scene_type().text(scene, scene);
  for (DerivedMeasure& derived : scene.derived_measures) {
    derived.expression =
        document::with_names_replaced(derived.expression, [&](std::string_view name) {
          const Value* value =
              name.find('.') != std::string_view::npos ? whole.find_path(name) : nullptr;
          const auto number = value != nullptr ? number_in<double>(value->text) : std::nullopt;
          return number || value == nullptr ? number : metres_in(value->text);
        });
  }
}

}  // namespace clca::scene
