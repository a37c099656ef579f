#include "store/trajectory_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

#include "clca/store/file.hpp"

namespace clca::store {

namespace {

std::optional<std::uint64_t> part_number(const std::string& name) {
  constexpr std::string_view kStart = "part-";
  if (!name.starts_with(kStart)) {
    return std::nullopt;
  }
  std::uint64_t number = 0;
  std::from_chars(name.data() + kStart.size(), name.data() + name.size(), number);
  return name == part_name(number) ? std::optional(number) : std::nullopt;
}

/// Names in a folder; none if it does not exist.
std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  std::filesystem::directory_iterator it(folder, error);
  if (error == std::errc::no_such_file_or_directory) {
    return names;
  }
  for (; !error && it != std::filesystem::directory_iterator(); it.increment(error)) {
    names.push_back(it->path().filename().string());
  }
  if (error) {
    throw StoreError(
        fmt::format("cannot read the folder {}: {}", folder.string(), error.message()));
  }
  return names;
}

std::vector<std::uint64_t> part_numbers(const std::filesystem::path& folder) {
  std::vector<std::uint64_t> numbers;
  for (const std::string& name : names_in(folder)) {
    if (const auto number = part_number(name)) {
      numbers.push_back(*number);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

std::string part_name(std::uint64_t number) {
  return fmt::format("part-{:06}.h5", number);
}

std::vector<std::filesystem::path> find_parts(const std::filesystem::path& run_folder) {
  const std::filesystem::path folder = run_folder / kTrajectoryFolder;
  std::vector<std::filesystem::path> parts;
  for (const std::uint64_t number : part_numbers(folder)) {
    const std::filesystem::path next = folder / part_name(parts.size());
    if (number != parts.size()) {
      throw StoreError(
          fmt::format("cannot read {}: missing, though later parts are there", next.string()));
    }
    parts.push_back(next);
  }
  if (parts.empty()) {
    throw StoreError(fmt::format("cannot read {}: no trajectory there (see output.trajectory)",
                                 folder.string()));
  }
  return parts;
}

void remove_parts(const OutputFolder& run_folder, std::uint64_t kept) {
  if (kept == 0) {
    run_folder.remove(kTrajectoryIndex);
  }
  const OutputFolder folder = run_folder.subfolder(kTrajectoryFolder);
  const std::vector<std::uint64_t> numbers = part_numbers(folder.path());
  for (auto number = numbers.rbegin(); number != numbers.rend() && *number >= kept; ++number) {
    folder.remove(part_name(*number));
  }
}

}  // namespace clca::store
