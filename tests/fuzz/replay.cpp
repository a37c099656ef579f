// Feeds the files of folders to a fuzz target, and damaged copies of each: always the same ones.
// The last line names the file, and the copy, that it ends at.

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "target.hpp"

namespace {

void add_files_of(const std::filesystem::path& folder, std::vector<std::filesystem::path>& files) {
  std::vector<std::filesystem::path> more(std::filesystem::directory_iterator(folder), {});
  std::sort(more.begin(), more.end());
  files.insert(files.end(), more.begin(), more.end());
}

/// In a block of its own and of just that size, so that a sanitizer sees what is read beyond it.
std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(stream), {});
  bytes.shrink_to_fit();
  return bytes;
}

/// Some bytes changed, taken out or said twice.
std::vector<std::uint8_t> damaged(std::vector<std::uint8_t> bytes, std::minstd_rand& random) {
  const auto below = [&](std::size_t bound) { return random() % std::max<std::size_t>(1, bound); };
  for (std::size_t times = 1 + below(4); times > 0 && !bytes.empty(); --times) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
    const auto rest = static_cast<std::size_t>(bytes.end() - begin);
    const auto end =
        begin + static_cast<std::ptrdiff_t>(1 + below(std::min<std::size_t>(rest, 16)));
    switch (below(4)) {
      case 0:
        *begin = static_cast<std::uint8_t>(*begin ^ (1U << below(8)));
        break;
      case 1:
        *begin = static_cast<std::uint8_t>(below(256));
        break;
      case 2:
        bytes.erase(begin, std::min(end, bytes.end()));
        break;
      default: {
        const std::vector<std::uint8_t> copy(begin, std::min(end, bytes.end()));
        bytes.insert(begin, copy.begin(), copy.end());
      }
    }
  }
  bytes.shrink_to_fit();
  return bytes;
}

}  // namespace

int main(int count, char** arguments) try {
  std::vector<std::filesystem::path> files;
  for (int argument = 2; argument < count; ++argument) {
    add_files_of(arguments[argument], files);
  }
  if (files.empty()) {
    std::cerr << "usage: " << arguments[0] << " COPIES FOLDER...  (with files in them)\n";
    return 2;
  }
  const int copies = std::stoi(arguments[1]);
  for (const std::filesystem::path& file : files) {
    std::cerr << file.filename().string() << '\n';
    const auto bytes = bytes_of(file);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    std::minstd_rand random;
    for (int copy = 0; copy < copies; ++copy) {
      std::cerr << "  copy " << copy << '\n';
      const auto changed = damaged(bytes, random);
      LLVMFuzzerTestOneInput(changed.data(), changed.size());
    }
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << "found: " << error.what() << '\n';
  return 1;
}
