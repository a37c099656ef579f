#include "clca/store/summary.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "clca/store/file.hpp"
#include "clca/text/read.hpp"

namespace clca::store {

namespace {

using Json = nlohmann::ordered_json;

Json to_value(const MeasureValue& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    return *number;
  }
  if (const auto* answer = std::get_if<bool>(&value)) {
    return *answer;
  }
  return nullptr;
}

Json to_object(const scene::UnitConversion& units) {
  Json object = {{"length", units.length_unit},
                 {"time", units.time_unit},
                 {"velocity", units.velocity_unit},
                 {"spacing", units.spacing},
                 {"time_step", units.time_step}};
  if (units.site_mass) {
    object["site_mass"] = units.site_mass->mass;
    object["site_weight"] = units.site_mass->weight;
  }
  return object;
}

Json to_object(const std::vector<scene::DerivedMeasure>& derived) {
  Json object = Json::object();
  for (const scene::DerivedMeasure& measure : derived) {
    object[measure.name] = {{"value", measure.expression}, {"unit", measure.unit}};
    if (measure.about) {
      object[measure.name]["about"] = *measure.about;
    }
  }
  return object;
}

void add_time(Json& object, std::uint64_t steps,
              const std::optional<scene::UnitConversion>& units) {
  if (units) {
    object["time"] = units->time(steps);
  }
}

Json to_object(const StageSummary& stage, const std::optional<scene::UnitConversion>& units) {
  Json measures = Json::object();
  for (const auto& [name, value] : stage.measures) {
    measures[name] = to_value(value);
  }
  Json object = {{"name", stage.name}, {"steps", stage.steps}};
  add_time(object, stage.steps, units);
  object["ended"] = stage.end_reason;
  object["measures"] = std::move(measures);
  if (stage.fills_particles) {
    object["fills"] = true;
  }
  if (!stage.notes.empty()) {
    object["notes"] = stage.notes;
  }
  return object;
}

Json to_object(const ColumnSummary& column) {
  Json object = {{"key", column.key}, {"name", column.name}};
  for (const auto& [key, text] :
       {std::pair("of", column.part), {"unit", column.unit}, {"meaning", column.meaning}}) {
    if (!text.empty()) {
      object[key] = text;
    }
  }
  if (column.relative_to_floor) {
    object["of_floor"] = true;
  }
  return object;
}

// Reading is strict, since the file may be truncated or foreign.

class FormatError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

const Json& field(const Json& object, const char* key, bool (Json::*is)() const noexcept) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end() || !((*found).*is)()) {
    throw FormatError(fmt::format("'{}' is missing or not what it should be", key));
  }
  return *found;
}

std::string text(const Json& object, const char* key) {
  return field(object, key, &Json::is_string).get<std::string>();
}

std::uint64_t count(const Json& object, const char* key) {
  return field(object, key, &Json::is_number_unsigned).get<std::uint64_t>();
}

int small_count(const Json& object, const char* key) {
  const std::uint64_t number = count(object, key);
  if (number > std::numeric_limits<int>::max()) {
    throw FormatError(fmt::format("'{}' is more than there can be", key));
  }
  return static_cast<int>(number);
}

/// NaN and infinities are written as null; mandatory numbers are never null.
double number(const Json& object, const char* key) {
  return field(object, key, &Json::is_number).get<double>();
}

std::uint64_t hash(const Json& object, const char* key) {
  constexpr int kHexadecimal = 16;
  if (const auto value = text::number<std::uint64_t>(text(object, key), kHexadecimal)) {
    return *value;
  }
  throw FormatError(fmt::format("'{}' is no hash", key));
}

MeasureValue measure(const Json& value) {
  if (value.is_number()) {
    return value.get<double>();
  }
  if (value.is_boolean()) {
    return value.get<bool>();
  }
  if (value.is_null()) {
    return {};
  }
  throw FormatError("a measure is neither a number nor true, false or null");
}

/// Names that become file names.
std::string name(const Json& object, const char* key) {
  std::string found = text(object, key);
  if (!clca::text::is_file_name(found)) {
    throw FormatError(fmt::format("'{}' is '{}', which cannot name a file", key, found));
  }
  return found;
}

StageSummary stage(const Json& object) {
  StageSummary summary = {.name = name(object, "name"),
                          .steps = count(object, "steps"),
                          .end_reason = text(object, "ended"),
                          .measures = {}};
  for (const auto& [name, value] : field(object, "measures", &Json::is_object).items()) {
    summary.measures.emplace_back(name, measure(value));
  }
  summary.fills_particles = object.contains("fills");
  if (object.contains("notes")) {
    for (const Json& note : field(object, "notes", &Json::is_array)) {
      if (!note.is_string()) {
        throw FormatError("a note is no text");
      }
      summary.notes.push_back(note.get<std::string>());
    }
  }
  return summary;
}

scene::UnitConversion units(const Json& found) {
  scene::UnitConversion result = {.length_unit = text(found, "length"),
                                  .time_unit = text(found, "time"),
                                  .velocity_unit = text(found, "velocity"),
                                  .spacing = number(found, "spacing"),
                                  .time_step = number(found, "time_step")};
  if (found.contains("site_mass")) {
    result.site_mass = {.mass = number(found, "site_mass"), .weight = number(found, "site_weight")};
  }
  return result;
}

std::vector<scene::DerivedMeasure> derived(const Json& found) {
  std::vector<scene::DerivedMeasure> result;
  for (const auto& [name, entry] : found.items()) {
    scene::DerivedMeasure& derived = result.emplace_back();
    derived.name = name;
    derived.expression = text(entry, "value");
    derived.unit = text(entry, "unit");
    if (entry.contains("about")) {
      derived.about = text(entry, "about");
    }
  }
  return result;
}

/// Reads what is an object, if it is there.
template <class Read, class Value>
void take_if_there(const Json& object, const char* key, Read read, Value& value) {
  if (object.contains(key)) {
    value = read(field(object, key, &Json::is_object));
  }
}

RunSummary summary_of(const Json& object) {
  const Json& build = field(object, "build", &Json::is_object);
  RunSummary summary = {.kind = text(object, "kind"),
                        .version = text(object, "clca"),
                        .scene = text(object, "scene"),
                        // Runs of earlier versions have none.
                        .title = object.contains("title") ? text(object, "title") : "",
                        .seed = count(object, "seed"),
                        .threads = small_count(object, "threads"),
                        .ranks = object.contains("ranks") ? small_count(object, "ranks") : 1,
                        .status = text(object, "status"),
                        .particles = count(object, "particles"),
                        .steps = count(object, "steps"),
                        .wall_seconds = number(object, "wall_seconds"),
                        .step_seconds = number(object, "step_seconds"),
                        .rate_per_second = number(object, rate_key(text(object, "kind"))),
                        .state_hash = hash(object, "state_hash"),
                        .compiler = text(build, "compiler"),
                        .build_type = text(build, "type"),
                        .stages = {}};
  take_if_there(object, "units", units, summary.units);
  take_if_there(object, "derived", derived, summary.derived_measures);
  if (summary.kind != "comparison") {  // which writes no files of that name
    name(object, "scene");
  }
  for (const Json& entry : field(object, "stages", &Json::is_array)) {
    summary.stages.push_back(stage(entry));
  }
  return summary;
}

}  // namespace

Json to_json_list(const std::vector<ColumnSummary>& measures) {
  Json list = Json::array();
  for (const ColumnSummary& column : measures) {
    list.push_back(to_object(column));
  }
  return list;
}

Json to_json_object(const std::vector<TableSummary>& tables) {
  Json object = Json::object();
  for (const auto& [name, columns] : tables) {
    object[name] = to_json_list(columns);
  }
  return object;
}

std::string version() {
  return CLCA_VERSION;
}

RunSummary summary_with_provenance() {
  RunSummary summary;
  summary.version = version();
  summary.compiler = CLCA_COMPILER;
  summary.build_type = CLCA_BUILD_TYPE;
  return summary;
}

const char* rate_key(std::string_view kind) {
  return kind == "boltzmann" ? "collisions_per_second" : "particle_updates_per_second";
}

std::string to_json(const RunSummary& summary) {
  // Destructors of JSON values allocate, which must not fail: with no room for all, it fails here.
  constexpr std::size_t kRoom = 1'000'000;
  ::operator delete(::operator new(kRoom));
  Json stages = Json::array();
  for (const StageSummary& stage : summary.stages) {
    stages.push_back(to_object(stage, summary.units));
  }
  Json object = {
      {"clca", summary.version},  {"kind", summary.kind},           {"scene", summary.scene},
      {"title", summary.title},   {"seed", summary.seed},           {"threads", summary.threads},
      {"status", summary.status}, {"particles", summary.particles}, {"steps", summary.steps}};
  if (summary.ranks > 1) {
    object["ranks"] = summary.ranks;
  }
  add_time(object, summary.steps, summary.units);
  if (summary.begin) {
    object["begin"] = {{"run", summary.begin->run_folder},
                       {"step", summary.begin->step ? Json(*summary.begin->step) : Json("last")},
                       {"state_hash", fmt::format("{:016x}", summary.begin->state_hash)}};
  }
  if (summary.units) {
    object["units"] = to_object(*summary.units);
  }
  if (summary.box) {
    object["box"] = {{"left", summary.box->left},
                     {"right", summary.box->right},
                     {"floor", summary.box->floor},
                     {"top", summary.box->top},
                     {"periodic", summary.box->periodic}};
  }
  if (!summary.derived_measures.empty()) {
    object["derived"] = to_object(summary.derived_measures);
  }
  object["wall_seconds"] = summary.wall_seconds;
  object["step_seconds"] = summary.step_seconds;
  object[rate_key(summary.kind)] = summary.rate_per_second;
  object["state_hash"] = fmt::format("{:016x}", summary.state_hash);
  object["build"] = {{"compiler", summary.compiler}, {"type", summary.build_type}};
  object["stages"] = std::move(stages);
  Json& kinds = object["kinds"] = Json::array();
  for (const KindSummary& kind : summary.kinds) {
    kinds.push_back({{"species", kind.species}, {"degrees", kind.degrees}});
  }
  object["measures"] = to_json_list(summary.measure_descriptions);
  object["tables"] = to_json_object(summary.table_descriptions);
  constexpr int kIndent = 2;
  return object.dump(kIndent) + '\n';
}

RunSummary parse_summary(std::string_view json, const std::string& name) {
  static constexpr std::size_t kMaxDepth = 16;
  static constexpr int kMaxKeys = 1000;  // of an object, since looking one up takes that long
  // Stops the parser if a text would take excessive memory or time.
  const auto limits = [keys = std::array<int, kMaxDepth + 1>()](  // so far, by depth
                          int depth, Json::parse_event_t event, const Json& /*value*/) mutable {
    const auto level = static_cast<std::size_t>(depth);
    if (level >= kMaxDepth) {
      throw FormatError(fmt::format("it is nested deeper than {} levels", kMaxDepth));
    }
    if (event == Json::parse_event_t::object_start) {
      keys[level + 1] = 0;
    } else if (event == Json::parse_event_t::key && ++keys[level] > kMaxKeys) {
      throw FormatError(fmt::format("it has an object of more than {} keys", kMaxKeys));
    }
    return true;
  };
  try {
    return summary_of(Json::parse(json, limits));
  } catch (const Json::exception&) {
    throw StoreError(fmt::format("cannot read {}: it is cut off or no JSON", name));
  } catch (const FormatError& error) {
    throw StoreError(fmt::format("cannot read {}: {}", name, error.what()));
  }
}

RunSummary read_summary(const std::filesystem::path& file) {
  std::error_code unknown;
  const std::filesystem::path folder = file.parent_path();
  if (std::filesystem::is_directory(folder, unknown) && !std::filesystem::exists(file, unknown)) {
    throw StoreError(
        fmt::format("cannot read {}: No such file or directory; {} is not the folder of a run",
                    file.string(), folder.string()));
  }
  const std::filesystem::path usual = folder.parent_path() / "renders" / folder.filename();
  if (!std::filesystem::exists(folder, unknown) &&
      std::filesystem::is_regular_file(usual / file.filename(), unknown)) {
    throw StoreError(fmt::format("cannot read {}: No such file or directory; did you mean {}?",
                                 file.string(), usual.string()));
  }
  constexpr double kMaxBytes = 16 << 20;
  const auto bytes = read_whole_file(file, kMaxBytes);
  return parse_summary({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace clca::store
