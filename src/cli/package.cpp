// How the Python package is started, and what it answers.

#include "cli/package.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <system_error>

#include "clca/process/data_folder.hpp"
#include "clca/process/program.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string line_of(std::FILE* file) {
  std::string line;
  for (int letter = 0; (letter = std::fgetc(file)) != EOF && letter != '\n';) {
    line += static_cast<char>(letter);
  }
  return line;
}

/// The answer is lines of JSON: {"line": TEXT}, or {"file": NAME, "bytes": COUNT}, with so many
/// bytes after it.
void receive_answer(std::FILE* answer, const FileReceiver& file) {
  for (std::string line = line_of(answer); !line.empty(); line = line_of(answer)) {
    const Json head = Json::parse(line);
    if (head.contains("line")) {
      print_out("{}\n", head["line"].get<std::string>());
      continue;
    }
    std::vector<std::uint8_t> bytes(head.at("bytes").get<std::size_t>());
    if (std::fread(bytes.data(), 1, bytes.size(), answer) < bytes.size()) {
      throw process::ProcessError("Python ends within a file");
    }
    file(head.at("file"), bytes);
  }
}

}  // namespace

int run_python_command(const std::string& command, const Json& options,
                       const std::vector<fs::path>& paths, const FileReceiver& file,
                       std::span<const std::uint8_t> input, const fs::path& buffer_folder) {
  constexpr int kMaxCode = 2;  // of the package itself
  const fs::path package = process::data_folder("python") / "clca/__main__.py";
  const fs::path python = process::python_program();
  std::error_code unknown;
  if (!fs::exists(package, unknown)) {
    throw process::ProcessError(fmt::format("no Python package of clca: {}", package.string()));
  }
  std::vector<std::string> arguments = {
      python.string(), package.string(), command,
      options.dump(-1, ' ', false, Json::error_handler_t::replace)};
  for (const fs::path& path : paths) {
    arguments.push_back(fs::absolute(path).string());
  }
  const std::atomic<int>& stop = catch_stop_signals();
  const process::OutputCapture out(buffer_folder);
  process::Program program(arguments, {.output = &out, .is_fed = true, .stop = &stop});
  program.feed(input);
  const int code = program.wait();
  if (code > kMaxCode) {
    throw process::ProcessError(fmt::format("{} fails with exit code {}", python.string(), code));
  }
  if (code != 0) {
    return code;
  }
  try {
    receive_answer(out.rewound_file(), file);
  } catch (const Json::exception&) {
    throw process::ProcessError(
        fmt::format("{} answers what clca does not understand", python.string()));
  }
  return code;
}

}  // namespace clca::cli
