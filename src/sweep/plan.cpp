#include "clca/sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "clca/record/quantity.hpp"
#include "clca/run/run.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"
#include "clca/store/summary.hpp"
#include "clca/text/message.hpp"
#include "clca/text/read.hpp"

namespace clca::sweep {

namespace {

std::string option_text(const Variation& variation) {
  return "--vary " + text::shortened(fmt::format("{}={}", fmt::join(variation.keys, ","),
                                                 fmt::join(variation.value_rows.front(), ",")));
}

/// The seed is no key of a sweep, nor is what has the name of a column of its tables.
void check_keys(const Request& request) {
  const std::map<std::string_view, std::vector<std::string>> none = {{"KEY", {}},
                                                                     {"STAGE.MEASURE", {}}};
  std::vector<std::string> columns = record::sweep_column_names("runs", none);
  std::ranges::copy(record::sweep_column_names("measures", none), std::back_inserter(columns));
  const auto refuse_seed = [](const std::string& option) {
    throw scene::SceneError(option + ": error: the seeds of a sweep are given by --seeds");
  };
  for (const Variation& variation : request.variations) {
    if (std::ranges::count(variation.keys, "seed") > 0) {
      refuse_seed(option_text(variation));
    }
    const auto taken = std::ranges::find_first_of(variation.keys, columns);
    if (taken != variation.keys.end()) {
      throw scene::SceneError(fmt::format(
          "{}: error: tables of a sweep have a column '{}' of their own; a number under let can be "
          "varied as let.{}",
          option_text(variation), *taken, *taken));
    }
  }
  for (const scene::Override& given : request.overrides) {
    if (given.text.starts_with("seed=")) {
      refuse_seed("--set " + text::shortened(given.text));
    }
  }
}

std::size_t combination_count(const Request& request) {
  std::size_t count = 1;
  for (const Variation& variation : request.variations) {
    count *= variation.value_rows.size();
    if (const std::size_t runs = count * request.seeds.size(); runs > kMaxRuns) {
      throw scene::SceneError(fmt::format("{},...: error: {} runs and more; a sweep has at most {}",
                                          option_text(variation), runs, kMaxRuns));
    }
  }
  return count;
}

/// The values of combination `number`, the last variation changing fastest.
std::vector<std::string> combination_values(const std::vector<Variation>& variations,
                                            std::size_t number) {
  std::vector<std::string> values;
  for (std::size_t i = variations.size(); i > 0; --i) {
    const auto& rows = variations[i - 1].value_rows;
    const std::vector<std::string>& row = rows[number % rows.size()];
    values.insert(values.begin(), row.begin(), row.end());
    number /= rows.size();
  }
  return values;
}

/// FIRST:LAST, which lacks the step of a range.
bool is_part_of_range(std::string_view value) {
  const std::size_t colon = value.find(':');
  const auto is_number = [](std::string_view text) {
    return scene::metres_in(text) || text::number<double>(text).has_value();
  };
  return colon != std::string_view::npos && is_number(value.substr(0, colon)) &&
         is_number(value.substr(colon + 1));
}

Variant parsed_variant(const Request& request, std::string_view text,
                       const std::vector<std::string>& keys, std::vector<std::string> values) {
  std::vector<scene::Override> varied;
  for (std::size_t i = 0; i < values.size(); ++i) {
    varied.emplace_back(fmt::format("{}={}", keys[i], values[i]));
  }
  scene::AnyScene any;
  try {
    any = scene::parse_any(text, request.scene_file.string(), request.overrides, varied);
  } catch (const scene::SceneError& error) {
    if (std::ranges::any_of(values, is_part_of_range)) {
      throw scene::SceneError(std::string(error.what()) + "; a range is FIRST:LAST:STEP");
    }
    throw;
  }
  if (const auto* boltzmann = std::get_if<scene::BoltzmannScene>(&any)) {
    throw scene::SceneError(boltzmann->location +
                            ": error: a sweep takes scenes of grains only; this one has "
                            "boltzmann.ensemble and lists of boltzmann.restitution of its own");
  }
  auto scene = std::get<scene::Scene>(std::move(any));
  record::check_derived(scene);
  scene.seed = request.seeds.front();
  return {std::move(values), std::move(scene)};
}

/// Finds the state that the runs begin with, once where it is the same.
void find_begins(std::vector<Variant>& variants, double max_bytes) {
  const scene::InitialState* last = nullptr;
  for (Variant& variant : variants) {
    std::optional<scene::InitialState>& begin = variant.scene.initial_state;
    if (begin && last != nullptr && begin->run_folder == last->run_folder &&
        begin->step == last->step &&
        (!begin->state_hash || begin->state_hash == last->state_hash)) {
      begin->state_hash = last->state_hash;
      begin->particles = last->particles;
    } else {
      run::resolve_begin(variant.scene, max_bytes);
    }
    last = begin ? &*begin : nullptr;
  }
}

/// FNV-1a. The names of folders outlive the program, so std::hash will not do.
std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 0xcbf29ce484222325;
  for (const char letter : text) {
    value = (value ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
  }
  return value;
}

/// `text` where it can name a file as it is; else its beginning with other signs for what cannot
/// stand there, and a hash of the whole.
std::string file_name(const std::string& text) {
  constexpr std::size_t kMaxLength = 120;
  static const std::regex kOther("[^A-Za-z0-9=,._+-]");
  const std::string name = std::regex_replace(text.substr(0, kMaxLength), kOther, "_");
  return name == text ? name : fmt::format("{}-{:016x}", name, hash(text));
}

}  // namespace

Plan plan(Request request, double max_bytes, const std::function<void()>& interrupt) {
  check_keys(request);
  const std::size_t count = combination_count(request);
  const std::string text =
      request.scene_text ? *request.scene_text : scene::read_scene_text(request.scene_file);
  Plan result = {std::move(request), {}};
  const std::vector<std::string> keys = result.varied_keys();
  for (std::size_t number = 0; number < count; ++number) {
    interrupt();
    result.variants.push_back(parsed_variant(
        result.request, text, keys, combination_values(result.request.variations, number)));
  }
  find_begins(result.variants, max_bytes);
  return result;
}

int fitting_jobs(const Plan& plan, int jobs, double max_bytes,
                 const std::function<void()>& interrupt) {
  double largest = 1;
  for (const Variant& variant : plan.variants) {
    interrupt();
    run::check_memory(variant.scene, max_bytes);
    scene::check_walls(variant.scene);
    scene::check_room(variant.scene);
    largest = std::max(largest, run::estimated_run_bytes(variant.scene));
  }
  return static_cast<int>(std::min<double>(jobs, max_bytes / largest));
}

std::uint64_t hash_of(const Plan& plan, std::string_view more) {
  std::string all = fmt::format("{} {} {}", store::version(), to_text(plan.request.seeds), more);
  for (const Variant& variant : plan.variants) {
    all += scene::to_yaml(variant.scene);
  }
  return hash(all);
}

std::vector<std::string> Plan::varied_keys() const {
  std::vector<std::string> keys;
  for (const Variation& variation : request.variations) {
    keys.insert(keys.end(), variation.keys.begin(), variation.keys.end());
  }
  return keys;
}

std::string Plan::title() const {
  const std::string& title = variants.front().scene.title;
  const bool is_same = std::ranges::all_of(
      variants, [&](const Variant& variant) { return variant.scene.title == title; });
  return is_same ? title : "";
}

scene::Scene Plan::scene(std::size_t run) const {
  scene::Scene result = variant(run).scene;
  result.seed = seed(run);
  return result;
}

std::string Plan::run_name(std::size_t run) const {
  const std::vector<std::string> all_keys = varied_keys();
  std::string values;
  for (std::size_t i = 0; i < all_keys.size(); ++i) {
    values += fmt::format("{}={},", all_keys[i], variant(run).values[i]);
  }
  if (!values.empty()) {
    values.pop_back();
    values = file_name(values) + ",";
  }
  return fmt::format("{}seed={}", values, seed(run));
}

}  // namespace clca::sweep
