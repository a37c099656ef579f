// Collects frames into parts and writes the index.

#include <fmt/format.h>

#include <limits>
#include <set>
#include <stdexcept>

#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "store/hdf5.hpp"
#include "store/trajectory_part.hpp"

namespace clca::store {

using hdf5::check;
using hdf5::Handle;

namespace {

/// Size of a part before compression: large enough for few parts, small enough for memory and for
/// readers to see new frames soon.
constexpr std::size_t kPartBytes = std::size_t{16} << 20U;
constexpr const char* kTrajectoryIndex = "trajectory.h5";

using Dimensions = std::vector<hsize_t>;

/// Relative names, so that a run folder may be moved.
std::string source_file(std::size_t part) {
  return fmt::format("{}/{}", kTrajectoryFolder, part_name(part));
}

Dimensions shape_of(const TrajectoryDataset& column, std::uint64_t rows) {
  Dimensions shape = {rows};
  shape.insert(shape.end(), column.row_shape.begin(), column.row_shape.end());
  return shape;
}

/// Maps the rows of all parts, in order, into one dataset.
void add_dataset(const Handle& file, const TrajectoryDataset& column,
                 const std::vector<RowCounts>& parts) {
  std::uint64_t rows = 0;
  for (const RowCounts& part : parts) {
    rows += part[column.row_kind];
  }
  const Handle whole = hdf5::dataspace(shape_of(column, rows));
  const Handle creation = hdf5::make_properties(H5P_DATASET_CREATE);
  const hid_t type = hdf5::number_type(column.values);
  std::visit(
      [&]<class T>(const T* /*values*/) {
        using Item = typename T::value_type;
        if constexpr (Number<Item>) {
          using Numbers = std::numeric_limits<Item>;
          // Of unreadable parts, which HDF5 does not report: it must not look like data.
          const Item none = Numbers::has_quiet_NaN ? Numbers::quiet_NaN()
                            : Numbers::is_signed   ? Numbers::min()
                                                   : Numbers::max();
          check(H5Pset_fill_value(creation.id(), type, &none), "fill value");
        }
      },
      column.values);
  Dimensions start(1 + column.row_shape.size(), 0);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const std::uint64_t of_part = parts[part][column.row_kind];
    if (of_part == 0) {
      continue;
    }
    const Dimensions block = shape_of(column, of_part);
    const Dimensions once(block.size(), 1);
    check(H5Sselect_hyperslab(whole.id(), H5S_SELECT_SET, start.data(), nullptr, once.data(),
                              block.data()),
          "rows of a part");
    const Handle source = hdf5::dataspace(of_part, column.numbers_per_row);
    check(H5Pset_virtual(creation.id(), whole.id(), source_file(part).c_str(), column.path.c_str(),
                         source.id()),
          "virtual dataset");
    start.front() += of_part;
  }
  hdf5::make_dataset(file, column, type, whole, creation);
}

/// Writes `trajectory.h5`: virtual datasets over parts with so many rows, and a link to group
/// `scene` of the first part. At least one part. Throws StoreError.
void write_index(const OutputFolder& run_folder, const std::vector<RowCounts>& parts,
                 const std::vector<TrajectoryDataset>& columns) {
  const auto add_all = [&](const Handle& file) {
    for (const TrajectoryDataset& column : columns) {
      add_dataset(file, column, parts);
    }
    check(H5Lcreate_external(source_file(0).c_str(), "/scene", file.id(), "scene", H5P_DEFAULT,
                             H5P_DEFAULT),
          "link");
  };
  run_folder.write(kTrajectoryIndex, hdf5::file_bytes(run_folder.path(kTrajectoryIndex), add_all));
}

/// Removes the parts written by clca from number `kept` on, last first; also the index if no part
/// is kept. Throws StoreError.
void remove_parts(const OutputFolder& run_folder, std::uint64_t kept) {
  if (kept == 0) {
    run_folder.remove(kTrajectoryIndex);
  }
  const OutputFolder folder = run_folder.subfolder(kTrajectoryFolder);
  const std::set<std::uint64_t> numbers = part_numbers(folder.path());
  for (auto number = numbers.rbegin(); number != numbers.rend() && *number >= kept; ++number) {
    folder.remove(part_name(*number));
  }
}

}  // namespace

class TrajectoryWriter::Impl {
 public:
  Impl(OutputFolder run_folder, SceneTables tables, const OptionalDatasets& layout,
       const Written& kept)
      : run_folder_(std::move(run_folder)),
        tables_(std::move(tables)),
        layout_(layout),
        columns_(unwritten_part_.datasets(layout)) {
    run_folder_.make_folder(kTrajectoryFolder);
    if (kept.parts > 0) {
      take_up(kept);
      write_index(run_folder_, parts_, columns_);
    }
    remove_parts(run_folder_, kept.parts);
  }

  void add(const grains::State& state, std::size_t stage, bool stage_begins,
           const ContactFrame& contact) {
    const std::size_t velocities = layout_.has_velocities ? state.particles.size() : 0;
    if (state.walls.size() != layout_.wall_count || contact.velocities.size() != velocities ||
        contact.spins.size() != velocities) {
      throw std::invalid_argument("a trajectory of another scene");
    }
    unwritten_part_.add_frame(state, stage, stage_begins ? 0 : entered_, written_, contact);
    entered_ = state.particles.size();
    std::size_t bytes = 0;
    for (const TrajectoryDataset& column : columns_) {
      bytes += std::visit([](const auto* list) { return list->size() * sizeof(list->front()); },
                          column.values);
    }
    if (bytes >= kPartBytes) {
      flush();
    }
  }

  void flush() {
    if (unwritten_part_.frames.step.empty()) {
      return;
    }
    const OutputFolder folder = run_folder_.subfolder(kTrajectoryFolder);
    const std::string name = part_name(parts_.size());
    const auto add_all = [this](const Handle& file) {
      for (const Hdf5Dataset& dataset : tables_.datasets()) {
        hdf5::add_dataset(file, dataset);
      }
      for (const TrajectoryDataset& column : columns_) {
        hdf5::add_dataset(file, column);
      }
    };
    folder.write(name, with_header(kTrajectoryKind, hdf5::file_bytes(folder.path(name), add_all)));
    count(unwritten_part_.frames.total_rows());
    unwritten_part_ = {};
    write_index(run_folder_, parts_, columns_);
  }

  Written written() const { return {.parts = parts_.size(), .frames = written_[RowKind::frames]}; }

 private:
  void count(const RowCounts& part) {
    parts_.push_back(part);
    written_ += part;
  }

  /// Counts the rows of the kept parts.
  void take_up(const Written& kept) {
    const std::vector<std::filesystem::path> parts = find_parts(run_folder_.path());
    if (parts.size() < kept.parts) {
      refuse_part(run_folder_.path() / kTrajectoryFolder / part_name(parts.size()),
                  "missing, though the run had written it");
    }
    for (std::size_t part = 0; part < kept.parts; ++part) {
      const PartFrames frames = read_index(parts[part], tables_, layout_, kNoByteLimit).frames;
      count(frames.total_rows());
      entered_ = frames.entered_particles.back();
    }
    if (const std::uint64_t frames = written_[RowKind::frames]; frames != kept.frames) {
      throw StoreError(fmt::format("cannot go on with {}: {} frames where the run had written {}",
                                   (run_folder_.path() / kTrajectoryFolder).string(), frames,
                                   kept.frames));
    }
  }

  OutputFolder run_folder_;
  SceneTables tables_;
  OptionalDatasets layout_;
  std::vector<RowCounts> parts_;
  RowCounts written_;
  std::size_t entered_ = 0;  // particles that had entered in the last frame
  TrajectoryPart unwritten_part_;
  std::vector<TrajectoryDataset> columns_;  // of it
};

TrajectoryWriter::TrajectoryWriter(const OutputFolder& run_folder, const scene::Scene& scene,
                                   const grains::State& state, const Written& kept)
    : impl_(std::make_shared<Impl>(run_folder, SceneTables(scene, state), optional_datasets(scene),
                                   kept)) {}

double TrajectoryWriter::bytes_for(const scene::Scene& scene, double particles) {
  constexpr double kCopies = 3;  // as it is gathered, in HDF5, as a file
  double frame = 0;
  TrajectoryPart part;
  for (const TrajectoryDataset& column : part.datasets(optional_datasets(scene))) {
    const double rows = column.row_kind == RowKind::frames ? 1
                        : column.row_kind == RowKind::contacts
                            ? contact::kContactsPerGrain * particles
                            : particles;
    const std::size_t number_bytes =
        std::visit([](const auto* list) { return sizeof(list->front()); }, column.values);
    frame += rows * static_cast<double>(column.numbers_per_row * number_bytes);
  }
  return kCopies * (kPartBytes + frame);  // a part is written once it is large enough
}

void TrajectoryWriter::add_frame(const grains::State& state, std::size_t stage, bool stage_begins,
                                 const ContactFrame& contact) {
  impl_->add(state, stage, stage_begins, contact);
}
void TrajectoryWriter::flush() {
  impl_->flush();
}
TrajectoryWriter::Written TrajectoryWriter::written() const {
  return impl_->written();
}

}  // namespace clca::store
