// clca export: the trajectory of a run in formats of other programs.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "clca/export/export.hpp"
#include "clca/run/setup.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "cli/command.hpp"
#include "cli/input.hpp"
#include "cli/option_values.hpp"
#include "cli/scene_options.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  fs::path run;
  exports::Format format = exports::Format::vtp;
  fs::path file;
  exports::FrameSelection choice;
  SceneOptions scene;  ///< the limit on memory
};

/// A run with a trajectory and the selected frames.
struct Source {
  std::string name;
  scene::Scene scene;
  std::unique_ptr<store::Trajectory> trajectory;
};

Source open_run(const ExportOptions& options) {
  const store::RunSummary summary = store::read_summary(options.run / "run.json");
  if (summary.kind == "boltzmann") {
    throw exports::ExportError(
        fmt::format("{}: expected a run of grains, found one of the Boltzmann equation, which has "
                    "no trajectory",
                    options.run.string()));
  }
  std::error_code unknown;
  if (!fs::exists(options.run / "trajectory", unknown) && !unknown) {
    throw exports::ExportError(
        fmt::format("{}: the run has left no trajectory; run the scene again with "
                    "output.trajectory in it",
                    options.run.string()));
  }
  Source source = {summary.scene, scene::parse_file(options.run / "scene.yaml"), nullptr};
  source.scene.name = summary.scene;
  const double limit = memory_limit(options.scene);
  check_memory(source.scene, limit);
  source.trajectory = std::make_unique<store::Trajectory>(options.run, source.scene,
                                                          run::initial_state(source.scene), limit);
  exports::selected_frames(source.trajectory->frames(),
                           options.choice);  // before anything is written
  return source;
}

store::OutputFile output_file(const ExportOptions& options, const std::string& scene) {
  if (options.file.empty()) {
    return {store::OutputFolder(options.run).subfolder(store::kExportFolder),
            scene + std::string(exports::ending(options.format))};
  }
  if (options.file.has_parent_path()) {
    store::make_folder(options.file.parent_path());
  }
  return store::named_file(options.file);
}

int export_run(const ExportOptions& options) {
  const Source source = as_input([&] { return open_run(options); });
  const std::atomic<int>& stop = catch_stop_signals();
  const store::OutputFile file = output_file(options, source.name);
  const auto writer =
      exports::writer(options.format, file, source.scene, run::initial_state(source.scene).kinds);
  const std::size_t frames = exports::write(*source.trajectory, options.choice, *writer, stop);
  print_out("{} frames\n{}\n", frames, file.path().string());
  const int signal = stop.load();
  return signal == 0 ? static_cast<int>(ExitCode::done)
                     : static_cast<int>(ExitCode::signal_base) + signal;
}

void add_choice_options(Command& command, exports::FrameSelection& choice) {
  command.option("--from", &choice.from, "First step").type("STEP").values(whole_number());
  command.option("--to", &choice.until, "Last step").type("STEP").values(whole_number());
  command
      .option("--every", &choice.every,
              "Least number of steps between frames of a stage [all frames]")
      .type("STEPS")
      .values(whole_number(1));
}

}  // namespace

void add_export_command(CommandLine& command_line) {
  Command command = command_line.command(
      "export", "The trajectory of a run for ParaView (vtp), OVITO (gsd, xyz) or readers of H5MD");
  auto options = std::make_shared<ExportOptions>();
  command.option("DIR", &options->run, "Folder that a run with output.trajectory has left")
      .required();
  command
      .choice("--format", &options->format,
              {{"vtp", exports::Format::vtp},
               {"gsd", exports::Format::gsd},
               {"xyz", exports::Format::xyz},
               {"h5md", exports::Format::h5md}},
              "Format")
      .required()
      .type("FORMAT");
  command
      .option("-o,--output", &options->file,
              "File to write, of vtp the .pvd with the others beside it "
              "[DIR/export/SCENE with .pvd, .gsd, .xyz or .h5]")
      .type("FILE");
  add_choice_options(command, options->choice);
  add_memory_limit(command, options->scene);
  command.action([options] { return export_run(*options); });
}

}  // namespace clca::cli
