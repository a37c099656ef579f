#include <algorithm>

#include "record/internal/observer.hpp"

namespace clca::record {

// Where many sources are one, the functions may come before.
// NOLINTBEGIN(readability-redundant-declaration)
ObserverKind cycles_observer();
ObserverKind fields_observer();
ObserverKind lines_observer();
ObserverKind mixing_observer();
ObserverKind overlaps_observer();
ObserverKind contacts_observer();
ObserverKind energy_observer();
ObserverKind series_observer();
ObserverKind probes_observer();
ObserverKind trajectory_observer();
ObserverKind profile_observer();
ObserverKind force_tables_observer();
ObserverKind weight_paths_observer();
// NOLINTEND(readability-redundant-declaration)

const std::vector<ObserverKind>& observer_kinds() {
  static const std::vector<ObserverKind> kAll = {
      cycles_observer(),      fields_observer(),     lines_observer(),   mixing_observer(),
      overlaps_observer(),    contacts_observer(),   energy_observer(),  series_observer(),
      probes_observer(),      trajectory_observer(), profile_observer(), force_tables_observer(),
      weight_paths_observer()};
  return kAll;
}

std::vector<std::unique_ptr<Observer>> observers_of(const scene::Scene& scene) {
  std::vector<std::unique_ptr<Observer>> all;
  for (const ObserverKind& kind : observer_kinds()) {
    if (auto observer = kind.make(scene)) {
      all.push_back(std::move(observer));
    }
  }
  return all;
}

double observer_bytes(const scene::Scene& scene, double particles) {
  double bytes = 0;
  for (const ObserverKind& kind : observer_kinds()) {
    bytes += kind.bytes ? kind.bytes(scene, particles) : 0;
  }
  return bytes;
}

bool requests(const scene::Scene& scene, scene::Measure measure) {
  return std::ranges::find(scene.measures, measure) != scene.measures.end();
}

Observers::Observers(std::vector<std::unique_ptr<Observer>> all) : all_(std::move(all)) {
  for (const auto& observer : all_) {
    const std::vector<RunTable*> tables = observer->tables();
    tables_.insert(tables_.end(), tables.begin(), tables.end());
  }
}

std::vector<store::TableSummary> Observers::summary() const {
  std::vector<store::TableSummary> all;
  for (const RunTable* table : tables_) {
    all.emplace_back(table->info().name, table->summary());
  }
  return all;
}

void Observers::open(const store::RunFolder& folder, const grains::State& now) {
  // All are checked before one is changed.
  for (const RunTable* table : tables_) {
    table->check(folder.output_folder());
  }
  call(&Observer::open, folder, now);
  for (RunTable* table : tables_) {
    table->open(folder.output_folder());
  }
}

void Observers::write_rows(std::size_t least) {
  for (RunTable* table : tables_) {
    table->write_rows(least);
  }
}

void Observers::after_step(const StageView& now) {
  constexpr std::size_t kBlock = 1U << 16U;  // bytes of rows that are written at once
  call(&Observer::after_step, now);
  write_rows(kBlock);
}

void Observers::end_stage(const StageView& now) {
  call(&Observer::end_stage, now);
  write_rows(0);
}

namespace {

std::string bytes_path(const RunTable& table) {
  return "outputs/" + std::string(table.info().name) + "_bytes";
}

}  // namespace

void Observers::save(reflection::Columns& columns) {
  write_rows(0);
  for (RunTable* table : tables_) {
    if (table->info().kind == TableInfo::Kind::growing) {
      reflection::encode(bytes_path(*table), table->bytes(), columns);
    }
  }
  call(&Observer::save, columns);
}

void Observers::load(const SavedColumns& saved, const StageView& now) {
  for (RunTable* table : tables_) {
    if (table->info().kind == TableInfo::Kind::growing) {
      saved.read(bytes_path(*table), table->bytes(), now.model.state());
    }
  }
  call(&Observer::load, saved, now);
}

}  // namespace clca::record
