#include "cli/package.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "clca/process/data_folder.hpp"
#include "clca/process/program.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Lines of JSON: {"line": TEXT}, or {"file": NAME, "bytes": COUNT}, with so many bytes after it.
void take(std::span<const std::uint8_t> answer, const FileReceiver& file) {
  while (!answer.empty()) {
    const auto end = std::find(answer.begin(), answer.end(), '\n');
    const Json head = Json::parse(answer.begin(), end);
    answer = {end == answer.end() ? end : end + 1, answer.end()};
    if (head.contains("line")) {
      print_out("{}\n", head["line"].get<std::string>());
      continue;
    }
    const auto size = head.at("bytes").get<std::size_t>();
    if (size > answer.size()) {
      throw process::ProcessError("Python ends within a file");
    }
    file(head.at("file"), answer.first(size));
    answer = answer.subspan(size);
  }
}

}  // namespace

int run_package(const std::string& command, const Json& options,
                const std::vector<fs::path>& folders, const FileReceiver& file,
                std::span<const std::uint8_t> input) {
  constexpr int kMaxCode = 2;  // of the package itself
  const fs::path package = process::data_folder("python") / "clca/__main__.py";
  const fs::path python = process::python();
  std::error_code unknown;
  if (!fs::exists(package, unknown)) {
    throw process::ProcessError(fmt::format("no Python package of clca: {}", package.string()));
  }
  std::vector<std::string> arguments = {
      python.string(), package.string(), command,
      options.dump(-1, ' ', false, Json::error_handler_t::replace)};
  for (const fs::path& folder : folders) {
    arguments.push_back(fs::absolute(folder).string());
  }
  const std::atomic<int>& stop = catch_stop_signals();
  const process::OutputCapture out;
  process::Program program(arguments, {.out = &out, .fed = true, .stop = &stop});
  program.feed(input);
  const int code = program.wait();
  if (code > kMaxCode) {
    throw process::ProcessError(fmt::format("{} fails with exit code {}", python.string(), code));
  }
  const std::vector<std::uint8_t> answer = out.bytes();
  try {
    take(answer, file);
  } catch (const Json::exception&) {
    throw process::ProcessError(
        fmt::format("{} answers what clca does not understand", python.string()));
  }
  return code;
}

}  // namespace clca::cli
