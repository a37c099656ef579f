// clca diff: how two pictures differ.

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "clca/image/png.hpp"
#include "clca/render/difference.hpp"
#include "clca/store/file.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct DiffOptions {
  std::string first;
  std::string second;
  std::string out;
  int tolerance = 0;
  std::uint64_t pixels = 0;
};

render::Image read_picture(const std::string& file) {
  const auto bytes = as_input([&] { return store::read_whole(file, store::kMaxPictureBytes); });
  try {
    return image::decode_png(bytes).image;
  } catch (const std::runtime_error& error) {
    throw text::InputError(fmt::format("{}: {}", file, error.what()));
  }
}

int diff(const DiffOptions& options) {
  const render::Image first = read_picture(options.first);
  const render::Image second = read_picture(options.second);
  if (first.width != second.width || first.height != second.height) {
    print_out("sizes differ: {} x {} and {} x {}\n", first.width, first.height, second.width,
              second.height);
    return kFailed;
  }
  const render::Difference difference = render::difference_of(first, second, options.tolerance);
  if (!options.out.empty()) {
    store::write_whole(options.out, image::encode_png(difference.picture, {}));
  }
  if (difference.pixels == 0) {
    print_out("alike (largest channel difference {})\n", difference.largest);
    return kDone;
  }
  print_out("{} pixels differ by up to {} in x {} to {}, y {} to {}\n", difference.pixels,
            difference.largest, difference.box.min().x(), difference.box.max().x(),
            difference.box.min().y(), difference.box.max().y());
  return difference.pixels <= options.pixels ? kDone : kFailed;
}

}  // namespace

void add_diff_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "diff", "Compare two pictures; exit code 0 when they are alike, 1 when they differ");
  auto options = std::make_shared<DiffOptions>();
  command->add_option("A", options->first, "First PNG file")->required();
  command->add_option("B", options->second, "Second PNG file")->required();
  add_option(command, "--tolerance", options->tolerance, "",
             "Channel difference up to which two pixels count as alike", whole_number(0, 255))
      ->capture_default_str();
  add_option(command, "--pixels", options->pixels, "", "Number of pixels that may differ by more",
             whole_number())
      ->capture_default_str();
  command->add_option("-o,--output", options->out, "Write a picture of the differences");
  set_action(command, [options] { return diff(*options); });
}

}  // namespace clca::cli
