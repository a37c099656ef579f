// clca explain: the keys of the scene format.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clca/record/quantity.hpp"
#include "clca/scene/format.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/units.hpp"
#include "clca/text/message.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/scene_options.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct ExplainOptions {
  std::vector<std::string> keys;
  std::string scene;
  std::string format = "text";
};

/// What a scene derives.
struct Derived {
  std::vector<scene::DerivedMeasure> measures;
  std::optional<scene::Conversion> units;
};

Derived derived_of(const std::string& file) {
  if (file.empty()) {
    return {};
  }
  const scene::AnyScene any = scene::parse_any_file(file);
  const auto* scene = std::get_if<scene::Scene>(&any);
  return scene == nullptr ? Derived() : Derived{scene->derived, scene::conversion(*scene)};
}

std::string text_of(const std::string& name, const std::string& title, const std::string& meaning,
                    const std::string& unit, const std::vector<std::string>& where) {
  return fmt::format("{}: {}{}{}{}\n  in {}\n", name, title, meaning.empty() ? "" : ": ", meaning,
                     unit.empty() ? "" : "; in " + unit, fmt::join(where, ", "));
}

/// A quantity that run.json and tables have, once for each meaning, in these units; empty if there
/// is none.
std::string quantity_text(const std::string& name, const std::optional<scene::Conversion>& units) {
  const std::size_t dot = name.find('.');
  std::vector<std::pair<const record::Quantity*, std::vector<std::string>>> found;
  for (const record::NamedQuantity& named : record::named_quantities()) {
    if (named.name != name && !(named.is_of_each && named.name == name.substr(0, dot))) {
      continue;
    }
    const auto same = std::ranges::find_if(found, [&](const auto& other) {
      return other.first->name == named.quantity->name &&
             other.first->unit == named.quantity->unit &&
             other.first->meaning == named.quantity->meaning;
    });
    (same == found.end() ? found.emplace_back(named.quantity, std::vector<std::string>()) : *same)
        .second.push_back(named.where);
  }
  std::string text;
  for (const auto& [quantity, where] : found) {
    text += text_of(name, std::string(quantity->name), std::string(quantity->meaning),
                    record::shown_unit(quantity->unit, units), where);
  }
  return text;
}

/// A key of scenes, a quantity, or what a scene derives.
std::string explained(const std::string& name, const Derived& derived) {
  const auto own = std::ranges::find(derived.measures, name, &scene::DerivedMeasure::name);
  if (own != derived.measures.end()) {
    return text_of(name, own->about.value_or(name), own->value,
                   own->unit == "1" ? "" : record::shown_unit(own->unit, derived.units),
                   {"run.json: the scene derives it"});
  }
  std::string quantity = quantity_text(name, derived.units);
  try {
    const std::string key = scene::explain(name);
    return quantity.empty() ? key : key + "\n" + quantity;
  } catch (const scene::UnknownKeyError& error) {
    if (!quantity.empty()) {
      return quantity;
    }
    const std::vector<record::NamedQuantity> declared = record::named_quantities();
    std::vector<std::string_view> names = text::names_of(declared);
    std::ranges::transform(derived.measures, std::back_inserter(names),
                           &scene::DerivedMeasure::name);
    const auto near = text::nearest(name, names);
    throw text::InputError(
        error.what() + (near ? fmt::format("; there is a quantity {}", text::shown(*near)) : ""));
  }
}

std::string text_of(const ExplainOptions& options) {
  if (options.format == "schema") {
    return scene::json_schema();
  }
  if (options.format == "quantities") {
    return record::quantities_table();
  }
  const Derived derived = derived_of(options.scene);
  std::vector<std::string> keys = options.keys;
  if (keys.empty()) {
    std::ranges::transform(derived.measures, std::back_inserter(keys),
                           &scene::DerivedMeasure::name);
  }
  if (keys.empty()) {
    keys.emplace_back();
  }
  if (options.format == "columns") {
    return record::columns_table(keys.front());
  }
  if (options.format == "markdown") {
    return scene::markdown_table(keys);
  }
  std::string text;
  for (const std::string& key : keys) {
    text += (text.empty() ? "" : "\n") + explained(key, derived);
  }
  return text;
}

}  // namespace

void add_explain_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("explain", "Explain the keys of a scene and the quantities of a run");
  auto options = std::make_shared<ExplainOptions>();
  add_option(command, "KEY", options->keys, "NAME",
             "Keys as for --set, such as rules.inertia or walls.motion, the last part of a key, or "
             "quantities of run.json and tables [the top]");
  add_option(command, "--scene", options->scene, "",
             "A scene in whose units quantities are, and whose derived measures may be among the "
             "names; without KEY all of these",
             scene_names());
  add_option(command, "--format", options->format, "FORMAT",
             "text, markdown (a table), schema (JSON Schema), quantities (a table of the "
             "measures), or columns (of a table of a run: KEY is its name, such as series, "
             "gas.series or sweep.runs; of the trajectory its datasets)",
             CLI::IsMember({"text", "markdown", "schema", "quantities", "columns"}))
      ->capture_default_str();
  set_action(command, [options] {
    print_out("{}", text_of(*options));
    return kDone;
  });
}

}  // namespace clca::cli
