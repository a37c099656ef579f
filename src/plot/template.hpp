#pragma once
// What a template says about itself in the comments at its head:
//
//   # needs: TABLE: COLUMN, COLUMN=VALUE, ...   all of them, by at least one table each
//   # may use: TABLE
//   # groups: COLUMN                            whose values the template tells apart
//   # one figure for each: group                or `file`, of the first table
//   # measure: NAME                             of run.json
//
// A `*` in TABLE stands for the name of a stage or a time.

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace clca::plot {

struct Need {
  std::string table;
  std::vector<std::string> columns;  ///< of numbers; with a value other than 0 somewhere
  std::vector<std::pair<std::string, std::string>> rows;  ///< only those with this text in a column
};

enum class Division : std::uint8_t { none, by_group, by_file };

struct Template {
  std::filesystem::path file;
  std::string name;
  std::vector<Need> needs;  ///< at least one
  std::vector<std::string> may_use;
  std::string groups;
  Division division = Division::none;
  std::vector<std::string> measures;
};

/// Common to all templates: run before each of them.
inline constexpr const char* kStyleFile = "style.gp";

/// All templates of a folder, by name. Throws PlotError.
std::vector<Template> read_templates(const std::filesystem::path& folder);

/// As the template says it: `series.csv: time, t_tr`.
std::string to_text(const Need& need);

}  // namespace clca::plot
