#include "record/internal/table.hpp"

#include <fmt/format.h>

#include <limits>

#include "clca/contact/state.hpp"
#include "clca/store/run_folder.hpp"

namespace clca::record {

bool is_contact_model(const scene::Scene& scene) {
  return scene.model == scene::Model::contact;
}

double velocity_factor(const scene::Scene& scene) {
  const auto conversion = scene::unit_conversion(scene);
  return conversion ? conversion->velocity(1) : 1;
}

void add_cell(std::vector<store::Cell>& cells, const std::optional<double>& value) {
  cells.emplace_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
}

void add_cell(std::vector<store::Cell>& cells, const std::string& text) {
  cells.emplace_back(text);
}

void add_cell(std::vector<store::Cell>& cells, const statistics::SampleStatistics& mean) {
  cells.emplace_back(mean.mean);
  cells.emplace_back(mean.standard_error);
}

void add_cell(std::vector<store::Cell>& cells, const std::optional<Eigen::Vector2d>& vector) {
  for (const Eigen::Index axis : {0, 1}) {
    add_cell(cells, vector ? std::optional((*vector)[axis]) : std::nullopt);
  }
}

std::vector<std::string> ColumnInfo::column_names() const {
  std::vector<std::string> names;
  for (const std::string_view ending : suffixes) {
    names.push_back(std::string(quantity.key).append(ending));
  }
  return names;
}

namespace {

// No wall has a dot in its name, so none is called as a side of the box.
constexpr std::array kSides = {
    std::pair(contact::kFloor, "box.floor"), std::pair(contact::kCeiling, "box.top"),
    std::pair(contact::kLeftSide, "box.left"), std::pair(contact::kRightSide, "box.right")};

}  // namespace

std::string body_name(const scene::Scene& scene, grains::Owner owner) {
  if (contact::is_side(owner)) {
    return std::ranges::find(kSides, owner, [](const auto& side) { return side.first; })->second;
  }
  return grains::is_particle(owner) ? fmt::format("{}", owner)
                                    : scene.walls[grains::wall_number(owner)].name;
}

std::vector<grains::Owner> walls_and_sides(const scene::Scene& scene) {
  std::vector<grains::Owner> all;
  for (std::size_t wall = 0; wall < scene.walls.size(); ++wall) {
    all.push_back(grains::wall_code(wall));
  }
  for (const auto& [side, name] : kSides) {
    all.push_back(side);
  }
  return all;
}

void RunTable::check_saved_bytes(const store::OutputFolder& folder) const {
  if (info_.kind == TableInfo::Kind::growing) {
    store::GrowingFile::check_kept_bytes(folder, store::table_name(info_.name), bytes_);
  }
}

void RunTable::open(const store::OutputFolder& folder) {
  if (info_.kind == TableInfo::Kind::growing) {
    file_.emplace(folder, store::table_name(info_.name), bytes_);
  }
}

void RunTable::write_rows(std::size_t least) {
  if (!file_) {
    table_.take_csv_rows();
  } else if (table_.pending_bytes() > 0 && table_.pending_bytes() >= least) {
    const std::string header = bytes_ == 0 ? table_.csv_header() : "";
    file_->append(header + table_.take_csv_rows());
    bytes_ = file_->size_in_bytes();
  }
}

void RunTable::write(const store::OutputFolder* folder, const std::string& part) {
  const std::string rows = table_.take_csv_rows();
  if (folder != nullptr) {
    folder->write(store::table_name(info_.name, part), table_.csv_header() + rows);
  }
}

}  // namespace clca::record
