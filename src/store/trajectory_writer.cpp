// Collects frames into parts and writes the index.

#include <fmt/format.h>

#include <stdexcept>

#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "store/trajectory_files.hpp"
#include "store/trajectory_part.hpp"

namespace clca::store {

namespace {

/// Size of a part before compression: large enough for few parts, small enough for memory and for
/// readers to see new frames soon.
constexpr std::size_t kPartBytes = std::size_t{16} << 20U;

}  // namespace

class TrajectoryWriter::Impl {
 public:
  Impl(OutputFolder run_folder, SceneTables tables, const Layout& layout, const Written& kept)
      : run_folder_(std::move(run_folder)), tables_(std::move(tables)), layout_(layout) {
    run_folder_.make_folder(kTrajectoryFolder);
    if (kept.parts > 0) {
      take_up(kept);
      write_index(run_folder_, parts_, layout_);
    }
    remove_parts(run_folder_, kept.parts);
  }

  void add(const grains::State& state, std::size_t stage, bool stage_begins,
           const ContactFrame& contact) {
    const std::size_t velocities = layout_.velocities ? state.particles.size() : 0;
    if (state.walls.size() != layout_.walls || contact.velocities.size() != velocities ||
        contact.spins.size() != velocities) {
      throw std::invalid_argument("a trajectory of another scene");
    }
    unwritten_part_.add(state, stage, stage_begins ? 0 : entered_, written_, contact);
    entered_ = state.particles.size();
    if (unwritten_part_.bytes() >= kPartBytes) {
      flush();
    }
  }

  void flush() {
    if (unwritten_part_.frames.step.empty()) {
      return;
    }
    const OutputFolder folder = run_folder_.subfolder(kTrajectoryFolder);
    const std::string name = part_name(parts_.size());
    const auto add_all = [this](const Hdf5Writer& file) {
      tables_.write(file);
      for_each_column(unwritten_part_, layout_, [&file](const Column& column, const auto& values) {
        file.add(column.path, values, column.width(), column.meaning);
      });
    };
    folder.write(name, hdf5_file(folder.path(name), kTrajectoryKind, add_all));
    count(unwritten_part_.frames.extents());
    unwritten_part_ = {};
    write_index(run_folder_, parts_, layout_);
  }

  Written written() const { return {.parts = parts_.size(), .frames = written_[Axis::frames]}; }

 private:
  void count(const Extents& part) {
    parts_.push_back(part);
    written_ += part;
  }

  /// Reads the extents of the kept parts.
  void take_up(const Written& kept) {
    const std::vector<std::filesystem::path> parts = find_parts(run_folder_.path());
    if (parts.size() < kept.parts) {
      throw StoreError(
          fmt::format("cannot read {}: missing, though the run had written it",
                      (run_folder_.path() / kTrajectoryFolder / part_name(parts.size())).string()));
    }
    for (std::size_t part = 0; part < kept.parts; ++part) {
      SceneTables read;
      TrajectoryPart content;
      std::vector<Hdf5Dataset> datasets = read.datasets();
      add_datasets(content, layout_, Use::index, datasets);
      read_hdf5(parts[part], kTrajectoryKind, datasets, kAnyBytes);
      tables_.require_same(read, parts[part]);
      count(content.frames.extents());
      if (content.frames.entered.empty()) {
        throw StoreError(fmt::format("cannot read {}: no frames", parts[part].string()));
      }
      entered_ = content.frames.entered.back();
    }
    if (const std::uint64_t frames = written_[Axis::frames]; frames != kept.frames) {
      throw StoreError(fmt::format("cannot go on with {}: {} frames where the run had written {}",
                                   (run_folder_.path() / kTrajectoryFolder).string(), frames,
                                   kept.frames));
    }
  }

  OutputFolder run_folder_;
  SceneTables tables_;
  Layout layout_;
  std::vector<Extents> parts_;
  Extents written_;
  std::size_t entered_ = 0;        // particles that had entered in the last frame
  TrajectoryPart unwritten_part_;  // not yet written
};

TrajectoryWriter::TrajectoryWriter(const OutputFolder& run_folder, const scene::Scene& scene,
                                   const grains::State& state, const Written& kept)
    : impl_(std::make_unique<Impl>(run_folder, SceneTables(scene, state), layout_of(scene), kept)) {
}
TrajectoryWriter::~TrajectoryWriter() = default;

double TrajectoryWriter::bytes_for(const scene::Scene& scene, double particles) {
  constexpr double kCopies = 3;  // as it is gathered, in HDF5, as a file
  double frame = 0;
  TrajectoryPart part;
  for_each_column(
      part, layout_of(scene), [&]<class T>(const Column& column, const std::vector<T>& /*values*/) {
        const double rows = column.axis == Axis::frames     ? 1
                            : column.axis == Axis::contacts ? contact::kContactsPerGrain * particles
                                                            : particles;
        frame += rows * static_cast<double>(column.width() * sizeof(T));
      });
  return kCopies * (kPartBytes + frame);  // a part is written once it is large enough
}

void TrajectoryWriter::add(const grains::State& state, std::size_t stage, bool stage_begins,
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
