// clca check: shows a scene with every default filled in and the resources it needs.
// clca explain: the keys of the scene format.
// clca scenes: the scenes that come with the program.

#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "clca/record/quantity.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/format.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/units.hpp"
#include "clca/scene/walls.hpp"
#include "clca/text/message.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

/// A box of so many sites is filled in less than a second.
constexpr double kMaxFillSites = 1e7;

/// What the sites of each species come to.
void print_species(const scene::Scene& scene) {
  const auto units = scene::unit_conversion(scene);
  const double spacing = units ? units->spacing : 1;
  const std::string unit = units && units->length_unit == "m" ? "m" : "spacings";
  for (const scene::Species& species : scene.species) {
    Eigen::AlignedBox2d box;
    for (const lattice::Axial site : species.shape.sites()) {
      box.extend(lattice::position(site));
    }
    const auto sites = static_cast<double>(species.shape.size());
    print_out("# {}: {} sites, {:.4g} {} wide, {:.4g} high, area {:.4g} {}²", species.name,
              species.shape.size(), spacing * (box.sizes().x() + lattice::kColumnPitch), unit,
              spacing * (box.sizes().y() + 1), spacing * spacing * sites * lattice::kColumnPitch,
              unit);
    if (units && units->site_mass) {
      print_out(", mass {:.4g} kg", sites * units->site_mass->mass);
    }
    print_out("\n");
  }
}

void print(const scene::Scene& scene, bool draws) {
  const scene::ModelSize size = scene::model_size(scene);
  scene::check_walls(scene);
  if (static_cast<double>(size.columns) * size.rows <= kMaxFillSites) {
    scene::Scene checked = scene;
    if (!draws) {
      checked.output.frames.reset();
    }
    run::try_start(checked);
  } else {
    scene::check_room(scene);
  }
  print_out("{}", scene::to_yaml(scene));
  print_species(scene);
  if (const auto units = scene::unit_conversion(scene)) {
    print_out("# a step takes {:.4g} {}\n", units->time_step, units->time_unit);
  }
  print_out("# {} x {} sites, up to {} particles, about {:.1f} MiB of memory\n", size.columns,
            size.rows, size.max_particles, run::estimated_run_bytes(scene) / kMebibyte);
}

void print(const scene::BoltzmannScene& scene, bool /*draws*/) {
  const int threads = machine_thread_count();
  print_out("{}", scene::to_yaml(scene));
  print_out("# {} x {} runs of {} particles, about {:.1f} MiB of memory on {} threads\n",
            scene.restitutions.size(), scene.ensemble_size, scene.particles,
            scene::gas_run_bytes(scene, threads) / kMebibyte, threads);
}

int list_scenes(bool as_json) {
  const std::vector<Completion> scenes = installed_scenes();
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::size_t width = 0;
  for (const auto& [name, title] : scenes) {
    json.push_back({{"name", name}, {"title", title}});
    width = std::max(width, name.size());
  }
  if (as_json) {
    print_out("{}\n", json.dump(2));
  } else {
    for (const auto& [name, title] : scenes) {
      print_out("{:{}}  {}\n", name, width, title);
    }
  }
  return kDone;
}

struct ExplainOptions {
  std::vector<std::string> keys;
  std::string scene;
  std::string format = "text";
};

/// What a scene adds to the explanation of names: its derived measures and its units.
struct SceneAdditions {
  std::vector<scene::DerivedMeasure> measures;
  std::optional<scene::UnitConversion> units;
};

SceneAdditions scene_additions(const std::string& file) {
  if (file.empty()) {
    return {};
  }
  const scene::AnyScene any = scene::parse_any_file(file);
  const auto* scene = std::get_if<scene::Scene>(&any);
  return scene == nullptr ? SceneAdditions()
                          : SceneAdditions{scene->derived_measures, scene::unit_conversion(*scene)};
}

std::string text_of(const std::string& name, const std::string& title, const std::string& meaning,
                    const std::string& unit, const std::vector<std::string>& where) {
  return fmt::format("{}: {}{}{}{}\n  in {}\n", name, title, meaning.empty() ? "" : ": ", meaning,
                     unit.empty() ? "" : "; in " + unit, fmt::join(where, ", "));
}

/// A quantity that run.json and tables have, once for each meaning, in these units; empty if there
/// is none.
std::string quantity_text(const std::string& name,
                          const std::optional<scene::UnitConversion>& units) {
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
        .second.push_back(named.file);
  }
  std::string text;
  for (const auto& [quantity, where] : found) {
    text += text_of(name, std::string(quantity->name), std::string(quantity->meaning),
                    record::shown_unit(quantity->unit, units), where);
  }
  return text;
}

/// A key of scenes, a quantity, or what a scene derives.
std::string explained(const std::string& name, const SceneAdditions& additions) {
  const auto own = std::ranges::find(additions.measures, name, &scene::DerivedMeasure::name);
  if (own != additions.measures.end()) {
    return text_of(name, own->about.value_or(name), own->expression,
                   own->unit == "1" ? "" : record::shown_unit(own->unit, additions.units),
                   {"run.json: the scene derives it"});
  }
  std::string quantity = quantity_text(name, additions.units);
  try {
    const std::string key = scene::explanation(name);
    return quantity.empty() ? key : key + "\n" + quantity;
  } catch (const scene::UnknownKeyError& error) {
    if (!quantity.empty()) {
      return quantity;
    }
    const std::vector<record::NamedQuantity> declared = record::named_quantities();
    std::vector<std::string_view> names = text::names_of(declared);
    std::ranges::transform(additions.measures, std::back_inserter(names),
                           &scene::DerivedMeasure::name);
    const auto near = text::nearest_name(name, names);
    throw text::InputError(
        error.what() + (near ? fmt::format("; there is a quantity {}", text::quoted(*near)) : ""));
  }
}

std::string text_of(const ExplainOptions& options) {
  if (options.format == "schema") {
    return scene::json_schema();
  }
  if (options.format == "quantities") {
    return record::quantities_markdown();
  }
  const SceneAdditions additions = scene_additions(options.scene);
  std::vector<std::string> keys = options.keys;
  if (keys.empty()) {
    std::ranges::transform(additions.measures, std::back_inserter(keys),
                           &scene::DerivedMeasure::name);
  }
  if (keys.empty()) {
    keys.emplace_back();
  }
  if (options.format == "columns") {
    return record::columns_markdown(keys.front());
  }
  if (options.format == "markdown") {
    return scene::markdown_table(keys);
  }
  std::string text;
  for (const std::string& key : keys) {
    text += (text.empty() ? "" : "\n") + explained(key, additions);
  }
  return text;
}

}  // namespace

void add_check_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("check", "Read a scene, print it with all defaults, sizes and memory");
  auto options = std::make_shared<SceneOptions>();
  add_scene_options(command, *options);
  set_action(command, [options] {
    const bool draws = options->frames_every != std::uint64_t{0};
    std::visit([&](const auto& scene) { print(scene, draws); }, load_any_scene(*options));
    return kDone;
  });
}

void add_explain_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("explain", "Explain the keys of a scene and the quantities of a run");
  auto options = std::make_shared<ExplainOptions>();
  add_option(command, "KEY", options->keys, "NAME",
             "Keys as for --set, such as rules.inertia or walls.motion, the last part of a key, or "
             "quantities of run.json and tables [the top]");
  add_option(command, "--scene", options->scene, "",
             "Scene that sets the units and adds its derived measures; without KEY, explains all "
             "of these",
             scene_name_validator());
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

void add_scenes_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("scenes", "List the scenes that come with the program, for clca run");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "Print names and titles as JSON");
  set_action(command, [as_json] { return list_scenes(*as_json); });
}

}  // namespace clca::cli
