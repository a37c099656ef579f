// clca check: shows a scene with every default filled in and the resources it needs.
// clca scenes: the scenes that come with the program.

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "clca/run/setup.hpp"
#include "clca/scene/resolve.hpp"
#include "clca/scene/units.hpp"
#include "clca/scene/walls.hpp"
#include "cli/command.hpp"
#include "cli/scene_options.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

/// A fill of so many particles takes less than a second.
constexpr double kFewSites = 1e7;

/// What the sites of each species come to.
void print_species(const scene::Scene& scene) {
  const auto units = scene::conversion(scene);
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
    if (units && units->site) {
      print_out(", mass {:.4g} kg", sites * units->site->mass);
    }
    print_out("\n");
  }
}

void print(const scene::Scene& scene, bool draws) {
  const scene::Size size = scene::size_of(scene);
  scene::check_walls(scene);
  if (static_cast<double>(size.columns) * size.rows <= kFewSites) {
    scene::Scene checked = scene;
    if (!draws) {
      checked.output.frames.reset();
    }
    run::check_start(checked);
  } else {
    scene::check_room(scene);
  }
  print_out("{}", scene::to_yaml(scene));
  print_species(scene);
  if (const auto units = scene::conversion(scene)) {
    print_out("# a step takes {:.4g} {}\n", units->time_step, units->time_unit);
  }
  print_out("# {} x {} sites, up to {} particles, about {:.1f} MiB of memory\n", size.columns,
            size.rows, size.particles, run::memory_of(scene) / kMebibyte);
}

void print(const scene::BoltzmannScene& scene, bool /*draws*/) {
  const int threads = machine_threads();
  print_out("{}", scene::to_yaml(scene));
  print_out("# {} x {} runs of {} particles, about {:.1f} MiB of memory on {} threads\n",
            scene.restitutions.size(), scene.ensemble, scene.particles,
            scene::bytes_of(scene, threads) / kMebibyte, threads);
}

int list_scenes(bool as_json) {
  const std::vector<Candidate> scenes = scenes_of_program();
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

void add_scenes_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("scenes", "List the scenes that come with the program, for clca run");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "Print names and titles as JSON");
  set_action(command, [as_json] { return list_scenes(*as_json); });
}

}  // namespace clca::cli
