#include "report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <tuple>

#include "clca/store/file.hpp"

namespace clca::report {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTables = 24;  // of one kind
constexpr double kMostBytes = 64 << 20;  // a table takes up to 40 times that in memory

/// Stages as they come in the run, times as they ascend, all else by the alphabet.
auto place_of(const store::RunSummary& summary, const std::string& label) {
  const auto stage = std::find_if(summary.stages.begin(), summary.stages.end(),
                                  [&](const auto& one) { return one.name == label; });
  double number = 0;
  std::from_chars(label.data(), label.data() + label.size(), number);
  return std::tuple(stage - summary.stages.begin(), number, label);
}

}  // namespace

void Warnings::add(const std::string& text) {
  constexpr std::size_t kMost = 100;
  if (texts_.size() < kMost && std::find(texts_.begin(), texts_.end(), text) == texts_.end()) {
    texts_.push_back(text);
    if (listener_) {
      listener_(text);
    }
  }
}

std::optional<std::vector<double>> RunTable::numbers(const std::string& column) const {
  if (table_.find(column) == nullptr) {
    return std::nullopt;
  }
  try {
    return table_.numbers(column);
  } catch (const store::StoreError& error) {
    warnings_->add(error.what());
    return std::nullopt;
  }
}

Tables::Tables(const fs::path& run, const store::RunSummary& summary, Warnings& warnings)
    : run_(run), summary_(&summary), warnings_(&warnings), files_(file_names(run)) {
  std::erase_if(files_, [](const std::string& name) { return !name.ends_with(".csv"); });
}

std::optional<RunTable> Tables::find(const std::string& name) const {
  const std::string file = name + ".csv";
  return std::binary_search(files_.begin(), files_.end(), file) ? read(file, "") : std::nullopt;
}

std::vector<RunTable> Tables::find_all(const std::string& name) const {
  constexpr std::string_view kEnding = ".csv";
  const std::string start = name + "-";
  std::vector<std::string> labels;
  for (const std::string& file : files_) {
    if (file.starts_with(start) && file.size() > start.size() + kEnding.size()) {
      labels.push_back(file.substr(start.size(), file.size() - start.size() - kEnding.size()));
    }
  }
  std::sort(labels.begin(), labels.end(), [&](const std::string& a, const std::string& b) {
    return place_of(*summary_, a) < place_of(*summary_, b);
  });
  if (labels.size() > kMostTables) {
    warnings_->add(fmt::format("of the {} tables {}-*.csv only {} are shown, evenly chosen",
                               labels.size(), name, kMostTables));
  }
  std::vector<RunTable> tables;
  for (const std::size_t number : evenly(labels.size(), kMostTables)) {
    if (auto table = read(start + labels[number] + ".csv", labels[number])) {
      tables.push_back(std::move(*table));
    }
  }
  return tables;
}

std::optional<RunTable> Tables::read(const std::string& file, const std::string& label) const {
  try {
    return RunTable(label, store::read_table(run_ / file, kMostBytes), *warnings_);
  } catch (const store::StoreError& error) {
    warnings_->add(error.what());
    return std::nullopt;
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
