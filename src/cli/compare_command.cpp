// clca compare: a run of grains beside one of the Boltzmann equation, by the Python package.

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "clca/store/output_folder.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/package.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct CompareOptions {
  std::string automaton;
  std::string boltzmann;
  std::string folder = "renders/comparison";
  std::optional<std::string> stage;
  std::optional<double> time;
  std::optional<double> restitution;
};

template <class T>
nlohmann::json value_or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

int compare_runs(const CompareOptions& options) {
  const store::OutputFolder folder(options.folder);
  folder.require_own();
  const int code = run_package("compare",
                               {{"stage", value_or_null(options.stage)},
                                {"time", value_or_null(options.time)},
                                {"restitution", value_or_null(options.restitution)}},
                               {options.automaton, options.boltzmann, options.folder},
                               [&](const std::string& name, std::span<const std::uint8_t> bytes) {
                                 folder.write(name, bytes);
                               });
  if (code == 0) {
    print_out("{}\n", options.folder);
  }
  return code;
}

}  // namespace

void add_compare_command(CommandLine& command_line) {
  Command command = command_line.command(
      "compare",
      "Energies of an automaton run beside those of a Boltzmann run, as tables and a figure");
  auto options = std::make_shared<CompareOptions>();
  command.option("AUTOMATON", &options->automaton, "Folder of a run with output.fields").required();
  command.option("BOLTZMANN", &options->boltzmann, "Folder of a run with output.histograms")
      .required();
  command.option("-o,--output", &options->folder, "Folder to write to").show_default();
  command
      .option("--stage", &options->stage,
              "Stage of the automaton [the last with a fluctuation table]")
      .type("NAME");
  command.option("--time", &options->time, "Time of the histogram [the latest]")
      .values(finite_number());
  command
      .option("--restitution", &options->restitution,
              "Restitution to choose if the Boltzmann run has several")
      .values(finite_number());
  command.action([options] { return compare_runs(*options); });
}

}  // namespace clca::cli
