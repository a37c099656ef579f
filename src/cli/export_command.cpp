// clca export: the trajectory of a run in formats of other programs, by the Python package.

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/trajectory.hpp"
#include "cli/command.hpp"
#include "cli/input.hpp"
#include "cli/option_values.hpp"
#include "cli/package.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  fs::path run;
  std::string format;
  fs::path file;
  std::optional<std::uint64_t> first;
  std::optional<std::uint64_t> last;
  std::uint64_t every = 1;
};

/// The folder to write to; gone at the end if it is new and empty.
class Room {
 public:
  explicit Room(const fs::path& path)
      : path_(fs::current_path() / path), is_new_(!fs::exists(path_)) {
    store::make_folder(path_);
  }
  ~Room() {
    std::error_code not_empty;
    if (is_new_) {
      fs::remove(path_, not_empty);
    }
  }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  bool is_new_;
};

struct Format {
  const char* name;
  const char* ending;
};

/// As `FORMATS` of _export.py.
constexpr auto kFormats =
    std::to_array<Format>({{"vtp", ".pvd"}, {"gsd", ".gsd"}, {"xyz", ".xyz"}, {"h5md", ".h5"}});

std::vector<std::string> names_of_formats() {
  std::vector<std::string> names;
  for (const Format& format : kFormats) {
    names.emplace_back(format.name);
  }
  return names;
}

std::string ending_of(const std::string& format) {
  return std::find_if(kFormats.begin(), kFormats.end(),
                      [&](const Format& one) { return one.name == format; })
      ->ending;
}

/// As `command` of _export.py.
nlohmann::json to_json(const ExportOptions& options, const fs::path& file) {
  const auto number_or_null = [](const std::optional<std::uint64_t>& number) {
    return number ? nlohmann::json(*number) : nlohmann::json();
  };
  return {{"format", options.format},
          {"file", file.string()},
          {"first", number_or_null(options.first)},
          {"last", number_or_null(options.last)},
          {"every", options.every}};
}

int export_run(const ExportOptions& options) {
  const std::string scene =
      as_input([&] { return store::read_summary(options.run / "run.json"); }).scene;
  std::error_code unknown;  // Python reads without a look at checksums
  if (fs::exists(options.run / "trajectory", unknown)) {
    as_input([&] { store::check_parts(options.run); });
  }
  const Room room(options.file.empty() ? options.run / store::kExportFolder
                                       : options.file.parent_path());
  const store::OutputFolder folder =
      store::OutputFolder(options.run).subfolder(store::kExportFolder);
  const bool is_named = !options.file.empty();
  const std::string name = scene + ending_of(options.format);
  const fs::path path = is_named ? options.file : folder.path(name);
  store::AtomicFile file = is_named ? store::AtomicFile(path) : folder.create(name);
  const auto beside = [&](const std::string& other, std::span<const std::uint8_t> bytes) {
    if (is_named) {
      store::write_whole(path.parent_path() / other, bytes);
    } else {
      folder.write(other, bytes);
    }
  };
  const int code = run_package("export", to_json(options, path),
                               {options.run, file.temporary_path()}, beside, {}, room.path());
  if (code == 0) {
    file.finish();
    print_out("{}\n", path.string());
  }
  return code;
}

}  // namespace

void add_export_command(CommandLine& command_line) {
  Command command = command_line.command(
      "export", "The trajectory of a run for ParaView (vtp), OVITO (gsd, xyz) or readers of H5MD");
  auto options = std::make_shared<ExportOptions>();
  command.option("DIR", &options->run, "Folder that a run with output.trajectory has left")
      .required();
  command.option("--format", &options->format, "Format")
      .required()
      .type("FORMAT")
      .values(one_of(names_of_formats()));
  command
      .option("-o,--output", &options->file,
              "File to write, of vtp the .pvd with the others beside it "
              "[DIR/export/SCENE with the ending of the format]")
      .type("FILE");
  command.option("--from", &options->first, "First step").type("STEP").values(whole_number());
  command.option("--to", &options->last, "Last step").type("STEP").values(whole_number());
  command
      .option("--every", &options->every,
              "Least number of steps between frames of a stage [all frames]")
      .type("STEPS")
      .values(whole_number(1));
  command.action([options] { return export_run(*options); });
}

}  // namespace clca::cli
