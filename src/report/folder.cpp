#include "report/folder.hpp"

#include <algorithm>
#include <system_error>

namespace clca::report {

namespace fs = std::filesystem;

void Warnings::add(const std::string& text) {
  constexpr std::size_t kMaxItems = 100;
  if (texts_.size() < kMaxItems && std::find(texts_.begin(), texts_.end(), text) == texts_.end()) {
    texts_.push_back(text);
    if (listener_) {
      listener_(text);
    }
  }
}

std::vector<std::string> file_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code unknown;  // a link that leads nowhere
    if (it->is_regular_file(unknown)) {
      names.push_back(it->path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::size_t> evenly(std::size_t total, std::size_t count) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < std::min(total, count); ++i) {
    chosen.push_back(total <= count ? i
                     : count == 1   ? total - 1
                                    : (i * (total - 1) + (count - 1) / 2) / (count - 1));
  }
  return chosen;
}

}  // namespace clca::report
