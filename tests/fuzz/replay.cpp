// Feeds the files of a corpus to a fuzz target. The last line names the file it ends at.

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "target.hpp"

namespace {

std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files(std::filesystem::directory_iterator(folder), {});
  std::sort(files.begin(), files.end());
  return files;
}

/// In a block of its own and of just that size, so that a sanitizer sees what is read beyond it.
std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(stream), {});
  bytes.shrink_to_fit();
  return bytes;
}

}  // namespace

int main(int count, char** arguments) try {
  std::vector<std::filesystem::path> files;
  if (count == 2) {
    files = files_of(arguments[1]);
  }
  if (files.empty()) {
    std::cerr << "usage: " << arguments[0] << " FOLDER  (with files in it)\n";
    return 2;
  }
  for (const std::filesystem::path& file : files) {
    std::cerr << file.filename().string() << '\n';
    const auto bytes = bytes_of(file);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << "found: " << error.what() << '\n';
  return 1;
}
