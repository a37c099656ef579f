#pragma once
// Starts the Python package, which reads finished folders: figures, reports, exports, comparisons.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace clca::cli {

using FileReceiver =
    std::function<void(const std::string& name, std::span<const std::uint8_t> bytes)>;

/// Runs the function `command()` of the module `clca._COMMAND` with these options and paths.
/// It reads `input` from standard input and writes to standard error itself. If it has not failed,
/// `file` gets the files that it returns, one at a time, and lines for the user are printed.
/// `buffer_folder`: a folder for what it returns until then, if that may be large. Returns the exit
/// code. Throws process::ProcessError where Python cannot be started or is killed, and
/// process::StoppedError after a signal to stop.
int run_python_command(const std::string& command, const nlohmann::json& options,
                       const std::vector<std::filesystem::path>& paths, const FileReceiver& file,
                       std::span<const std::uint8_t> input = {},
                       const std::filesystem::path& buffer_folder = {});

}  // namespace clca::cli
