// clca scenes: the scenes that come with the program.

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/scene_options.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

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

void add_scenes_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("scenes", "List the scenes that come with the program, for clca run");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "Print names and titles as JSON");
  set_action(command, [as_json] { return list_scenes(*as_json); });
}

}  // namespace clca::cli
