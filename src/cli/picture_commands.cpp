// clca render: draws runs from their trajectories.
// clca diff: how two pictures differ.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "clca/drawing/redraw.hpp"
#include "clca/image/png.hpp"
#include "clca/render/difference.hpp"
#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/package.hpp"
#include "cli/progress_line.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::vector<fs::path> runs;
  drawing::RedrawOptions redraw;
  fs::path folder;  ///< for the pictures
  // Of a space-time picture.
  drawing::SpaceTimeOptions space_time;
  bool surface = false;
  SceneOptions scene;
  std::vector<scene::Override> look;  ///< options that are short for --set
  bool quiet = false;
};

scene::Scene scene_of(const fs::path& run, const RenderOptions& options) {
  std::vector<scene::Override> overrides = options.look;
  overrides.insert(overrides.end(), options.scene.overrides.begin(), options.scene.overrides.end());
  scene::Scene scene = drawing::scene_for_drawing(run, overrides);
  check_memory(scene, memory_limit_bytes(options.scene));
  return scene;
}

void set_space_time(RenderOptions& options) {
  const drawing::SpaceTimeOptions& wanted = options.space_time;
  if (wanted.file.empty()) {
    return;
  }
  if (wanted.column_x.has_value() == options.surface) {
    throw drawing::RedrawError(
        "--space-time shows either a column or the surface: give --column X or --surface");
  }
  options.redraw.space_time = wanted;
}

void check_memory_of_all(const std::vector<drawing::RunToDraw>& runs, double limit) {
  double bytes = 0;
  for (const drawing::RunToDraw& run : runs) {
    bytes += run::estimated_run_bytes(run.scene);
  }
  if (bytes > limit) {
    throw drawing::RedrawError(
        fmt::format("{} runs need about {:.0f} MiB of memory together, more than the limit of {:g} "
                    "MiB; draw fewer of them or raise --memory-limit",
                    runs.size(), bytes / kMebibyte, limit / kMebibyte));
  }
}

std::vector<drawing::RunToDraw> runs_of(const RenderOptions& options) {
  if (options.runs.size() > 1 && !options.folder.empty()) {
    throw drawing::RedrawError(
        "--output goes with one run; pictures of several, one by one, go into the folder render of "
        "each");
  }
  std::vector<drawing::RunToDraw> runs;
  for (const fs::path& folder : options.runs) {
    std::error_code unknown;
    if (std::ranges::any_of(runs, [&](const drawing::RunToDraw& run) {
          return fs::equivalent(run.run_folder, folder, unknown);
        })) {
      throw drawing::RedrawError(fmt::format("{}: is given twice", folder.string()));
    }
    runs.push_back({.scene = scene_of(folder, options), .run_folder = folder});
  }
  check_memory_of_all(runs, memory_limit_bytes(options.scene));
  return runs;
}

/// Where pictures go, if they are wanted one by one.
void set_folders(std::vector<drawing::RunToDraw>& runs, const RenderOptions& options) {
  const drawing::RedrawOptions& redraw = options.redraw;
  const bool one_file =
      !redraw.movie_file.empty() || !redraw.sheet_file.empty() || redraw.space_time;
  if (options.folder.empty() && one_file) {
    return;
  }
  for (drawing::RunToDraw& run : runs) {
    run.picture_folder = store::named_folder(options.folder, run.run_folder, store::kRedrawnFolder);
  }
}

/// By the Python package, with axes and legend as in figures. Returns the exit code.
int write_space_time(const drawing::SpaceTimePicture& picture, const fs::path& file) {
  return run_python_command(
      "space_time", nlohmann::json::parse(picture.figure_json), {},
      [&](const std::string& /*name*/, std::span<const std::uint8_t> bytes) {
        store::write_whole_file(file, bytes);
      },
      image::encode_png(picture.plot_image, {}));
}

void print_totals(const std::vector<drawing::RunToDraw>& runs,
                  const drawing::RedrawOptions& options, std::size_t drawn, std::size_t moments) {
  print_out("{} of {} {} drawn\n", drawn, moments, runs.size() > 1 ? "moments" : "pictures");
  std::vector<fs::path> paths;
  for (const drawing::RunToDraw& run : runs) {
    paths.push_back(run.picture_folder ? run.picture_folder->path() : fs::path());
  }
  paths.insert(paths.end(), {options.movie_file, options.sheet_file,
                             options.space_time ? options.space_time->file : fs::path()});
  for (const fs::path& path : paths) {
    if (!path.empty() && drawn > 0) {
      print_out("{}\n", path.string());
    }
  }
}

int render_run(RenderOptions options) {
  drawing::RedrawOptions& redraw = options.redraw;
  const std::atomic<int>& stop = catch_stop_signals();
  redraw.stop_signal = &stop;
  redraw.max_bytes = memory_limit_bytes(options.scene);
  read_as_input([&] { set_space_time(options); });
  if (redraw.movie_seconds) {
    options.look.insert(options.look.begin(), "output.frames.every=1");
  }
  std::vector<drawing::RunToDraw> runs = read_as_input([&] { return runs_of(options); });
  set_folders(runs, options);
  const auto drawing =
      read_as_input([&] { return std::make_unique<drawing::Redraw>(runs, redraw); });
  ProgressLine line;
  drawing::RedrawEvents events;
  events.warning = [&](const std::string& text) { line.print("warning: " + text); };
  if (!options.quiet) {
    events.progress = [&](const drawing::RedrawProgress& progress) {
      line.show(to_text(progress));
    };
  }
  const std::size_t drawn = drawing->draw(events);
  if (redraw.space_time && drawn > 0) {
    if (const int code = write_space_time(drawing->space_time_picture(), redraw.space_time->file);
        code != 0) {
      return code;
    }
  }
  if (!options.quiet) {
    print_totals(runs, redraw, drawn, drawing->moment_count());
  }
  return drawn == drawing->moment_count() ? kDone : kSignalBase + stop;
}

/// An option that stands for `--set output.frames.KEY=VALUE`.
void add_frames_option(CLI::App* command, RenderOptions& options, const char* name,
                       const std::string& key, const char* type, const char* what) {
  const std::string path = "output.frames." + key;
  command
      ->add_option_function<std::string>(
          name,
          [&options, path, name](const std::string& value) {
            options.look.emplace_back(path + "=" + value, fmt::format("{} {}", name, value));
          },
          what)
      ->type_name(type)
      ->transform(key_value_validator(path));
}

void add_look_options(CLI::App* command, RenderOptions& options) {
  add_frames_option(command, options, "--color-by", "color_by", "WHAT",
                    "What the colours of particles show");
  add_frames_option(command, options, "--overlay", "overlay", "WHAT",
                    "What is drawn over the particles");
  add_frames_option(command, options, "--style", "style", "STYLE",
                    "print is without title, stage and step or time");
  add_frames_option(command, options, "--width", "width", "PIXELS", "Width of the pictures");
  add_frames_option(command, options, "--height", "height", "PIXELS", "Height of the pictures");
  add_set_option(
      command, options.scene,
      "Set a key of the pictures to VALUE (YAML), such as "
      "output.frames.view=[0,0,60,40] or species.small.color='#d55e00'; may be repeated");
}

void add_choice_options(CLI::App* command, RenderOptions& options) {
  add_option(command, "--stage", options.redraw.only_stage, "NAME", "Draw only this stage");
  add_option(command, "--from", options.redraw.first_step, "STEP", "First step to draw",
             whole_number_validator());
  add_option(command, "--to", options.redraw.last_step, "STEP", "Last step to draw",
             whole_number_validator());
  add_frames_option(command, options, "--every", "every", "STEPS",
                    "Fewest steps between two pictures of a stage [as the scene says]");
}

void add_space_time_options(CLI::App* command, RenderOptions& options) {
  CLI::Option* space_time =
      add_option(command, "--space-time", options.space_time.file, "FILE",
                 "Write one picture over time of a column or the free surface: FILE.png");
  CLI::Option* column =
      add_option(command, "--column", options.space_time.column_x, "X",
                 "Over time: the column of the box at this x, in lattice spacings",
                 finite_number_validator())
          ->needs(space_time);
  add_option(command, "--slit", options.space_time.slit_width, "WIDTH",
             "Over time: width of that column in lattice spacings; colours are means over it [1]",
             finite_number_validator())
      ->needs(column);
  command->add_flag("--surface", options.surface, "Over time: the height of the free surface")
      ->needs(space_time);
}

void add_target_options(CLI::App* command, RenderOptions& options) {
  drawing::RedrawOptions& redraw = options.redraw;
  command->add_option("-o,--output", options.folder,
                      "Folder for the pictures [DIR/render; none with --movie, --sheet or "
                      "--space-time]");
  command
      ->add_option_function<std::string>(
          "--format", [&redraw](const std::string& format) { redraw.as_pdf = format == "pdf"; },
          "Of these pictures: png, or pdf (vector graphics) [png]")
      ->type_name("FORMAT")
      ->transform(CLI::IsMember({"png", "pdf"}));
  CLI::Option* movie =
      add_option(command, "--movie", redraw.movie_file, "FILE",
                 "Write a movie, with ffmpeg: FILE.mp4, FILE.webm, FILE.webp, FILE.gif or "
                 "FILE.png (animated)");
  add_option(command, "--duration", redraw.movie_seconds, "SECONDS",
             "Length of the movie: with more pictures some are chosen evenly, with fewer, each is "
             "shown longer; --every is 1 unless given",
             finite_number_validator(0.1, 86'400))
      ->needs(movie);
  add_option(command, "--fps", redraw.frames_per_second, "",
             "Pictures per second of the movie; of a GIF at most 50",
             whole_number_validator(1, 240))
      ->needs(movie)
      ->capture_default_str();
  CLI::Option* sheet = add_option(command, "--sheet", redraw.sheet_file, "FILE",
                                  "Write a contact sheet of pictures evenly chosen: FILE.png");
  add_option(command, "--columns", redraw.sheet_columns, "",
             "Pictures in a row of the contact sheet", whole_number_validator(1, 16))
      ->needs(sheet)
      ->capture_default_str();
}

struct DiffOptions {
  std::string first;
  std::string second;
  std::string out;
  int tolerance = 0;
  std::uint64_t pixels = 0;
};

render::Image read_picture(const std::string& file) {
  const auto bytes =
      read_as_input([&] { return store::read_whole_file(file, store::kMaxPictureBytes); });
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
    store::write_whole_file(options.out, image::encode_png(difference.picture, {}));
  }
  if (difference.differing_pixels == 0) {
    print_out("alike (largest channel difference {})\n", difference.largest_difference);
    return kDone;
  }
  print_out("{} pixels differ by up to {} in x {} to {}, y {} to {}\n", difference.differing_pixels,
            difference.largest_difference, difference.differing_box.min().x(),
            difference.differing_box.max().x(), difference.differing_box.min().y(),
            difference.differing_box.max().y());
  return difference.differing_pixels <= options.pixels ? kDone : kFailed;
}

}  // namespace

void add_render_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "render", "Draw runs again from their trajectories: pictures, a movie");
  auto options = std::make_shared<RenderOptions>();
  command
      ->add_option("DIR", options->runs,
                   "Folder that a run with output.trajectory left. Several have the same colour "
                   "bar, and stand side by side in --movie and --sheet")
      ->required();
  add_target_options(command, *options);
  add_space_time_options(command, *options);
  add_look_options(command, *options);
  add_choice_options(command, *options);
  add_memory_limit_option(command, options->scene);
  command->add_flag("--quiet", options->quiet, "Print warnings and errors only");
  set_action(command, [options] { return render_run(*options); });
}

void add_diff_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "diff", "Compare two pictures; exit code 0 when they are alike, 1 when they differ");
  auto options = std::make_shared<DiffOptions>();
  command->add_option("A", options->first, "First PNG file")->required();
  command->add_option("B", options->second, "Second PNG file")->required();
  add_option(command, "--tolerance", options->tolerance, "",
             "Channel difference up to which two pixels count as alike",
             whole_number_validator(0, 255))
      ->capture_default_str();
  add_option(command, "--pixels", options->pixels, "", "Number of pixels that may differ by more",
             whole_number_validator())
      ->capture_default_str();
  command->add_option("-o,--output", options->out, "Write a picture of the differences");
  set_action(command, [options] { return diff(*options); });
}

}  // namespace clca::cli
