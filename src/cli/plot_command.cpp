// clca plot: figures of a run folder.

#include <filesystem>
#include <memory>

#include "clca/plot/plot.hpp"
#include "clca/store/run_folder.hpp"
#include "cli/command.hpp"
#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
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

void add_plot_command(CommandLine& command_line) {
  Command command =
      command_line.command("plot", "Draw figures of the tables in a run folder, with gnuplot");
  auto options = std::make_shared<PlotOptions>();
  const OptionValues pixels = whole_number(100, 10'000);
  command.option("DIR", &options->run, "Folder that a run has left").required();
  command.option("-o,--output", &options->folder, "Folder to write to [DIR/plots]");
  command.option("--only", &options->only, "Draw only these figures")
      .type("NAME,...")
      .delimiter(',')
      .one_value();
  command
      .choice("--format", &options->appearance.format,
              {{"png", plot::Format::png}, {"svg", plot::Format::svg}, {"pdf", plot::Format::pdf}},
              "Format of the files", LetterCase::ignored)
      .type("FORMAT")
      .show_default("png");
  command.option("--width", &options->appearance.width, "Pixels, 96 to the inch of a PDF")
      .values(pixels)
      .show_default();
  command.option("--height", &options->appearance.height, "Pixels, 96 to the inch of a PDF")
      .values(pixels)
      .show_default();
  command.action([options] {
    draw_all(*options);
    return static_cast<int>(ExitCode::done);
  });
}

}  // namespace clca::cli
