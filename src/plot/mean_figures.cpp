// Figures of the tables of a sweep that are averaged over the seeds.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "clca/run/quantity.hpp"
#include "plot/figure_kinds.hpp"
#include "plot/gnuplot.hpp"

namespace clca::plot {

namespace {

using Words = std::vector<std::string>;

/// The rows of one combination in one figure: from the first to the last.
struct Block {
  std::size_t line;  ///< its position among the labels
  std::size_t first;
  std::size_t last;
};

/// mean-series.csv or another one.
class MeanTable {
 public:
  MeanTable(RunTables& tables, const TableFile& file, std::size_t keys, const Choice& choice)
      : tables_(tables),
        choice_(choice),
        file_(file.name),
        table_(tables.read(file.name)),
        known_(run::known_quantities(tables.summary())) {
    const auto runs = std::ranges::find(table_.names, "runs") - table_.names.begin();
    values_ = static_cast<std::size_t>(runs) + 1;
    for (std::size_t column = keys; column + 1 < values_; ++column) {
      const std::string& name = table_.names[column];
      (name == "stage" || name == "probe" || name == "line" ? groups_ : positions_)
          .push_back(column);
    }
    std::vector<std::size_t> over;
    std::vector<std::size_t> apart;
    for (std::size_t key = 0; key < keys; ++key) {
      const bool is_over =
          choice.over.empty() || std::ranges::count(choice.over, table_.names[key]) > 0;
      (is_over ? over : apart).push_back(key);
    }
    lines_ = labels_of(table_, over, !choice.over.empty());
    others_ = labels_of(table_, apart, false);
  }

  std::vector<Figure> figures(const Template& figure_template) const;

 private:
  std::string group(std::size_t row) const;
  /// What has figures of its own.
  struct Part {
    std::string group;   ///< of rows
    std::string others;  ///< values of keys
    std::vector<Block> blocks = {};
  };
  std::vector<Part> parts() const;
  std::string x_name() const;
  /// x_low, x_high, y_low and y_high: where there is something to see.
  std::string ranges(const std::vector<Block>& blocks, const std::string& column) const;
  Figure figure(const Template& figure_template, const Part& part, std::size_t number,
                const std::string& column) const;

  const RunTables& tables_;
  const Choice& choice_;
  const std::string& file_;
  const store::ReadTable& table_;
  run::KnownQuantities known_;
  std::size_t values_ = 0;  ///< the first column with means
  std::vector<std::size_t> groups_;
  std::vector<std::size_t> positions_;
  RowLabels lines_;
  RowLabels others_;
};

std::string MeanTable::group(std::size_t row) const {
  Words words;
  for (const std::size_t column : groups_) {
    words.push_back(table_.cells[column][row]);
  }
  return fmt::format("{}", fmt::join(words, "-"));
}

std::vector<MeanTable::Part> MeanTable::parts() const {
  Words groups;
  for (std::size_t row = 0; row < table_.rows(); ++row) {
    groups.push_back(group(row));
  }
  const Words all_groups = in_order(groups);
  std::map<std::pair<std::ptrdiff_t, std::size_t>, Part> found;  // by their numbers
  for (std::size_t row = 0; row < table_.rows(); ++row) {
    const std::size_t others = others_.of_rows[row];
    const auto group_number = std::ranges::find(all_groups, groups[row]) - all_groups.begin();
    Part& part = found[{group_number, others}];
    part.group = groups[row];
    part.others = others_.all[others];
    const bool goes_on = !part.blocks.empty() && part.blocks.back().line == lines_.of_rows[row] &&
                         part.blocks.back().last + 1 == row;
    if (goes_on) {
      part.blocks.back().last = row;
    } else {
      part.blocks.push_back({lines_.of_rows[row], row, row});
    }
  }
  std::vector<Part> parts;
  for (auto& [numbers, part] : found) {
    std::ranges::stable_sort(part.blocks, {}, &Block::line);
    parts.push_back(std::move(part));
  }
  return parts;
}

/// The column of the axis: time where all runs have it.
std::string MeanTable::x_name() const {
  for (const std::size_t column : positions_) {
    const Words& cells = table_.cells[column];
    if (table_.names[column] == "time" && std::ranges::count(cells, "") == 0) {
      return "time";
    }
  }
  return table_.names[positions_.front()];
}

std::string MeanTable::ranges(const std::vector<Block>& blocks, const std::string& column) const {
  constexpr double kMost = std::numeric_limits<double>::max();
  const std::vector<double> xs = table_.numbers(x_name());
  const std::vector<double> means = table_.numbers(column);
  const std::vector<double> errors = table_.numbers(column + "_se");
  std::array<double, 4> ends = {kMost, -kMost, kMost, -kMost};
  const auto widen = [&ends](std::size_t axis, double low, double high) {
    ends[axis] = std::min(ends[axis], low);
    ends[axis + 1] = std::max(ends[axis + 1], high);
  };
  for (const Block& block : blocks) {
    for (std::size_t row = block.first; row <= block.last; ++row) {
      const double error = std::isfinite(errors[row]) ? errors[row] : 0;
      if (std::isfinite(means[row])) {
        widen(2, means[row] - error, means[row] + error);
      }
      if (std::isfinite(means[row]) && means[row] != 0) {
        widen(0, xs[row], xs[row]);
      }
    }
  }
  return fmt::format("x_low = {}; x_high = {}; y_low = {}; y_high = {};", ends[0], ends[1], ends[2],
                     ends[3]);
}

Figure MeanTable::figure(const Template& figure_template, const Part& part, std::size_t number,
                         const std::string& column) const {
  const auto& [group, others, blocks] = part;
  Words lines;
  std::vector<std::size_t> firsts;
  std::vector<std::size_t> lasts;
  for (const Block& block : blocks) {
    lines.push_back(lines_.all[block.line]);
    firsts.push_back(block.first);
    lasts.push_back(block.last);
  }
  const std::string stem = file_.substr(0, file_.rfind('.'));
  const std::string stage = stem.substr(std::min(stem.find('-', stem.find('-') + 1), stem.size()));
  const std::string of =
      (group.empty() ? stage.substr(std::min<std::size_t>(1, stage.size())) : group) +
      (others.empty() ? "" : ", " + others);
  const auto known = known_.find(column);
  return {.name = fmt::format("{}{}{}-{}{}", stem, group.empty() ? "" : "-", group, column,
                              number > 0 ? fmt::format("-{}", number) : ""),
          .title = tables_.title(),
          .description =
              fmt::format("{}{}{}, against {}: {}. {}", known ? known->name : column,
                          known && !known->meaning.empty() ? ": " : "", known ? known->meaning : "",
                          known_.label(x_name()), of, figure_template.description),
          .script = figure_template.file,
          .run = tables_.run(),
          .setting = to_text(SweepSetting{.file = file_,
                                          .part = of,
                                          .x_label = known_.label(x_name()),
                                          .y_label = known_.label(column),
                                          .lines = lines,
                                          .log_x = choice_.log_x,
                                          .log_y = choice_.log_y}) +
                     fmt::format("x_column = {}; y_column = {}; array firsts[{}] = [{}];"
                                 "array lasts[{}] = [{}];",
                                 literal(x_name()), literal(column), firsts.size(),
                                 fmt::join(firsts, ", "), lasts.size(), fmt::join(lasts, ", ")) +
                     ranges(blocks, column),
          .rank = figure_template.rank};
}

std::vector<Figure> MeanTable::figures(const Template& figure_template) const {
  std::vector<Figure> result;
  std::map<std::string, std::size_t> numbers;  // by group
  for (const Part& part : parts()) {
    const std::string& group = part.group;
    const std::size_t number = part.others.empty() ? 0 : ++numbers[group];
    for (std::size_t at = values_; at < table_.names.size(); at += 2) {
      const std::string& column = table_.names[at];
      const auto is_drawn = [&](const Block& block) {
        return std::any_of(table_.cells[at].begin() + static_cast<long>(block.first),
                           table_.cells[at].begin() + static_cast<long>(block.last) + 1,
                           [](const std::string& cell) { return !cell.empty() && cell != "0"; });
      };
      const bool is_wanted = choice_.y.empty() || std::ranges::count(choice_.y, column) > 0;
      if (is_wanted && is_label(column) && (group.empty() || is_label(group)) &&
          std::ranges::any_of(part.blocks, is_drawn)) {
        result.push_back(figure(figure_template, part, number, column));
      }
    }
  }
  return result;
}

}  // namespace

std::vector<Figure> mean_figures(RunTables& tables, const Template& figure_template,
                                 const Choice& choice) {
  std::vector<Figure> result;
  if (tables.files("measures.csv").empty()) {
    return result;
  }
  const Words& names = tables.read("measures.csv").names;
  const auto keys = static_cast<std::size_t>(std::ranges::find(names, "stage") - names.begin());
  for (const TableFile& file : tables.files("mean-*.csv")) {
    const store::ReadTable& table = tables.read(file.name);
    if (table.find("runs") != nullptr && keys < table.names.size() && table.rows() > 0) {
      const std::vector<Figure> more =
          MeanTable(tables, file, keys, choice).figures(figure_template);
      result.insert(result.end(), more.begin(), more.end());
    }
  }
  return result;
}

}  // namespace clca::plot
