// clca plot: figures of a run folder.

#include <filesystem>
#include <memory>
#include <optional>
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
  std::string first;
  std::string last;
  std::string x_limits;
  std::string y_limits;
  bool no_filling = false;
  std::string width = "960";
  std::string height;
  plot::Appearance appearance;
};

bool is_in_mm(const std::string& length) {
  return length.ends_with("mm");
}

std::optional<double> number_or_none(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(std::stod(text));
}

plot::Limits limits_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  return colon == std::string::npos ? plot::Limits()
                                    : plot::Limits(number_or_none(text.substr(0, colon)),
                                                   number_or_none(text.substr(colon + 1)));
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
  appearance.x_limits = limits_of(options.x_limits);
  appearance.y_limits = limits_of(options.y_limits);
  return appearance;
}

void draw_all(const PlotOptions& options) {
  plot::Choice choice = options.choice;
  choice.first = number_or_none(options.first);
  choice.last = number_or_none(options.last);
  choice.filling = !options.no_filling;
  const plot::Appearance appearance = appearance_of(options);
  const std::atomic<int>& stop = catch_stop_signals();
  const auto pictures = plot::pictures(options.run, options.only, choice, appearance, &stop);
  const store::OutputFolder folder =
      store::named_folder(options.folder, options.run, store::kPlotsFolder);
  for (const plot::Picture& picture : pictures) {
    const std::string file = picture.name + "." + picture.format;
    folder.write(file, picture.bytes);
    print_out("{}\n", folder.path(file).string());
  }
}

}  // namespace

void add_plot_command(CommandLine& command_line) {
  Command command = command_line.command(
      "plot", "Draw figures of the tables in a run folder, with Python and matplotlib");
  auto options = std::make_shared<PlotOptions>();
  command.option("DIR", &options->run, "Folder that a run has left").required();
  command.option("-o,--output", &options->folder, "Folder to write to [DIR/plots]");
  command.option("--only", &options->only, "Draw only these figures")
      .type("NAME,...")
      .delimiter(',')
      .one_value();
  command.option("--format", &options->appearance.format, "Format of the files")
      .type("FORMAT")
      .values(one_of({"png", "svg", "pdf"}, LetterCase::ignored))
      .show_default();
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
  command.option("--y2", &options->choice.y2, "Of a run a column on a second axis, beside --y")
      .type("NAME");
  command.option("--log", &options->choice.log, "Logarithmic axes")
      .type("AXES")
      .values(one_of({"x", "y", "xy"}));
  command.option("--x-range", &options->x_limits, "Limits of the axis x; either may be left out")
      .type("LOW:HIGH")
      .values(limits_of_axis());
  command.option("--y-range", &options->y_limits, "Limits of the axis y")
      .type("LOW:HIGH")
      .values(limits_of_axis());
  command.option("--stage", &options->choice.stages, "Only these stages")
      .type("NAME,...")
      .delimiter(',')
      .one_value();
  command.flag("--no-filling", &options->no_filling, "Leave out stages that fill the box");
  command.option("--from", &options->first, "First time, or step where there is no time")
      .type("TIME")
      .values(finite_number());
  command.option("--to", &options->last, "Last time or step").type("TIME").values(finite_number());
  command.option("--running-mean", &options->choice.mean, "Mean over so many rows around each")
      .type("ROWS")
      .values(whole_number(1, 1'000'000));
  command.action([options] {
    draw_all(*options);
    return static_cast<int>(ExitCode::done);
  });
}

}  // namespace clca::cli
