// clca plot: figures of a run folder.

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clca/store/run_folder.hpp"
#include "clca/text/input_error.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/package.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

using Json = nlohmann::json;

struct PlotOptions {
  std::string run;
  std::string folder;
  std::vector<std::string> only;
  std::string x;
  std::vector<std::string> y;
  std::vector<std::string> over;
  std::string y2;
  std::string log;
  std::vector<std::string> stages;
  std::string first;
  std::string last;
  std::uint64_t mean = 1;
  bool no_filling = false;
  std::string format = "png";
  std::string width = "960";
  std::string height;
  std::string x_limits;
  std::string y_limits;
};

bool is_in_mm(const std::string& length) {
  return length.ends_with("mm");
}

Json number_or_null(const std::string& text) {
  return text.empty() ? Json() : Json(std::stod(text));
}

Json limits_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  return colon == std::string::npos ? Json::array({Json(), Json()})
                                    : Json::array({number_or_null(text.substr(0, colon)),
                                                   number_or_null(text.substr(colon + 1))});
}

/// As `Choice` of _figures.py and `Look` of _chart.py.
Json to_json(const PlotOptions& options) {
  const bool in_mm = is_in_mm(options.width);
  if (!options.height.empty() && is_in_mm(options.height) != in_mm) {
    throw text::InputError("--width and --height: both in pixels, or both in mm");
  }
  return {{"only", options.only},
          {"choice",
           {{"x", options.x},
            {"y", options.y},
            {"over", options.over},
            {"y2", options.y2},
            {"log", options.log},
            {"stages", options.stages},
            {"first", number_or_null(options.first)},
            {"last", number_or_null(options.last)},
            {"filling", !options.no_filling},
            {"mean", options.mean}}},
          {"look",
           {{"format", options.format},
            {"in_mm", in_mm},
            {"width", std::stod(options.width)},
            {"height", number_or_null(options.height)},
            {"x_limits", limits_of(options.x_limits)},
            {"y_limits", limits_of(options.y_limits)}}}};
}

int draw_all(const PlotOptions& options) {
  const auto write = [&](const std::string& name, std::span<const std::uint8_t> bytes) {
    const store::OutputFolder folder =
        store::named_folder(options.folder, options.run, store::kPlotsFolder);
    folder.write(name, bytes);
    print_out("{}\n", folder.path(name).string());
  };
  return run_package("plot", to_json(options), {options.run}, write);
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
  command.option("--format", &options->format, "Format of the files")
      .type("FORMAT")
      .values(one_of({"png", "svg", "pdf"}, LetterCase::ignored))
      .show_default();
  command.option("--width", &options->width, "Pixels, 96 to the inch of a PDF, or mm of paper")
      .values(length_of_figure())
      .show_default();
  command.option("--height", &options->height, "The same of the height [as the figure needs]")
      .values(length_of_figure());
  command
      .option("--x", &options->x,
              "Of a sweep a varied key or a measure; of a run a column [the first key; time]")
      .type("NAME");
  command
      .option("--y", &options->y, "Only these measures; of a run columns, in place of its figures")
      .type("NAME,...")
      .delimiter(',')
      .one_value();
  command
      .option("--over", &options->over,
              "Keys with a curve for each value, the others with a figure; of a run a column [all "
              "keys but x; the stage]")
      .type("NAME,...")
      .delimiter(',')
      .one_value();
  command
      .option("--y2", &options->y2,
              "Of a run a column on a second axis, beside --y or a figure over time")
      .type("NAME");
  command.option("--log", &options->log, "Logarithmic axes")
      .type("AXES")
      .values(one_of({"x", "y", "xy"}));
  command.option("--x-range", &options->x_limits, "Limits of the axis x; either may be left out")
      .type("LOW:HIGH")
      .values(limits_of_axis());
  command.option("--y-range", &options->y_limits, "Limits of the axis y")
      .type("LOW:HIGH")
      .values(limits_of_axis());
  command.option("--stage", &options->stages, "Only these stages")
      .type("NAME,...")
      .delimiter(',')
      .one_value();
  command.flag("--no-filling", &options->no_filling, "Leave out stages that fill the box");
  command.option("--from", &options->first, "First time, or step where there is no time")
      .type("TIME")
      .values(finite_number());
  command.option("--to", &options->last, "Last time or step").type("TIME").values(finite_number());
  command.option("--running-mean", &options->mean, "Mean over so many rows around each")
      .type("ROWS")
      .values(whole_number(1, 1'000'000));
  command.action([options] { return draw_all(*options); });
}

}  // namespace clca::cli
