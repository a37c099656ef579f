// clca explain: the keys of the scene format.

#include <memory>
#include <string>
#include <vector>

#include "clca/scene/format.hpp"
#include "cli/command.hpp"
#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct ExplainOptions {
  std::vector<std::string> keys;
  std::string format = "text";
};

std::string text_of(const ExplainOptions& options) {
  if (options.format == "schema") {
    return scene::json_schema();
  }
  const std::vector<std::string> keys =
      options.keys.empty() ? std::vector<std::string>{""} : options.keys;
  if (options.format == "markdown") {
    return scene::markdown_table(keys);
  }
  std::string text;
  for (const std::string& key : keys) {
    text += (text.empty() ? "" : "\n") + scene::explain(key);
  }
  return text;
}

}  // namespace

void add_explain_command(CommandLine& command_line) {
  Command command = command_line.command("explain", "Explain the keys of a scene");
  auto options = std::make_shared<ExplainOptions>();
  command.option("KEY", &options->keys,
                 "Keys as for --set, such as rules.inertia or walls.motion [the top]");
  command.option("--format", &options->format, "text, markdown (a table) or schema (JSON Schema)")
      .type("FORMAT")
      .values(one_of({"text", "markdown", "schema"}))
      .show_default();
  command.action([options] {
    print_out("{}", text_of(*options));
    return static_cast<int>(ExitCode::done);
  });
}

}  // namespace clca::cli
