#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "report/sections.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

using store::MeasureValue;
using store::StageSummary;

constexpr std::size_t kMaxStages = 16;
constexpr std::string_view kErrorEnding = "_se";

MeasureValue value_in(const StageSummary& stage, const std::string& name) {
  const auto found = std::find_if(stage.measures.begin(), stage.measures.end(),
                                  [&](const auto& measure) { return measure.first == name; });
  return found == stage.measures.end() ? MeasureValue() : found->second;
}

/// Measures in order; standard errors are shown beside their measure.
std::vector<std::string> measure_keys(const std::vector<StageSummary>& stages) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const StageSummary& stage : stages) {
    for (const auto& [name, value] : stage.measures) {
      if (!name.ends_with(kErrorEnding) && known.insert(name).second) {
        names.push_back(name);
      }
    }
  }
  return names;
}

int row_decimals(const std::vector<StageSummary>& stages, const std::string& name) {
  std::vector<double> numbers;
  std::vector<double> errors;
  for (const StageSummary& stage : stages) {
    const MeasureValue value = value_in(stage, name);
    if (const auto* number = std::get_if<double>(&value)) {
      numbers.push_back(*number);
    }
    const MeasureValue error = value_in(stage, name + std::string(kErrorEnding));
    if (const auto* size = std::get_if<double>(&error)) {
      errors.push_back(*size);
    }
  }
  return decimals_for(numbers, errors);
}

std::string value_html(const StageSummary& stage, const std::string& name, int decimals) {
  const MeasureValue value = value_in(stage, name);
  if (const auto* answer = std::get_if<bool>(&value)) {
    return *answer ? "yes" : "no";
  }
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) {
    return "–";
  }
  const MeasureValue error = value_in(stage, name + std::string(kErrorEnding));
  const auto* size = std::get_if<double>(&error);
  return number_html(*number, size != nullptr ? *size : std::numeric_limits<double>::quiet_NaN(),
                     decimals);
}

/// The vessel is turned at the end of the stage.
bool is_turned(const StageSummary& stage) {
  const MeasureValue angle = value_in(stage, std::string(run::kVesselAngleKey));
  const auto* degrees = std::get_if<double>(&angle);
  return degrees != nullptr && *degrees != 0;
}

/// Leaves out what is measured along or above the floor of a vessel that is turned.
std::vector<StageSummary> without_turned_floors(std::vector<StageSummary> stages,
                                                const run::KnownQuantities& known) {
  for (StageSummary& stage : stages) {
    if (is_turned(stage)) {
      std::erase_if(stage.measures, [&](const auto& measure) {
        const auto quantity = known.find(measure.first);
        return quantity && quantity->of_floor;
      });
    }
  }
  return stages;
}

std::string row_html(const std::vector<StageSummary>& stages, const std::string& key,
                     const std::optional<run::ShownQuantity>& known) {
  std::string row = "<tr>" + measure_heading(key, known);
  const int decimals = row_decimals(stages, key);
  for (const StageSummary& stage : stages) {
    row += fmt::format(R"(<td data-of="{}">{}</td>)", escaped(stage.name),
                       value_html(stage, key, decimals));
  }
  return row + fmt::format(R"(<td class="unit">{}</td><td class="key"><code>{}</code></td></tr>
)",
                           escaped(known ? known->unit : ""), escaped(key));
}

std::vector<StageSummary> shown_stages(const std::vector<StageSummary>& stages) {
  std::vector<StageSummary> shown;
  for (const std::size_t number : evenly(stages.size(), kMaxStages)) {
    shown.push_back(stages[number]);
  }
  return shown;
}

std::string head_html(const std::vector<StageSummary>& stages,
                      const std::optional<scene::Conversion>& units) {
  std::string names = R"(<tr><th scope="col">Stage</th>)";
  std::string ends = R"(<tr class="how"><th scope="row">Steps, and how it ended</th>)";
  for (const StageSummary& stage : stages) {
    names += fmt::format(R"(<th scope="col">{}</th>)", escaped(stage.name));
    const std::string time = units ? fmt::format(" ({})", units->time_text(stage.steps)) : "";
    ends += fmt::format(R"(<td data-of="{}">{}{} <small>{}</small></td>)", escaped(stage.name),
                        whole(stage.steps), escaped(time), escaped(stage.ended));
  }
  return fmt::format(
      R"(<thead>{}<th scope="col" class="unit">Unit</th><th scope="col" class="key">In run.json</th></tr></thead><tbody>
{}<td class="unit"></td><td class="key"></td></tr>
)",
      names, ends);
}

}  // namespace

std::string measure_heading(const std::string& key,
                            const std::optional<run::ShownQuantity>& known) {
  if (!known) {
    return fmt::format(R"(<th scope="row">{}</th>)", escaped(key));
  }
  return fmt::format(
      R"(<th scope="row">{}{}{}</th>)", escaped(known->name),
      known->of.empty() ? "" : fmt::format(" ({})", escaped(known->of)),
      known->meaning.empty() ? "" : fmt::format("<small>{}</small>", escaped(known->meaning)));
}

std::string measures_html(const store::RunSummary& summary) {
  if (summary.stages.empty()) {
    return {};
  }
  constexpr std::size_t kMaxMeasures = 200;
  const run::KnownQuantities known = run::known_quantities(summary);
  const std::vector<StageSummary> stages =
      without_turned_floors(shown_stages(summary.stages), known);
  std::string html =
      R"(<div class="wide" tabindex="0" role="region" aria-label="Measures"><table>)";
  html += head_html(stages, summary.units);
  std::vector<std::string> keys = measure_keys(stages);
  keys.resize(std::min(keys.size(), kMaxMeasures));
  for (const std::string& key : keys) {
    html += row_html(stages, key, known.find(key));
  }
  html += "</tbody></table></div>\n";
  if (std::any_of(stages.begin(), stages.end(), is_turned)) {
    html += kTurnedNote;
  }
  if (stages.size() < summary.stages.size()) {
    html += fmt::format(
        "<p class=\"note\">{} of {} stages, evenly chosen; all are in <code>run.json</code>.</p>\n",
        stages.size(), summary.stages.size());
  }
  return html;
}

}  // namespace clca::report
