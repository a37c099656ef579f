// clca explain: the keys of the scene format.

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "clca/run/quantity.hpp"
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

/// Of keys of a scene, or of a quantity that run.json and tables have.
std::string explained(const std::string& name) {
  try {
    return scene::explain(name);
  } catch (const scene::UnknownKeyError&) {
    const run::Quantity* quantity = nullptr;
    for (auto* find : {run::find_quantity, run::find_gas_quantity, run::find_sweep_column}) {
      quantity = quantity != nullptr ? quantity : find(name);
    }
    if (quantity == nullptr) {
      throw;
    }
    return fmt::format(
        "{}: {}{}{}\n  a number in run.json or a column of a table of the run; in tables of a "
        "sweep\n",
        name, quantity->name,
        quantity->meaning.empty() ? "" : fmt::format(": {}", quantity->meaning),
        quantity->unit.empty() ? "" : fmt::format("; in {}", quantity->unit));
  }
}

std::string text_of(const ExplainOptions& options) {
  if (options.format == "schema") {
    return scene::json_schema();
  }
  if (options.format == "quantities") {
    return run::quantities_table();
  }
  const std::vector<std::string> keys =
      options.keys.empty() ? std::vector<std::string>{""} : options.keys;
  if (options.format == "columns") {
    return run::columns_table(keys.front());
  }
  if (options.format == "markdown") {
    return scene::markdown_table(keys);
  }
  std::string text;
  for (const std::string& key : keys) {
    text += (text.empty() ? "" : "\n") + explained(key);
  }
  return text;
}

}  // namespace

void add_explain_command(CommandLine& command_line) {
  Command command =
      command_line.command("explain", "Explain the keys of a scene and the quantities of a run");
  auto options = std::make_shared<ExplainOptions>();
  command
      .option(
          "KEY", &options->keys,
          "Keys as for --set, such as rules.inertia or walls.motion, the last part of a key, or "
          "quantities of run.json [the top]")
      .type("NAME")
      .values(key_of_scene());
  command
      .option("--format", &options->format,
              "text, markdown (a table), schema (JSON Schema), quantities (a table of the "
              "measures), or "
              "columns (of a table of a run: KEY is its name, such as series, gas.series or "
              "sweep.runs; of the trajectory its datasets)")
      .type("FORMAT")
      .values(one_of({"text", "markdown", "schema", "quantities", "columns"}))
      .show_default();
  command.action([options] {
    print_out("{}", text_of(*options));
    return static_cast<int>(ExitCode::done);
  });
}

}  // namespace clca::cli
