#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "clca/run/quantity.hpp"
#include "clca/text/input_error.hpp"
#include "clca/text/message.hpp"
#include "plot/figure_kinds.hpp"
#include "plot/gnuplot.hpp"

namespace clca::plot {

namespace {

using Cells = std::vector<std::string>;

/// Rank of what the scene itself derives.
constexpr double kFirst = 1e6;

/// Whether two keys vary together: each value of the first comes with one of the second.
bool vary_together(const Cells& first, const Cells& second) {
  std::set<std::pair<std::string, std::string>> pairs;
  for (std::size_t row = 0; row < first.size(); ++row) {
    pairs.emplace(first[row], second[row]);
  }
  return pairs.size() == in_order(first).size() && pairs.size() == in_order(second).size();
}

/// So that they stand side by side under an axis.
Cells shortened(const Cells& words) {
  constexpr std::size_t kAxis = 72;  // characters
  const std::size_t most = std::max<std::size_t>(kAxis / std::max<std::size_t>(words.size(), 1), 4);
  Cells result;
  for (const std::string& word : words) {
    const std::string_view beginning = text::first_characters(word, most);
    result.push_back(std::string(beginning) + (beginning.size() < word.size() ? "…" : ""));
  }
  return result;
}

std::string numbers_text(const std::string& name, const std::vector<double>& numbers) {
  return fmt::format("array {}[{}] = [{}];", name, numbers.size(), fmt::join(numbers, ", "));
}

/// From 1.
double position_of(const Cells& all, const std::string& cell) {
  return static_cast<double>(std::find(all.begin(), all.end(), cell) - all.begin() + 1);
}

/// Mean and interval of a measure over the seeds.
struct Interval {
  double mean = 0;
  double low = 0;
  double high = 0;
};

struct Point {
  Interval x;
  Interval y;
  std::size_t line = 0;  ///< its number, from 1
};

/// The points of one figure.
struct Points {
  std::size_t row = 0;   ///< the first
  std::size_t part = 0;  ///< by values of keys that neither the axis nor the lines have
  std::vector<Point> points = {};
};

/// How far the means lie apart, in units of the errors: the larger, the more there is to see.
double contrast(const std::vector<Point>& points) {
  const auto [least, most] =
      std::ranges::minmax_element(points, {}, [](const Point& point) { return point.y.mean; });
  double errors = 0;
  for (const Point& point : points) {
    errors += (point.y.high - point.y.low) / 2 / static_cast<double>(points.size());
  }
  const double spread = most->y.mean - least->y.mean;
  const double scale = std::max(std::abs(most->y.mean), std::abs(least->y.mean));
  return spread / (errors + 0.01 * scale);
}

std::string setting_of(std::vector<Point> points) {
  std::ranges::stable_sort(points, {}, [](const Point& point) { return point.x.mean; });
  const auto all = [&points](const std::string& name, auto number) {
    std::vector<double> numbers(points.size());
    std::ranges::transform(points, numbers.begin(), number);
    return numbers_text(name, numbers);
  };
  return all("xs", [](const Point& point) { return point.x.mean; }) +
         all("lefts", [](const Point& point) { return point.x.low; }) +
         all("rights", [](const Point& point) { return point.x.high; }) +
         all("means", [](const Point& point) { return point.y.mean; }) +
         all("lows", [](const Point& point) { return point.y.low; }) +
         all("highs", [](const Point& point) { return point.y.high; }) +
         all("of_lines", [](const Point& point) { return static_cast<double>(point.line); });
}

/// Whether it is a column of a table that is averaged over the seeds.
bool has_mean(RunTables& tables, const std::string& name) {
  return std::ranges::any_of(tables.files("mean-*.csv"), [&](const TableFile& file) {
    return tables.read(file.name).find(name + "_se") != nullptr;
  });
}

/// measures.csv, and what is drawn of it.
class SweepTable {
 public:
  /// Throws text::InputError for a choice of what is not there.
  SweepTable(RunTables& tables, const store::ReadTable& table, const Choice& choice);

  std::vector<Figure> figures(const Template& figure_template) const;

 private:
  bool is_key(const std::string& name) const { return key(name) < keys_; }
  std::size_t key(const std::string& name) const {
    return static_cast<std::size_t>(
        std::find(table_.names.begin(), table_.names.begin() + static_cast<long>(keys_), name) -
        table_.names.begin());
  }
  const std::string& cell(const char* column, std::size_t row) const {
    return (*table_.find(column))[row];
  }
  void divide_keys();
  std::optional<Interval> interval(std::size_t row) const;
  std::optional<Interval> x_interval(std::size_t row) const;
  Cells combination(std::size_t row) const;
  bool is_of_turned_floor(std::size_t row) const;
  std::vector<Points> found() const;
  Figure figure(const Template& figure_template, const Points& points, std::size_t number) const;
  const std::string& x_name() const { return x_is_key_ ? table_.names[along_.front()] : choice_.x; }
  std::string x_label() const;

  const RunTables& tables_;
  const store::ReadTable& table_;
  const Choice& choice_;
  run::KnownQuantities known_;
  std::size_t keys_ = 0;
  std::vector<std::size_t> along_;  ///< the first is the axis, unless that is a measure
  std::vector<std::size_t> over_;
  std::vector<std::size_t> apart_;
  bool x_is_key_ = true;
  std::map<Cells, std::size_t> x_rows_;  ///< of the measure on the axis, by combination
  std::set<Cells> turned_;               ///< combinations that end with a vessel that is turned
  Cells words_;                          ///< of the axis, if not all are numbers
  RowLabels lines_;
  RowLabels parts_;
};

SweepTable::SweepTable(RunTables& tables, const store::ReadTable& table, const Choice& choice)
    : tables_(tables),
      table_(table),
      choice_(choice),
      known_(run::known_quantities(tables.summary())),
      keys_(
          static_cast<std::size_t>(std::ranges::find(table.names, "stage") - table.names.begin())) {
  for (const char* column : {"stage", "measure", "mean", "low", "high"}) {
    if (table.find(column) == nullptr) {
      keys_ = 0;
    }
  }
  if (keys_ == 0) {
    return;  // only the seed varies
  }
  const Cells measures = in_order(*table.find("measure"));
  const auto require = [&](const std::string& name, bool may_be_key, bool may_be_measure) {
    if ((may_be_key && is_key(name)) ||
        (may_be_measure && std::ranges::count(measures, name) > 0)) {
      return;
    }
    std::vector<std::string_view> names;
    if (may_be_key) {
      names.insert(names.end(), table.names.begin(),
                   table.names.begin() + static_cast<long>(keys_));
    }
    if (may_be_measure) {
      names.insert(names.end(), measures.begin(), measures.end());
    }
    throw text::InputError(fmt::format("{}: no {} {}{}", table.file.string(),
                                       !may_be_measure ? "varied key"
                                       : may_be_key    ? "varied key or measure"
                                                       : "measure",
                                       text::shown(name), text::suggestion(name, names)));
  };
  if (!choice.x.empty()) {
    require(choice.x, true, true);
  }
  for (const std::string& y : choice.y) {
    if (!has_mean(tables, y)) {
      require(y, false, true);
    }
  }
  for (const std::string& name : choice.over) {
    require(name, true, false);
  }
  divide_keys();
  lines_ = labels_of(table, over_, !choice.over.empty());
  parts_ = labels_of(table, apart_, false);
  for (std::size_t row = 0; !x_is_key_ && row < table.rows(); ++row) {
    if (cell("measure", row) == choice.x) {
      x_rows_.emplace(combination(row), row);
    }
  }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string& angle = cell("mean", row);
    if (cell("measure", row) == run::kVesselAngleKey && is_number(angle) && std::stod(angle) != 0) {
      turned_.insert(combination(row));
    }
  }
  if (x_is_key_ && !std::ranges::all_of(table.cells[along_.front()], is_number)) {
    words_ = in_order(table.cells[along_.front()]);
  }
}

void SweepTable::divide_keys() {
  x_is_key_ = choice_.x.empty() || is_key(choice_.x);
  const auto is_over = [this](std::size_t column) {
    return std::ranges::count(choice_.over, table_.names[column]) > 0;
  };
  std::vector<std::size_t> all(keys_);
  std::iota(all.begin(), all.end(), 0);
  const auto first = std::ranges::find_if_not(all, is_over);
  const std::size_t axis = x_is_key_ && !choice_.x.empty() ? key(choice_.x)
                           : first != all.end()            ? *first
                                                           : 0;
  along_ = {axis};
  for (const std::size_t column : all) {
    if (column == axis) {
      continue;
    }
    const bool goes_along = vary_together(table_.cells[axis], table_.cells[column]);
    if (is_over(column) || (choice_.over.empty() && !goes_along)) {
      over_.push_back(column);
    } else {
      (goes_along || !x_is_key_ ? along_ : apart_).push_back(column);
    }
  }
}

std::optional<Interval> SweepTable::interval(std::size_t row) const {
  const auto number = [&](const char* column) { return std::stod(cell(column, row)); };
  if (!is_number(cell("mean", row))) {
    return std::nullopt;
  }
  const double mean = number("mean");
  const bool has_errors = is_number(cell("low", row)) && is_number(cell("high", row));
  return has_errors ? Interval{mean, number("low"), number("high")} : Interval{mean, mean, mean};
}

/// On the axis; none if the combination has no value there.
std::optional<Interval> SweepTable::x_interval(std::size_t row) const {
  if (x_is_key_) {
    const std::string& value = table_.cells[along_.front()][row];
    const double x = words_.empty() ? std::stod(value) : position_of(words_, value);
    return Interval{x, x, x};
  }
  const auto found = x_rows_.find(combination(row));
  return found == x_rows_.end() ? std::nullopt : interval(found->second);
}

/// The values of all keys, and the stage.
Cells SweepTable::combination(std::size_t row) const {
  Cells values = {cell("stage", row)};
  for (std::size_t key = 0; key < keys_; ++key) {
    values.push_back(table_.cells[key][row]);
  }
  return values;
}

/// Whether it is measured along or above the floor of a vessel that is turned.
bool SweepTable::is_of_turned_floor(std::size_t row) const {
  if (turned_.empty() || !turned_.contains(combination(row))) {
    return false;
  }
  const auto known = known_.find(cell("measure", row));
  return known && known->of_floor;
}

std::vector<Points> SweepTable::found() const {
  std::vector<Points> found;  // by first row, in the order of the table
  std::map<std::tuple<std::string, std::string, std::size_t>, std::size_t> numbers;
  for (std::size_t row = 0; row < table_.rows(); ++row) {
    const std::string& stage = cell("stage", row);
    const std::string& measure = cell("measure", row);
    const bool is_wanted = choice_.y.empty() ? measure != x_name() && !is_of_turned_floor(row)
                                             : std::ranges::count(choice_.y, measure) > 0;
    const auto y = interval(row);
    const auto x = is_wanted && y ? x_interval(row) : std::nullopt;
    if (!x || !is_label(stage) || !is_label(measure)) {
      continue;
    }
    const std::size_t part = parts_.of_rows[row];
    const auto [at, is_new] = numbers.emplace(std::tuple(stage, measure, part), found.size());
    if (is_new) {
      found.push_back({.row = row, .part = part});
    }
    found[at->second].points.push_back({*x, *y, lines_.of_rows[row] + 1});
  }
  std::erase_if(found, [this](const Points& points) {
    return std::ranges::none_of(points.points, [this](const Point& point) {
      const bool is_wanted = !choice_.y.empty() || point.y.mean != 0;
      return is_wanted && (!choice_.log_x || point.x.mean > 0) &&
             (!choice_.log_y || point.y.mean > 0);
    });
  });
  std::ranges::stable_sort(found, {}, &Points::part);
  return found;
}

std::string SweepTable::x_label() const {
  const std::string& name = x_name();
  const bool is_derived =
      std::ranges::count(known_.derived, name, &scene::DerivedMeasure::name) > 0;
  return is_derived || !x_is_key_ ? known_.label(name) : name;
}

Figure SweepTable::figure(const Template& figure_template, const Points& points,
                          std::size_t number) const {
  const std::string& stage = cell("stage", points.row);
  const std::string& measure = cell("measure", points.row);
  const auto known = known_.find(measure);
  const std::string& part = parts_.all[points.part];
  const std::string of = part.empty() ? "" : ", " + part;
  return {.name = fmt::format("{}-{}-{}{}", figure_template.name, stage, measure,
                              number > 0 ? fmt::format("-{}", number) : ""),
          .title = tables_.title(),
          .description = fmt::format("{}{}{}, against {}, at the end of stage {}{}. {}",
                                     known ? known->name : measure,
                                     known && !known->of.empty() ? ", " + known->of : "",
                                     known && !known->meaning.empty() ? ": " + known->meaning : "",
                                     x_label(), stage, of, figure_template.description),
          .script = figure_template.file,
          .run = tables_.run(),
          .setting = to_text(SweepSetting{
                         .file = table_.file.filename().string(),
                         .part = stage + of,
                         .x_label = x_label(),
                         .y_label = known_.label(measure),
                         .lines = lines_.all,
                         .log_x = choice_.log_x,
                         .log_y = choice_.log_y || measure.starts_with("discharged_until_clog")}) +
                     fmt::format("has_words = {}; templates = {};", words_.empty() ? 0 : 1,
                                 literal(figure_template.file.parent_path().string())) +
                     array_text("words", words_.empty() ? Cells{""} : shortened(words_)) +
                     setting_of(points.points),
          .rank = contrast(points.points) +
                  (std::ranges::count(known_.derived, measure, &scene::DerivedMeasure::name) > 0
                       ? kFirst
                       : 0)};
}

std::vector<Figure> SweepTable::figures(const Template& figure_template) const {
  std::vector<Figure> result;
  if (keys_ == 0) {
    return result;
  }
  std::map<std::pair<std::string, std::string>, std::size_t> numbers;
  for (const Points& points : found()) {
    std::size_t& number = numbers[{cell("stage", points.row), cell("measure", points.row)}];
    result.push_back(figure(figure_template, points, apart_.empty() ? 0 : ++number));
  }
  return result;
}

}  // namespace

RowLabels labels_of(const store::ReadTable& table, const std::vector<std::size_t>& keys,
                    bool is_chosen) {
  std::vector<std::pair<std::vector<double>, std::string>> rows(table.rows());  // positions, label
  for (const std::size_t key : keys) {
    const Cells& cells = table.cells[key];
    const bool is_alone =
        is_chosen && keys.size() == 1 && std::none_of(cells.begin(), cells.end(), is_number);
    const Cells values = in_order(cells);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      auto& [positions, label] = rows[row];
      positions.push_back(position_of(values, cells[row]));
      label += (label.empty() ? "" : ", ") +
               (is_alone ? cells[row] : table.names[key] + "=" + cells[row]);
    }
  }
  std::map<std::pair<std::vector<double>, std::string>, std::size_t> all;
  for (const auto& row : rows) {
    all.emplace(row, 0);
  }
  RowLabels labels;
  for (auto& [row, number] : all) {
    number = labels.all.size();
    labels.all.push_back(row.second);
  }
  for (const auto& row : rows) {
    labels.of_rows.push_back(all.at(row));
  }
  return labels;
}

std::string to_text(const SweepSetting& setting) {
  const std::string& longest = std::ranges::max(setting.lines, {}, &std::string::size);
  return fmt::format(
             "known_columns = '|'; time_column = 'step'; part = {}; x_label = {}; y_label = {};"
             "longest_label = {}; log_axes = '{}{}';",
             literal(setting.part), literal(setting.x_label), literal(setting.y_label),
             longest.size(), setting.log_x ? "x" : "", setting.log_y ? "y" : "") +
         array_text("files", {setting.file}) + array_text("groups", {""}) +
         array_text("quantity_keys", {""}) + array_text("quantity_labels", {""}) +
         array_text("lines", setting.lines);
}

std::vector<Figure> sweep_figures(RunTables& tables, const Template& figure_template,
                                  const Choice& choice) {
  const std::vector<TableFile> files = tables.files(figure_template.needs.front());
  if (files.empty()) {
    return {};
  }
  return SweepTable(tables, tables.read(files.front().name), choice).figures(figure_template);
}

}  // namespace clca::plot
