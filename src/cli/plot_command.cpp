// clca plot: figures of a run folder.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>

#include "clca/plot/plot.hpp"
#include "clca/store/run_folder.hpp"
#include "cli/commands.hpp"
#include "cli/option_values.hpp"
#include "cli/signals.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct PlotOptions {
  std::string run;
  std::string folder;
  std::vector<std::string> only;
  plot::Appearance appearance;
};

void draw_all(const PlotOptions& options) {
  const auto figures = plot::figures(options.run, options.only, plot::template_folder());
  const store::OutputFolder folder =
      store::named_folder(options.folder, options.run, store::kPlotsFolder);
  const std::atomic<int>& stop = catch_stop_signals();
  for (const plot::Figure& figure : figures) {
    const auto picture = plot::draw(figure, options.appearance, &stop);
    const std::string file = figure.name + "." + plot::ending(options.appearance.format);
    folder.write(file, picture);
    print_out("{}\n", folder.path(file).string());
  }
}

}  // namespace

void add_plot_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("plot", "Draw figures of the tables in a run folder, with gnuplot");
  auto options = std::make_shared<PlotOptions>();
  const CLI::Validator pixels = whole_number(100, 10'000);
  command->add_option("DIR", options->run, "Folder that a run has left")->required();
  command->add_option("-o,--output", options->folder, "Folder to write to [DIR/plots]");
  command->add_option("--only", options->only, "Draw only these figures")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--format", options->appearance.format, "Format of the files")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, plot::Format>{
              {"png", plot::Format::png}, {"svg", plot::Format::svg}, {"pdf", plot::Format::pdf}},
          CLI::ignore_case))
      ->default_str("png");
  command->add_option("--width", options->appearance.width, "Pixels, 96 to the inch of a PDF")
      ->check(pixels)
      ->capture_default_str();
  command->add_option("--height", options->appearance.height, "Pixels, 96 to the inch of a PDF")
      ->check(pixels)
      ->capture_default_str();
  command->callback([options] { draw_all(*options); });
}

}  // namespace clca::cli
