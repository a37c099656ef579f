// clca plot: figures of a run folder.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "clca/plot/plot.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/text/input_error.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct PlotOptions {
  std::string run;
  std::string folder;
  std::vector<std::string> only;
  plot::Choice choice;
  std::string log;
  std::string width = "960";
  std::string height;
  plot::Appearance appearance;
};

bool is_in_mm(const std::string& length) {
  return length.ends_with("mm");
}

plot::Appearance appearance_of(const PlotOptions& options) {
  plot::Appearance appearance = options.appearance;
  appearance.in_mm = is_in_mm(options.width);
  appearance.width = std::stod(options.width);
  if (!options.height.empty()) {
    if (is_in_mm(options.height) != appearance.in_mm) {
      throw text::InputError("--width and --height: both in pixels, or both in mm");
    }
    appearance.height = std::stod(options.height);
  }
  return appearance;
}

void draw_all(const PlotOptions& options) {
  plot::Choice choice = options.choice;
  choice.log_x = options.log.starts_with('x');
  choice.log_y = options.log.ends_with('y');
  const plot::Appearance appearance = appearance_of(options);
  const auto figures = plot::figures(options.run, options.only, plot::template_folder(), choice);
  const store::OutputFolder folder =
      store::named_folder(options.folder, options.run, store::kPlotsFolder);
  const std::atomic<int>& stop = catch_stop_signals();
  for (const plot::Figure& figure : figures) {
    const auto picture = plot::draw(figure, appearance, &stop);
    const std::string file = figure.name + "." + plot::ending(appearance.format);
    folder.write(file, picture);
    print_out("{}\n", folder.path(file).string());
  }
}

}  // namespace

void add_plot_command(CommandLine& command_line) {
  Command command =
      command_line.command("plot", "Draw figures of the tables in a run folder, with gnuplot");
  auto options = std::make_shared<PlotOptions>();
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
  command.option("--width", &options->width, "Pixels, 96 to the inch of a PDF, or mm of paper")
      .values(length_of_figure())
      .show_default();
  command.option("--height", &options->height, "The same of the height [as the figure needs]")
      .values(length_of_figure());
  command
      .option("--x", &options->choice.x,
              "Of a sweep a varied key or a measure; of a run a column [the first key; time]")
      .type("NAME");
  command
      .option("--y", &options->choice.y,
              "Only these measures; of a run columns, in place of its figures")
      .type("NAME,...")
      .delimiter(',')
      .one_value();
  command
      .option("--over", &options->choice.over,
              "Keys with a curve for each value, the others with a figure; of a run a column [all "
              "keys but x; the stage]")
      .type("NAME,...")
      .delimiter(',')
      .one_value();
  command.option("--log", &options->log, "Logarithmic axes")
      .type("AXES")
      .values(one_of({"x", "y", "xy"}));
  command.action([options] {
    draw_all(*options);
    return static_cast<int>(ExitCode::done);
  });
}

}  // namespace clca::cli
