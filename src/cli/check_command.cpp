// clca check: what a scene says, with every default filled in, and what it needs.

#include <fmt/format.h>

#include <memory>

#include "clca/scene/resolve.hpp"
#include "clca/scene/walls.hpp"
#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/scene_options.hpp"

namespace clca::cli {

namespace {

void check(const SceneOptions& options) {
  constexpr double kMebibyte = 1 << 20;
  const scene::Scene scene = load_scene(options);
  scene::check_walls(scene);
  const scene::Size size = scene::size_of(scene);
  fmt::print("{}", scene::to_yaml(scene));
  fmt::print("# {} x {} sites, up to {} particles, about {:.1f} MiB of memory\n", size.columns,
             size.rows, size.particles, size.bytes / kMebibyte);
}

}  // namespace

void add_check_command(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("check", "Read a scene, print it with all defaults, sizes and memory");
  auto options = std::make_shared<SceneOptions>();
  add_scene_options(*command, *options);
  command->callback([options, &code] {
    check(*options);
    code = static_cast<int>(ExitCode::done);
  });
}

}  // namespace clca::cli
