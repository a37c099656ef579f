#pragma once
// What a template says about itself in the comments at its head:
//
//   # needs: TABLE: COLUMN, COLUMN=VALUE, ...   all of them, by at least one table each
//   # needs: TABLE: changing COLUMN             whose values differ
//   # needs: TABLE: PREFIX.*                    at least one column with this prefix
//   # may use: TABLE
//   # groups: COLUMN                            whose values the template tells apart
//   # one figure for each: group                or `file` of the first table; `measure` of a sweep;
//                                               `column` that is chosen; `mean` over seeds
//   # rank: NUMBER                              those with the highest come first in a report; 0
//   # measure: NAME                             of run.json
//
// A `*` in TABLE stands for the name of a stage or a time. What stands before the first empty
// comment describes the figure.

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace clca::plot {

struct TableRequirement {
  std::string table;
  std::vector<std::string> columns;   ///< of numbers; with a value other than 0 somewhere
  std::vector<std::string> changing;  ///< of numbers that are not all the same
  std::vector<std::pair<std::string, std::string>> rows;  ///< only those with this text in a column
};

enum class Division : std::uint8_t { none, by_group, by_file, by_measure, by_column, by_mean };

struct Template {
  std::filesystem::path file;
  std::string name;
  std::string description;
  std::vector<TableRequirement> needs;  ///< at least one, but of chosen columns and means
  std::vector<std::string> may_use;
  std::string groups;
  Division division = Division::none;
  std::vector<std::string> measures;
  double rank = 0;
};

/// The common style, run before each template.
inline constexpr const char* kStyleFile = "style.gp";

/// All templates of a folder, by name. Throws PlotError.
std::vector<Template> read_templates(const std::filesystem::path& folder);

/// As the template says it: `series.csv: time, t_tr`.
std::string to_text(const TableRequirement& need);

}  // namespace clca::plot
