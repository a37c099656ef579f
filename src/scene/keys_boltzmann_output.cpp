// What a scene of the Boltzmann equation wants to have written.

#include <algorithm>
#include <optional>

#include "clca/text/number.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

void read_histograms(const KeyedMap& fields, BoltzmannScene& scene) {
  if (fields.find("histograms") == nullptr) {
    return;
  }
  const double apart = kSameTime * scene.series_every;
  std::vector<double>& times = scene.histograms;
  times.clear();
  const auto time = [&](const Place& place) { return read_number(place, 0, scene.until); };
  for (const Place& item : read_list(fields.at("histograms"), 0, kMaxHistograms, time)) {
    times.push_back(time(item));
    if (times.size() > 1 && times.back() - times[times.size() - 2] <= apart) {
      fail(item, "expected times that ascend by more than {}, found {} after {}", apart,
           times.back(), times[times.size() - 2]);
    }
  }
}

/// `q20`, of plain digits.
QuantileBins read_quantiles(const Place& place) {
  const std::string_view text = place.value.text;
  const std::string_view number = text.substr(std::min<std::size_t>(1, text.size()));
  const auto count = text::number<int>(number);
  const bool plain = text.starts_with('q') && !number.starts_with('0') && count;
  if (!plain || *count < kMinQuantiles || *count > kMaxQuantiles) {
    fail(place, "expected q{} to q{} or {{width: WIDTH, end: END}}, found {}", kMinQuantiles,
         kMaxQuantiles, found(place));
  }
  return {*count};
}

Type<UniformBins> uniform_bins() {
  return type_of<UniformBins>(
      {.keys = {required("width", &UniformBins::width, above_zero(kMaxEnergy),
                         fmt::format("at most `end`, and at most {} bins", kMaxUniformBins)),
                required("end", &UniformBins::end, above_zero(kMaxEnergy),
                         "where the last bin begins, which has no end")},
       .check = [](const KeyedMap& fields, UniformBins& bins) {
         if (bins.width > bins.end || bins.end > kMaxUniformBins * bins.width) {
           fail(fields.at("width"),
                "expected a number from {} to {} for at most {} bins up to {}, found {}",
                bins.end / kMaxUniformBins, bins.end, kMaxUniformBins, bins.end,
                found(fields.at("width")));
         }
       }});
}

Type<BinsSpec> bins_type() {
  const auto map = converted<BinsSpec>(
      "map", uniform_bins(), [](const UniformBins& bins) { return bins; },
      [](const BinsSpec& bins) { return std::get<UniformBins>(bins); });
  return or_map(fmt::format("`q{}` to `q{}`", kMinQuantiles, kMaxQuantiles),
                text_schema("^q([2-9]|[1-9][0-9]{1,2}|1000)$"), map, read_quantiles,
                [](const BinsSpec& bins) {
                  const auto* quantiles = std::get_if<QuantileBins>(&bins);
                  return quantiles != nullptr
                             ? std::optional(Value::scalar(fmt::format("q{}", quantiles->count)))
                             : std::nullopt;
                });
}

Key<BoltzmannScene> histograms_key() {
  const auto times = list_of(number(0, kMaxTime), 0, kMaxHistograms);
  return own_key<BoltzmannScene>({.name = "histograms",
                                  .about = "times, ascending, from 0 to `until`, at which the "
                                           "distributions of both energies are "
                                           "written; `[]` for none",
                                  .allowed = fmt::format("list of at most {}", kMaxHistograms),
                                  .otherwise = "begin and end",
                                  .schema = unique(with(array_schema(number_schema(0, kMaxTime)),
                                                        "maxItems", kMaxHistograms))},
                                 read_histograms)
      .written_as([=](const BoltzmannScene& scene, const Scene& none) {
        return std::optional(times.text(scene.histograms, none));
      });
}

}  // namespace

Key<BoltzmannScene> boltzmann_output() {
  using B = BoltzmannScene;
  const Map<B> series = {
      .keys = {
          key("every", &B::series_every, above_zero(kMaxTime),
              fmt::format("time from one row to the next; at most {} rows in all", kMaxRows))}};
  return section<B>(
      "output",
      {.keys =
           {section("series", series, "table of what changes over time"), histograms_key(),
            key("bins", &B::bins, bins_type(),
                "bins of the energies in their present scale: so many that are equally probable "
                "under chi-square, or bins of one width from 0 to an end, and one beyond"),
            key("checkpoint", &B::checkpoint, or_none(gas_checkpoint_type()),
                "when the run saves a checkpoint, besides at its end and when it is stopped",
                std::optional(kDefaultCheckpoints))}},
      "what is written during the run: [output of a Boltzmann run](#output-of-a-boltzmann-run)");
}

void check_rows(const Place& root, const BoltzmannScene& scene) {
  if (scene.until <= kMaxRows * scene.series_every) {
    return;
  }
  const Value* every = root.value.find_path("output.series.every");
  fail((every != nullptr ? *every : root.at("boltzmann").at("until").value).location,
       "output.series.every: expected at least {}, as a series has at most {} rows until {}, found "
       "{}",
       scene.until / kMaxRows, kMaxRows, scene.until,
       every != nullptr ? found(*every) : fmt::format("the default {}", scene.series_every));
}

}  // namespace clca::scene
