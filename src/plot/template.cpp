#include "plot/template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <string_view>
#include <system_error>

#include "clca/plot/plot.hpp"
#include "clca/store/file.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;

constexpr double kMaxTemplateBytes = 1 << 20;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Text before and after the first `mark`; after is empty where there is none.
std::pair<std::string, std::string> halves(const std::string& text, char mark) {
  const std::size_t position = text.find(mark);
  return {trimmed(text.substr(0, position)),
          position == std::string::npos ? std::string() : trimmed(text.substr(position + 1))};
}

TableRequirement to_need(const std::string& text) {
  const auto [table, columns] = halves(text, ':');
  TableRequirement need = {.table = table, .columns = {}, .changing = {}, .rows = {}};
  std::stringstream stream(columns);
  for (std::string item; std::getline(stream, item, ',');) {
    constexpr std::string_view kChanging = "changing ";
    const auto [column, value] = halves(item, '=');
    if (column.starts_with(kChanging)) {
      need.changing.push_back(column.substr(kChanging.size()));
    } else if (value.empty()) {
      need.columns.push_back(column);
    } else {
      need.rows.emplace_back(column, value);
    }
  }
  return need;
}

Division to_division(const std::string& text) {
  constexpr std::array<std::pair<const char*, Division>, 5> kDivisions = {
      {{"group", Division::by_group},
       {"file", Division::by_file},
       {"measure", Division::by_measure},
       {"column", Division::by_column},
       {"mean", Division::by_mean}}};
  for (const auto& [word, division] : kDivisions) {
    if (text == word) {
      return division;
    }
  }
  throw PlotError(
      fmt::format("one figure for each: group, file, measure, column or mean, not '{}'", text));
}

double to_rank(const std::string& text) {
  double rank = 0;
  const char* end = text.data() + text.size();
  if (const auto [stop, error] = std::from_chars(text.data(), end, rank);
      stop != end || error != std::errc()) {
    throw PlotError(fmt::format("rank: a number, not '{}'", text));
  }
  return rank;
}

/// False if the line is none that says what the template needs.
bool read_line(Template& result, const std::string& line) {
  const auto [key, value] = halves(line, ':');
  if (key == "needs") {
    result.needs.push_back(to_need(value));
  } else if (key == "may use") {
    result.may_use.push_back(value);
  } else if (key == "groups") {
    result.groups = value;
  } else if (key == "one figure for each") {
    result.division = to_division(value);
  } else if (key == "rank") {
    result.rank = to_rank(value);
  } else if (key == "measure") {
    result.measures.push_back(value);
  } else {
    return false;
  }
  return true;
}

Template read_template(const fs::path& file) {
  Template result;
  result.file = file;
  result.name = file.stem().string();
  const auto bytes = store::read_whole(file, kMaxTemplateBytes);
  std::stringstream text(std::string(bytes.begin(), bytes.end()));
  bool describes = true;
  for (std::string line; std::getline(text, line) && line.starts_with('#');) {
    const std::string words = trimmed(line.substr(1));
    describes = !read_line(result, words) && describes && !words.empty();
    if (describes) {
      result.description += (result.description.empty() ? "" : " ") + words;
    }
  }
  const bool needs_columns = !result.needs.empty() && !(result.needs.front().columns.empty() &&
                                                        result.needs.front().changing.empty());
  if (result.division != Division::by_column && result.division != Division::by_mean &&
      !needs_columns) {
    throw PlotError("it does not say which columns it needs");
  }
  return result;
}

}  // namespace

std::vector<Template> read_templates(const fs::path& folder) {
  std::vector<Template> templates;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() != ".gp" || it->path().filename() == kStyleFile) {
      continue;
    }
    try {
      templates.push_back(read_template(it->path()));
    } catch (const std::runtime_error& unsound) {
      throw PlotError(fmt::format("{}: {}", it->path().string(), unsound.what()));
    }
  }
  if (error) {
    throw PlotError(fmt::format("cannot read the folder {}: {}", folder.string(), error.message()));
  }
  std::sort(templates.begin(), templates.end(),
            [](const Template& a, const Template& b) { return a.name < b.name; });
  return templates;
}

std::string to_text(const TableRequirement& need) {
  std::string text;
  for (const auto& [column, value] : need.rows) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", column, value);
  }
  for (const std::string& column : need.changing) {
    text += fmt::format("{}changing {}", text.empty() ? "" : ", ", column);
  }
  for (const std::string& column : need.columns) {
    text += (text.empty() ? "" : ", ") + column;
  }
  return need.table + ": " + text;
}

}  // namespace clca::plot
