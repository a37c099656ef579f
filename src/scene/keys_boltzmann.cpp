// The block of a scene of the Boltzmann equation, and what it wants to have written.

#include <algorithm>

#include "clca/boltzmann/scheme.hpp"
#include "clca/text/read.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr std::size_t kMaxRestitutions = 64;
constexpr double kMaxFriction = 1000;
constexpr double kMaxRows = 1'000'000;  // of a series
constexpr std::size_t kMaxHistograms = 1000;
constexpr int kMinQuantiles = 2;
constexpr int kMaxQuantiles = 1000;
constexpr double kMaxUniformBins = 10'000;
constexpr double kMaxEnergy = 1e6;  // where uniform bins end at the most

void read_restitutions(const PlacedValue& fields, BoltzmannScene& scene) {
  const Type<double> restitution = number_type(0, 1);
  const PlacedValue place = fields.at("restitution");
  scene.has_restitution_list = place.value.is(Value::Kind::list);
  scene.restitutions =
      scene.has_restitution_list
          ? set_type(restitution, 1, kMaxRestitutions, found, "; name each value once").read(place)
          : std::vector<double>{restitution.read(place)};
}

Key<BoltzmannScene> restitution_key() {
  const Type<double> one = number_type(0, 1);
  const auto several = set_type(one, 1, kMaxRestitutions);
  return custom_key<BoltzmannScene>(
             "restitution",
             {.allowed =
                  fmt::format("0 to 1, or a list of 1 to {} different ones", kMaxRestitutions),
              .schema = any_of({one.schema, several.schema})},
             "ε, normal restitution; of a list, one run for each, in that order", read_restitutions)
      .mark_required()
      .written_as([=](const BoltzmannScene& scene, const Scene& none) {
        return std::optional(scene.has_restitution_list
                                 ? several.text(scene.restitutions, none)
                                 : one.text(scene.restitutions.front(), none));
      });
}

bool is_majorant(const BoltzmannScene& scene) {
  return std::holds_alternative<boltzmann::Majorant>(scene.scheme);
}

/// Refuses a key that only the other scheme has.
void refuse_key(const PlacedValue& fields, std::string_view key, const BoltzmannScene& scene) {
  if (fields.find(key) != nullptr) {
    fail(fields.at(key), "only scheme: {} has it; leave it out, or change the scheme",
         name_of(kSchemeNames, 1 - scene.scheme.index()));
  }
}

Type<boltzmann::Scheme> scheme_type() {
  const Type<std::size_t> index = choice_type(kSchemeNames);
  return converted<boltzmann::Scheme>(
      index.allowed, index,
      [](std::size_t scheme) { return scheme == 0 ? boltzmann::Scheme() : boltzmann::OgawaKato(); },
      [](const boltzmann::Scheme& scheme) { return scheme.index(); });
}

void check_block(const PlacedValue& fields, BoltzmannScene& scene) {
  if (auto* ogawa_kato = std::get_if<boltzmann::OgawaKato>(&scene.scheme)) {
    ogawa_kato->quasi_random = scene.quasi_random;
  }
  if (fields.find("friction") == nullptr) {
    if (fields.find("roughness") == nullptr) {
      fail(fields, "expected friction, roughness or both, found none");
    }
    scene.friction = boltzmann::kNoSlidingLimit;
  }
  scene.histogram_times = {0, scene.end_time};
}

void read_histograms(const PlacedValue& fields, BoltzmannScene& scene) {
  if (fields.find("histograms") == nullptr) {
    return;
  }
  const double apart = kTimeTolerance * scene.series_interval;
  std::vector<double>& times = scene.histogram_times;
  times.clear();
  const auto time = [&](const PlacedValue& place) {
    return read_number<double>(place, 0, scene.end_time);
  };
  for (const PlacedValue& item : read_list(fields.at("histograms"), 0, kMaxHistograms, time)) {
    times.push_back(time(item));
    if (times.size() > 1 && times.back() - times[times.size() - 2] <= apart) {
      fail(item, "expected times that ascend by more than {}, found {} after {}", apart,
           times.back(), times[times.size() - 2]);
    }
  }
}

/// `q20`, of plain digits.
QuantileBins read_quantiles(const PlacedValue& place) {
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
      {.keys = {required_key("width", &UniformBins::width, positive_type(kMaxEnergy),
                             fmt::format("at most `end`, and at most {} bins", kMaxUniformBins)),
                required_key("end", &UniformBins::last_bin_start, positive_type(kMaxEnergy),
                             "where the last bin begins, which has no end")},
       .check = [](const PlacedValue& fields, UniformBins& bins) {
         if (bins.width > bins.last_bin_start ||
             bins.last_bin_start > kMaxUniformBins * bins.width) {
           fail(fields.at("width"),
                "expected a number from {} to {} for at most {} bins up to {}, found {}",
                bins.last_bin_start / kMaxUniformBins, bins.last_bin_start, kMaxUniformBins,
                bins.last_bin_start, found(fields.at("width")));
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
  const auto times = list_type(number_type(0, kMaxTime), 0, kMaxHistograms);
  return custom_key<BoltzmannScene>(
             "histograms",
             {.allowed = fmt::format("list of at most {}", kMaxHistograms),
              .schema = with(array_schema(number_type(0, kMaxTime).schema),
                             fmt::format(R"("maxItems": {}, {})", kMaxHistograms, kUniqueItems))},
             "times, ascending, from 0 to `until`, at which the distributions of both energies are "
             "written; `[]` for none",
             read_histograms)
      .defaults_to("begin and end")
      .written_as([=](const BoltzmannScene& scene, const Scene& none) {
        return std::optional(times.text(scene.histogram_times, none));
      });
}

}  // namespace

Key<BoltzmannScene> boltzmann_block_key() {
  using B = BoltzmannScene;
  Map<B> map = {
      .keys =
          {key("particles", &B::particles, count_type(2, 100'000'000), "size of the sample"),
           key("initial", &B::initial, choice_type(kInitialNames),
               "velocities and spins normal and independent, or the same speed and the same spin "
               "for all, directions isotropic"),
           key("exact_moments", &B::exact_moments, bool_type(),
               "shifts and scales the sample so that both means are zero and both mean squares "
               "exact"),
           key("sampling", &B::quasi_random, choice_type(kSamplingNames),
               "draws of the beginning, and all draws of `ogawa-kato`: independent, or from a "
               "randomly shifted lattice"),
           restitution_key(),
           key("friction", &B::friction, number_type(0, kMaxFriction),
               "η of Coulomb, of rough spheres")
               .defaults_to("nothing slides")
               .written_if(
                   [](const B& scene) { return scene.friction != boltzmann::kNoSlidingLimit; }),
           key("roughness", &B::roughness, number_type(-1, 1),
               "β, tangential restitution where nothing slides: -1 smooth, 1 reversed"),
           key("energy_ratio", &B::energy_ratio, number_type(0, 1e6),
               "C_e = I⟨ω²⟩/(m⟨v²⟩) at time 0"),
           key("scheme", &B::scheme, scheme_type(),
               "pairs in continuous time; or the time steps of the paper, which are biased")
               .with_action([](const PlacedValue& fields, B& scene) {
                 const Value* given = fields.find("scheme");
                 if (given == nullptr || given->text == kSchemeNames.front().name) {
                   refuse_key(fields, "time_step", scene);
                   refuse_key(fields, "partners", scene);
                 }
               }),
           inlined_alternative(&B::scheme, key("time_step", &boltzmann::OgawaKato::time_step,
                                               positive_type(1), "of `ogawa-kato` only")),
           inlined_alternative(
               &B::scheme,
               key("partners", &boltzmann::OgawaKato::partner_count, integer_type(1, 1000),
                   "of `ogawa-kato` only: how many each particle draws in a step")),
           key("shear_rate", &B::shear_rate, number_type(0, 100),
               "of `majorant` only: velocity gradient of uniform shear flow, per unit of time")
               .with_action([](const PlacedValue& fields, B& scene) {
                 if (!is_majorant(scene)) {
                   refuse_key(fields, "shear_rate", scene);
                 }
               })
               .written_if(is_majorant),
           key("until", &B::end_time, positive_type(kMaxTime), "time at the end"),
           key("ensemble", &B::ensemble_size, count_type(1, 10'000),
               "runs with seeds derived from `seed`, for means and their errors")},
      .check = check_block,
      .schema_members = R"(
        "anyOf": [{"required": ["friction"]}, {"required": ["roughness"]}],
        "dependencies": {
          "time_step": {"required": ["scheme"], "properties": {"scheme": {"const": "ogawa-kato"}}},
          "partners": {"required": ["scheme"], "properties": {"scheme": {"const": "ogawa-kato"}}},
          "shear_rate": {"not": {"required": ["scheme"],
                                 "properties": {"scheme": {"const": "ogawa-kato"}}}}})"};
  return section_key("boltzmann", map,
                     "the gas, what a collision does, and for how long: [boltzmann](#boltzmann)")
      .mark_required();
}

Key<BoltzmannScene> boltzmann_output_key() {
  using B = BoltzmannScene;
  const Map<B> series = {
      .keys = {
          key("every", &B::series_interval, positive_type(kMaxTime),
              fmt::format("time from one row to the next; at most {} rows in all", kMaxRows))}};
  return section_key<B>(
      "output",
      {.keys =
           {section_key("series", series, "table of what changes over time"), histograms_key(),
            key("bins", &B::bins, bins_type(),
                "bins of the energies in their present scale: so many that are equally probable "
                "under chi-square, or bins of one width from 0 to an end, and one beyond"),
            key("checkpoint", &B::checkpoint, or_none(gas_checkpoint_type()),
                "when the run saves a checkpoint, besides at its end and when it is stopped")}},
      "what is written during the run: [output of a Boltzmann run](#output-of-a-boltzmann-run)");
}

void check_series_rows(const PlacedValue& root, const BoltzmannScene& scene) {
  if (scene.end_time <= kMaxRows * scene.series_interval) {
    return;
  }
  const Value* every = root.value.find_path("output.series.every");
  fail((every != nullptr ? *every : root.at("boltzmann").at("until").value).location,
       "output.series.every: expected at least {}, as a series has at most {} rows until {}, found "
       "{}",
       scene.end_time / kMaxRows, kMaxRows, scene.end_time,
       every != nullptr ? found(*every) : fmt::format("the default {}", scene.series_interval));
}

}  // namespace clca::scene
