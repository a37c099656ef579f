#include <algorithm>

#include "record/internal/observer.hpp"

namespace clca::record {

// Where many sources are one, the functions may come before.
// NOLINTBEGIN(readability-redundant-declaration)
ObserverFactory cycles_observer();
ObserverFactory fields_observer();
ObserverFactory lines_observer();
ObserverFactory mixing_observer();
ObserverFactory overlaps_observer();
ObserverFactory contacts_observer();
ObserverFactory energy_observer();
ObserverFactory series_observer();
ObserverFactory probes_observer();
ObserverFactory trajectory_observer();
ObserverFactory profile_observer();
ObserverFactory force_tables_observer();
ObserverFactory weight_paths_observer();
// NOLINTEND(readability-redundant-declaration)

const std::vector<ObserverFactory>& observer_factories() {
  static const std::vector<ObserverFactory> kAll = {
      cycles_observer(),      fields_observer(),     lines_observer(),   mixing_observer(),
      overlaps_observer(),    contacts_observer(),   energy_observer(),  series_observer(),
      probes_observer(),      trajectory_observer(), profile_observer(), force_tables_observer(),
      weight_paths_observer()};
  return kAll;
}

std::vector<std::unique_ptr<Observer>> make_observers(const scene::Scene& scene) {
  std::vector<std::unique_ptr<Observer>> all;
  for (const ObserverFactory& kind : observer_factories()) {
    if (auto observer = kind.make(scene)) {
      all.push_back(std::move(observer));
    }
  }
  return all;
}

double observer_bytes(const scene::Scene& scene, double particles) {
  double bytes = 0;
  for (const ObserverFactory& kind : observer_factories()) {
    bytes += kind.bytes ? kind.bytes(scene, particles) : 0;
  }
  return bytes;
}

bool requests_measure(const scene::Scene& scene, scene::Measure measure) {
  return std::ranges::find(scene.measures, measure) != scene.measures.end();
}

Observers::Observers(std::vector<std::unique_ptr<Observer>> all) : all_(std::move(all)) {
  for (const auto& observer : all_) {
    const std::vector<RunTable*> tables = observer->tables();
    tables_.insert(tables_.end(), tables.begin(), tables.end());
  }
}

std::vector<store::TableSummary> Observers::table_summaries() const {
  std::vector<store::TableSummary> all;
  for (const RunTable* table : tables_) {
    all.emplace_back(table->info().name, table->column_descriptions());
  }
  return all;
}

void Observers::open(const store::RunFolder& folder, const grains::State& now) {
  // All are checked before one is changed.
  for (const RunTable* table : tables_) {
    table->check_saved_bytes(folder.output_folder());
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
      reflection::encode(bytes_path(*table), table->saved_bytes(), columns);
    }
  }
  call(&Observer::save, columns);
}

void Observers::load(const SavedColumns& saved, const StageView& now) {
  for (RunTable* table : tables_) {
    if (table->info().kind == TableInfo::Kind::growing) {
      saved.read(bytes_path(*table), table->saved_bytes(), now.model.state());
    }
  }
  call(&Observer::load, saved, now);
}

}  // namespace clca::record
