// Commands that the Python package carries out on finished folders: plot, report, export, compare.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/trajectory.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/package.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Bytes = std::span<const std::uint8_t>;

/// An option or, required, an argument that Python reads.
struct PackageOption {
  const char* name;
  const char* type;  ///< in the help; one that ends in ",..." is a list
  const char* what;
  CLI::Validator values = CLI::Validator("");
  const char* without = "";  ///< what Python takes if it is not given
};

void add_options(CLI::App* command, const std::vector<PackageOption>& options) {
  for (const PackageOption& option : options) {
    CLI::Option* added = command->add_option(option.name, std::as_const(option.what));
    added->type_name(option.type)->default_str(option.without)->transform(option.values);
    added->required(added->get_positional());
    if (std::string_view(option.type).ends_with(",...")) {
      added->delimiter(',')
          ->expected(CLI::detail::expected_max_vector_size)
          ->allow_extra_args(false);
    }
  }
}

/// The options that are given, by their long names: lists, flags and texts.
Json given_options(const CLI::App& command) {
  auto given = Json::object();
  for (const CLI::Option* option : command.get_options()) {
    Json& value = given[option->get_single_name()];
    if (option->empty()) {
      given.erase(option->get_single_name());
    } else if (option->get_delimiter() != '\0') {
      value = option->as<std::vector<std::string>>();
    } else if (option->get_items_expected_max() == 0) {
      value = true;
    } else {
      value = option->as<std::string>();
    }
  }
  return given;
}

/// Empty if it is not given.
std::string text_of(const CLI::App& command, const char* option) {
  return command.get_option(option)->as<std::string>();
}

int draw_figures(const CLI::App& command) {
  const std::string run = text_of(command, "DIR");
  return run_python_command(
      "plot", given_options(command), {run}, [&](const std::string& name, Bytes bytes) {
        const store::OutputFolder folder =
            store::named_folder(text_of(command, "--output"), run, store::kPlotsFolder);
        folder.write(name, bytes);
        print_out("{}\n", folder.path(name).string());
      });
}

int write_report(const CLI::App& command) {
  const std::string run = text_of(command, "DIR");
  const std::string file = text_of(command, "--output");
  return run_python_command("report", given_options(command), {run},
                            [&](const std::string& name, Bytes page) {
                              const store::OutputFolder folder(run);
                              if (file.empty()) {
                                folder.write(name, page);
                              } else {
                                store::write_whole_file(file, page);
                              }
                              print_out("{}\n", file.empty() ? folder.path(name).string() : file);
                            });
}

int compare_runs(const CLI::App& command) {
  const std::string path = text_of(command, "--output");
  const store::OutputFolder folder(path);
  folder.require_clca_folder();
  const int code =
      run_python_command("compare", given_options(command),
                         {text_of(command, "AUTOMATON"), text_of(command, "BOLTZMANN"), path},
                         [&](const std::string& name, Bytes bytes) { folder.write(name, bytes); });
  if (code == kDone) {
    print_out("{}\n", path);
  }
  return code;
}

/// With the endings of their files, as `FORMATS` of _export.py.
const std::vector<std::pair<std::string, std::string>>& export_formats() {
  static const std::vector<std::pair<std::string, std::string>> kAll = {
      {"vtp", ".pvd"}, {"gsd", ".gsd"}, {"xyz", ".xyz"}, {"h5md", ".h5"}};
  return kAll;
}

int export_run(const CLI::App& command) {
  const fs::path run = text_of(command, "DIR");
  const fs::path named = text_of(command, "--output");
  const std::string scene =
      read_as_input([&] { return store::read_summary(run / "run.json"); }).scene;
  std::error_code unknown;  // Python reads without a look at checksums
  if (fs::exists(run / "trajectory", unknown)) {
    read_as_input([&] { store::check_trajectory_parts(run); });
  }
  const fs::path target =
      fs::current_path() / (named.empty() ? run / store::kExportFolder : named.parent_path());
  // At the end the folder is gone if it is new and empty.
  const std::shared_ptr<void> end(nullptr, [target, is_new = !fs::exists(target)](void*) {
    std::error_code not_empty;
    if (is_new) {
      fs::remove(target, not_empty);
    }
  });
  store::make_folder(target);
  const store::OutputFolder folder = store::OutputFolder(run).subfolder(store::kExportFolder);
  const std::string name = scene + std::ranges::find(export_formats(), text_of(command, "--format"),
                                                     &std::pair<std::string, std::string>::first)
                                       ->second;
  const fs::path path = named.empty() ? folder.path(name) : named;
  store::AtomicFile file = named.empty() ? folder.create(name) : store::AtomicFile(path);
  const auto beside = [&](const std::string& other, Bytes bytes) {
    if (named.empty()) {
      folder.write(other, bytes);
    } else {
      store::write_whole_file(path.parent_path() / other, bytes);
    }
  };
  Json options = given_options(command);
  options["output"] = path.string();
  const int code =
      run_python_command("export", options, {run, file.temporary_path()}, beside, {}, target);
  if (code == kDone) {
    file.finish();
    print_out("{}\n", path.string());
  }
  return code;
}

}  // namespace

void add_plot_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "plot", "Draw figures of the tables in a run folder, with Python and matplotlib");
  add_options(
      command,
      {{"DIR", "TEXT", "Folder that a run has left"},
       {"-o,--output", "TEXT", "Folder to write to [DIR/plots]"},
       {"--only", "NAME,...", "Draw only these figures"},
       {"--format", "FORMAT", "Format of the files",
        CLI::IsMember({"png", "svg", "pdf"}, CLI::ignore_case), "png"},
       {"--width", "TEXT", "Pixels, 96 to the inch of a PDF, or mm of paper",
        figure_length_validator(), "960"},
       {"--height", "TEXT", "The same of the height [as the figure needs]",
        figure_length_validator()},
       {"--x", "NAME", "Sweep: a varied key or measure; run: a column [the first key; time]"},
       {"--y", "NAME,...",
        "Sweep: only these measures, also as STAGE.MEASURE; run: columns, in place of its figures"},
       {"--over", "NAME,...",
        "Sweep: keys with a curve for each value, the others with a figure; run: a column [all "
        "keys but x; the stage]"},
       {"--y2", "NAME", "Run: a column on a second axis, beside --y or a figure over time"},
       {"--log", "AXES", "Logarithmic axes", CLI::IsMember({"x", "y", "xy"})},
       {"--x-range", "LOW:HIGH", "Limits of the axis x; either may be left out",
        axis_limits_validator()},
       {"--y-range", "LOW:HIGH", "Limits of the axis y", axis_limits_validator()},
       {"--stage", "NAME,...", "Only these stages"}});
  command->add_flag("--no-filling")->description("Leave out stages that fill the box");
  add_options(command, {{"--from", "TIME", "First time, or step where there is no time",
                         finite_number_validator()},
                        {"--to", "TIME", "Last time or step", finite_number_validator()},
                        {"--running-mean", "ROWS", "Mean over so many rows around each",
                         whole_number_validator(1, 1'000'000)}});
  set_action(command, [command] { return draw_figures(*command); });
}

void add_report_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "report", "Write a page about a run or a sweep: measures, figures, pictures");
  add_options(command,
              {{"DIR", "TEXT", "Folder that a run or a sweep has left"},
               {"-o,--output", "TEXT", "Page to write [DIR/report.html]"},
               {"--max-frames", "UINT",
                "Number of pictures in the page, at most [as many as keep the page below 20 MB]",
                whole_number_validator(0, 100'000)}});
  set_action(command, [command] { return write_report(*command); });
}

void add_compare_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "compare",
      "Energies of a run of grains beside those of a Boltzmann run, as tables and a figure");
  add_options(
      command,
      {{"AUTOMATON", "TEXT", "Folder of a run with output.fields"},
       {"BOLTZMANN", "TEXT", "Folder of a run with output.histograms"},
       {"-o,--output", "TEXT", "Folder to write to", CLI::Validator(""), "renders/comparison"},
       {"--stage", "NAME", "Stage of the run of grains [the last with a fluctuation table]"},
       {"--time", "FLOAT", "Time of the histogram [the latest]", finite_number_validator()},
       {"--restitution", "FLOAT", "Restitution to choose if the Boltzmann run has several",
        finite_number_validator()}});
  set_action(command, [command] { return compare_runs(*command); });
}

void add_export_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "export", "The trajectory of a run for ParaView (vtp), OVITO (gsd, xyz) or readers of H5MD");
  add_options(command,
              {{"DIR", "TEXT", "Folder that a run with output.trajectory has left"},
               {"--format", "FORMAT", "Format", CLI::IsMember(export_formats())},
               {"-o,--output", "FILE",
                "File to write, of vtp the .pvd with the others beside it [DIR/export/SCENE with "
                "the ending of the format]"},
               {"--from", "STEP", "First step", whole_number_validator()},
               {"--to", "STEP", "Last step", whole_number_validator()},
               {"--every", "STEPS", "Least number of steps between frames of a stage [all frames]",
                whole_number_validator(1)}});
  command->get_option("--format")->required();
  set_action(command, [command] { return export_run(*command); });
}

}  // namespace clca::cli
