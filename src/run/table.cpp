#include "run/table.hpp"

#include <algorithm>

namespace clca::run {

namespace {

std::vector<std::string> column_names(const scene::Scene& scene, const TableInfo& info,
                                      const std::vector<std::string>& more) {
  std::vector<std::string> names;
  for (const auto& [quantity, where] : info.columns) {
    if (where.holds == nullptr || where.holds(scene)) {
      names.emplace_back(quantity.key);
    }
  }
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

}  // namespace

bool is_contact(const scene::Scene& scene) {
  return scene.model == scene::Model::contact;
}

double velocity_unit(const scene::Scene& scene) {
  const auto conversion = scene::conversion(scene);
  return conversion ? conversion->velocity(1) : 1;
}

RunTable::RunTable(const scene::Scene& scene, const TableInfo& info, std::vector<std::string> more)
    : scene_(scene),
      info_(info),
      conversion_(scene::conversion(scene)),
      table_(column_names(scene, info, more)) {
  const std::vector<std::string> names = column_names(scene, info, more);
  const auto time = std::find(names.begin(), names.end(), kTime.key);
  if (time != names.end()) {
    time_ = time - names.begin();
  }
}

std::vector<std::string> RunTable::files() const {
  const std::string name(info_.name);
  if (info_.of == TableInfo::Of::run) {
    return {store::table_name(name)};
  }
  std::vector<std::string> names;
  for (const scene::Stage& stage : scene_.stages) {
    names.push_back(store::table_name(name, stage.name));
  }
  return names;
}

void RunTable::add_row(std::vector<store::Cell> cells) {
  if (time_) {
    const auto place = cells.begin() + static_cast<std::ptrdiff_t>(*time_);
    cells.insert(place, conversion_->time(std::get<std::uint64_t>(*(place - 1))));
  }
  table_.add_row(std::move(cells));
}

void RunTable::open(const store::OutputFolder& folder) {
  folder_.emplace(folder);
  if (info_.of == TableInfo::Of::run) {
    file_.emplace(folder, files().front(), bytes_);
  }
}

void RunTable::write_rows(std::size_t least) {
  if (file_ && table_.waiting() > 0 && table_.waiting() >= least) {
    const std::string header = bytes_ == 0 ? table_.header() : "";
    file_->append(header + table_.take());
    bytes_ = file_->bytes();
  }
}

void RunTable::write(const std::string& stage) {
  folder_->write(store::table_name(std::string(info_.name), stage),
                 table_.header() + table_.take());
}

}  // namespace clca::run
