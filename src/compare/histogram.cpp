#include "compare/histogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <system_error>

#include "clca/compare/compare.hpp"
#include "clca/store/file.hpp"

namespace clca::compare {

namespace {

constexpr double kRounding = 1e-6;  // tables may be cut to fewer digits

/// Calls `read`; an unreadable file becomes a CompareError.
template <class Read>
auto readable(Read read) {
  try {
    return read();
  } catch (const store::StoreError& error) {
    throw CompareError(error.what());
  }
}

}  // namespace

store::RunSummary read_run(const std::filesystem::path& run,
                           const std::vector<std::string>& kinds) {
  store::RunSummary summary = readable([&] { return store::read_summary(run / "run.json"); });
  if (std::find(kinds.begin(), kinds.end(), summary.kind) == kinds.end()) {
    throw CompareError(fmt::format("{}: expected a run of kind {}, found {}", run.string(),
                                   fmt::join(kinds, " or "), summary.kind));
  }
  return summary;
}

std::optional<double> number(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return stop == end && error == std::errc() && std::isfinite(value) ? std::optional(value)
                                                                     : std::nullopt;
}

Histogram::Histogram(std::filesystem::path file)
    : file_(std::move(file)), table_(readable([&] { return store::read_table(file_); })) {}

void Histogram::fail(const std::string& why) const {
  throw CompareError(fmt::format("{}: {}", file_.string(), why));
}

bool Histogram::has(const std::string& column) const {
  return table_.find(column) != nullptr;
}

const std::vector<std::string>& Histogram::cells(const std::string& column) const {
  const auto* found = table_.find(column);
  if (found == nullptr) {
    fail(fmt::format("it has no column '{}'", column));
  }
  return *found;
}

void Histogram::keep(const std::string& column, const std::string& text) {
  const std::vector<std::string> keys = cells(column);
  for (std::vector<std::string>& all : table_.cells) {
    std::size_t row = 0;
    std::erase_if(all, [&](const std::string&) { return keys[row++] != text; });
  }
}

std::vector<double> Histogram::numbers(const std::string& column) const {
  std::vector<double> result;
  for (const std::string& text : texts(column)) {
    const auto value = number(text);
    if (!value) {
      fail(fmt::format("'{}' in column '{}' is no number", text, column));
    }
    result.push_back(*value);
  }
  return result;
}

std::vector<double> Histogram::shares(const std::string& column) const {
  const std::vector<double> reference = numbers("reference");
  const double equal = 1 / static_cast<double>(reference.size());
  if (std::any_of(reference.begin(), reference.end(),
                  [&](double share) { return std::abs(share - equal) > kRounding; })) {
    fail("its bins are not equally probable ones (bins: q20 in the scene)");
  }
  std::vector<double> result = numbers(column);
  const double sum = std::accumulate(result.begin(), result.end(), 0.0);
  if (std::any_of(result.begin(), result.end(), [](double share) { return share < 0; }) ||
      (sum != 0 && std::abs(sum - 1) > kRounding)) {
    fail(fmt::format("column '{}' holds no shares: they do not add up to 1", column));
  }
  return result;
}

}  // namespace clca::compare
