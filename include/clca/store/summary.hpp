#pragma once
// run.json: parameters and results of a run, and which program made it.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "clca/scene/output.hpp"
#include "clca/scene/units.hpp"

namespace clca::store {

/// A number, a truth value, or none (written as null).
using MeasureValue = std::variant<std::monostate, double, bool>;

inline MeasureValue value_or_null(const std::optional<double>& value) {
  return value ? MeasureValue(*value) : MeasureValue();
}
using NamedMeasure = std::pair<std::string, MeasureValue>;

struct StageSummary {
  std::string name;
  std::uint64_t steps = 0;
  std::string end_reason;  ///< settled, stalled, steps, discharged, cycles, bound or interrupted
  std::vector<NamedMeasure> measures;
  std::vector<std::string> notes = {};  ///< why a measure has no value or says little
  bool fills_particles = false;         ///< particles are filled in
};

/// The state of another run that a run began with.
struct BeginSummary {
  std::string run_folder;             ///< its folder
  std::optional<std::uint64_t> step;  ///< of its trajectory; none: its end
  std::uint64_t state_hash = 0;
};

/// The sides of the box, in lattice spacings.
struct BoxSummary {
  double left = 0;
  double right = 0;
  double floor = 0;
  double top = 0;
  bool periodic = false;
};

/// Describes a measure of run.json or a column of a table.
struct ColumnSummary {
  std::string key;                 ///< in run.json, or the name of the column
  std::string name;                ///< in words; the key where it is unknown
  std::string part = {};           ///< outlet, wall, or x, y of a vector; empty: the whole
  std::string unit = {};           ///< as the run has it; of a pure number empty
  std::string meaning = {};        ///< may be empty
  bool relative_to_floor = false;  ///< along or above the floor of the vessel
};
/// The columns of NAME.csv, or of NAME-STAGE.csv.
using TableSummary = std::pair<std::string, std::vector<ColumnSummary>>;

/// A species in one of its orientations.
struct KindSummary {
  std::string species;
  int degrees = 0;  ///< clockwise
};

struct RunSummary {
  std::string kind = "automaton";  ///< the model, or boltzmann
  std::string version;
  std::string scene;  ///< its name
  std::string title;  ///< of the scene
  std::uint64_t seed = 0;
  int threads = 1;     ///< of each rank
  int ranks = 1;       ///< that shared the gases
  std::string status;  ///< running, done, interrupted or failed
  std::uint64_t particles = 0;
  std::uint64_t steps = 0;
  std::optional<scene::UnitConversion> units = {};  ///< of the contact model
  std::vector<scene::DerivedMeasure> derived_measures = {};
  double wall_seconds = 0;     ///< of the run, by the clock
  double step_seconds = 0;     ///< of wall_seconds, in steps of the model
  double rate_per_second = 0;  ///< see rate_key
  std::uint64_t state_hash = 0;
  std::string compiler;
  std::string build_type;
  std::vector<StageSummary> stages;
  // For those who read the folder; read_summary() leaves them out.
  std::optional<BeginSummary> begin = {};
  std::optional<BoxSummary> box = {};  ///< of a run of grains
  std::vector<KindSummary> kinds = {};
  std::vector<ColumnSummary> measure_descriptions = {};
  std::vector<TableSummary> table_descriptions = {};
};

/// Version of this program, as in CMakeLists.txt.
std::string version();
/// A summary with version, compiler and build type filled in.
RunSummary summary_with_provenance();

/// Key of the rate in run.json: collisions (pairs) per second for the Boltzmann equation, particle
/// updates per second otherwise.
const char* rate_key(std::string_view kind);

std::string to_json(const RunSummary& summary);
/// The parts of run.json and of sweep.json that describe measures and columns.
nlohmann::ordered_json to_json_list(const std::vector<ColumnSummary>& measures);
nlohmann::ordered_json to_json_object(const std::vector<TableSummary>& tables);

/// Parses a run.json; `name` is used in messages. Throws StoreError if it is not complete and
/// valid.
RunSummary parse_summary(std::string_view json, const std::string& name);
/// Reads a run.json. Throws StoreError if it cannot be read or is not complete and valid.
RunSummary read_summary(const std::filesystem::path& file);

}  // namespace clca::store
