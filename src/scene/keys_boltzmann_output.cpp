// What a scene of the Boltzmann equation wants to have written.

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

void read_histograms(const KeyedMap& fields, BoltzmannScene& scene, const Scene& /*scene*/) {
  const Value* value = fields.find("histograms");
  if (value == nullptr) {
    return;
  }
  const std::string path = fields.path("histograms");
  const double apart = kSameTime * scene.series_every;
  std::vector<double>& times = scene.histograms;
  times.clear();
  for (const Value& item : read_list(*value, path, 0, kMaxHistograms)) {
    times.push_back(read_number(item, path, 0, scene.until));
    if (times.size() > 1 && times.back() - times[times.size() - 2] <= apart) {
      fail(item.location,
           fmt::format("{}: expected times that ascend by more than {}, found {} after {}", path,
                       apart, times.back(), times[times.size() - 2]));
    }
  }
}

/// The number in `q20`; nothing where it is not plain digits in range.
std::optional<int> quantiles(const Value& value) {
  const std::string_view text = value.text;
  const std::string_view number = text.substr(std::min<std::size_t>(1, text.size()));
  int count = 0;
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), count);
  const bool whole = error == std::errc() && stop == number.data() + number.size();
  const bool plain = text.starts_with('q') && !number.starts_with('0') && whole;
  return plain && count >= kMinQuantiles && count <= kMaxQuantiles ? std::optional(count)
                                                                   : std::nullopt;
}

Type<UniformBins> uniform_bins() {
  return type_of<UniformBins>(
      {.keys = {required("width", &UniformBins::width, above_zero(kMaxEnergy),
                         fmt::format("at most `end`, and at most {} bins", kMaxUniformBins)),
                required("end", &UniformBins::end, above_zero(kMaxEnergy),
                         "where the last bin begins, which has no end")},
       .check = [](const KeyedMap& fields, UniformBins& bins, const Scene& /*scene*/) {
         if (bins.width > bins.end || bins.end > kMaxUniformBins * bins.width) {
           fail(fields.at("width").location,
                fmt::format(
                    "{}: expected a number from {} to {} for at most {} bins up to {}, found "
                    "{}",
                    fields.path("width"), bins.end / kMaxUniformBins, bins.end, kMaxUniformBins,
                    bins.end, found(fields.at("width"))));
         }
       }});
}

Type<BinsSpec> bins_type() {
  const Type<UniformBins> uniform = uniform_bins();
  auto type = own_type<BinsSpec>(
      fmt::format("`q{}` to `q{}`, or map", kMinQuantiles, kMaxQuantiles),
      any_of({text_schema("^q([2-9]|[1-9][0-9]{1,2}|1000)$"), uniform.schema}),
      [=](const Value& value, const std::string& path, const Scene& scene) -> BinsSpec {
        if (value.is(Value::Kind::map)) {
          return uniform.read(value, path, scene);
        }
        const std::optional<int> count = quantiles(value);
        if (!count) {
          fail(value.location,
               fmt::format("{}: expected q{} to q{} or {{width: WIDTH, end: END}}, found {}", path,
                           kMinQuantiles, kMaxQuantiles, found(value)));
        }
        return QuantileBins{*count};
      },
      [=](const BinsSpec& bins, const Scene& scene) {
        const auto* quantile = std::get_if<QuantileBins>(&bins);
        return quantile != nullptr ? Yaml::scalar(fmt::format("q{}", quantile->count))
                                   : uniform.text(std::get<UniformBins>(bins), scene);
      });
  type.keys = uniform.keys;
  return type;
}

Key<BoltzmannScene> histograms_key() {
  return own_key<BoltzmannScene>(
      {.name = "histograms",
       .about =
           "times, ascending, from 0 to `until`, at which the distributions of both energies are "
           "written; `[]` for none",
       .allowed = fmt::format("list of at most {}", kMaxHistograms),
       .otherwise = "begin and end",
       .schema =
           unique(with(array_schema(number_schema(0, kMaxTime)), "maxItems", kMaxHistograms))},
      read_histograms, [](const BoltzmannScene& scene, const Scene& /*scene*/) {
        return std::optional(numbers_text(scene.histograms));
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

void check_rows(const Value& root, const BoltzmannScene& scene) {
  if (scene.until <= kMaxRows * scene.series_every) {
    return;
  }
  const Value* output = root.find("output");
  const Value* series = output == nullptr ? nullptr : output->find("series");
  const Value* every = series == nullptr ? nullptr : series->find("every");
  const Value* until = root.find("boltzmann")->find("until");
  fail((every != nullptr ? every : until)->location,
       fmt::format(
           "output.series.every: expected at least {}, as a series has at most {} "
           "rows until {}, found {}",
           scene.until / kMaxRows, kMaxRows, scene.until,
           every != nullptr ? found(*every) : fmt::format("the default {}", scene.series_every)));
}

}  // namespace clca::scene
