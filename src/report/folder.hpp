#pragma once
// Reading a run folder for the page. What cannot be read is left out with a warning.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace clca::report {

/// Warnings about omitted items, without duplicates.
class Warnings {
 public:
  explicit Warnings(std::function<void(const std::string&)> listener)
      : listener_(std::move(listener)) {}

  void add(const std::string& text);
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::function<void(const std::string&)> listener_;
  std::vector<std::string> texts_;
};

/// The names of regular files in a folder, by the alphabet; none where it cannot be read.
std::vector<std::string> file_names(const std::filesystem::path& folder);

/// `count` of the numbers 0 to `total` - 1 or all, evenly, with the first and the last.
std::vector<std::size_t> evenly(std::size_t total, std::size_t count);

}  // namespace clca::report
