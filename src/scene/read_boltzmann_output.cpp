// What a scene of the Boltzmann equation wants to have written.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

std::vector<double> read_histograms(const Value& value, const std::string& path,
                                    const BoltzmannScene& scene) {
  const double apart = kSameTime * scene.series_every;
  std::vector<double> times;
  for (const Value& item : read_list(value, path, 0, kMaxHistograms)) {
    times.push_back(read_number(item, path, 0, scene.until));
    if (times.size() > 1 && times.back() - times[times.size() - 2] <= apart) {
      fail(item.location,
           fmt::format("{}: expected times that ascend by more than {}, found {} after {}", path,
                       apart, times.back(), times[times.size() - 2]));
    }
  }
  return times;
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

UniformBins read_uniform_bins(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kUniformBinsKeys);
  const UniformBins bins = {.width = fields.positive("width", kMaxEnergy),
                            .end = fields.positive("end", kMaxEnergy)};
  if (bins.width > bins.end || bins.end > kMaxUniformBins * bins.width) {
    fail(fields.at("width").location,
         fmt::format("{}: expected a number from {} to {} for at most {} bins up to {}, found {}",
                     fields.path("width"), bins.end / kMaxUniformBins, bins.end, kMaxUniformBins,
                     bins.end, found(fields.at("width"))));
  }
  return bins;
}

BinsSpec read_bins(const Value& value, const std::string& path) {
  if (value.is(Value::Kind::map)) {
    return read_uniform_bins(value, path);
  }
  const std::optional<int> count = quantiles(value);
  if (!count) {
    fail(value.location,
         fmt::format("{}: expected q{} to q{} or {{width: WIDTH, end: END}}, found {}", path,
                     kMinQuantiles, kMaxQuantiles, found(value)));
  }
  return QuantileBins{*count};
}

std::optional<Checkpoints> read_checkpoint(const Value& value, const std::string& path) {
  if (is_none(&value)) {
    return std::nullopt;
  }
  const KeyedMap fields(value, path, kGasCheckpointKeys);
  return Checkpoints{.every = {}, .seconds = fields.positive("seconds", kMaxWait)};
}

/// `every` is null where it is left to its default.
void check_rows(const Value* every, const Value& block, const BoltzmannScene& scene) {
  if (scene.until <= kMaxRows * scene.series_every) {
    return;
  }
  const TextLocation& location = every != nullptr ? every->location : block.find("until")->location;
  fail(location,
       fmt::format(
           "output.series.every: expected at least {}, as a series has at most {} "
           "rows until {}, found {}",
           scene.until / kMaxRows, kMaxRows, scene.until,
           every != nullptr ? found(*every) : fmt::format("the default {}", scene.series_every)));
}

}  // namespace

void read_boltzmann_output(const Value* output, const Value& block, BoltzmannScene& scene) {
  scene.histograms = {0, scene.until};
  scene.checkpoint = kDefaultCheckpoints;
  const Value* every = nullptr;
  if (output != nullptr) {
    const KeyedMap fields(*output, "output", kBoltzmannOutputKeys);
    if (const Value* series = fields.find("series")) {
      const KeyedMap rows(*series, fields.path("series"), kSeriesKeys);
      every = rows.find("every");
      scene.series_every = rows.positive("every", kMaxTime, scene.series_every);
    }
    if (const Value* times = fields.find("histograms")) {
      scene.histograms = read_histograms(*times, fields.path("histograms"), scene);
    }
    if (const Value* bins = fields.find("bins")) {
      scene.bins = read_bins(*bins, fields.path("bins"));
    }
    if (const Value* checkpoint = fields.find("checkpoint")) {
      scene.checkpoint = read_checkpoint(*checkpoint, fields.path("checkpoint"));
    }
  }
  check_rows(every, block, scene);
}

}  // namespace clca::scene
