#include "store/trajectory_files.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "store/hdf5.hpp"

namespace clca::store {

namespace {

std::optional<std::uint64_t> part_number(const std::string& name) {
  constexpr std::string_view kStart = "part-";
  if (!name.starts_with(kStart)) {
    return std::nullopt;
  }
  std::uint64_t number = 0;
  std::from_chars(name.data() + kStart.size(), name.data() + name.size(), number);
  return name == part_name(number) ? std::optional(number) : std::nullopt;
}

/// In a folder; none if it does not exist.
std::set<std::uint64_t> part_numbers(const std::filesystem::path& folder) {
  std::set<std::uint64_t> numbers;
  std::error_code error;
  std::filesystem::directory_iterator it(folder, error);
  for (; !error && it != std::filesystem::directory_iterator(); it.increment(error)) {
    if (const auto number = part_number(it->path().filename())) {
      numbers.insert(*number);
    }
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    throw StoreError(
        fmt::format("cannot read the folder {}: {}", folder.string(), error.message()));
  }
  return numbers;
}

}  // namespace

std::string part_name(std::uint64_t number) {
  return fmt::format("part-{:06}.h5", number);
}

std::vector<std::filesystem::path> find_parts(const std::filesystem::path& run_folder) {
  const std::filesystem::path folder = run_folder / kTrajectoryFolder;
  std::vector<std::filesystem::path> parts;
  for (const std::uint64_t number : part_numbers(folder)) {
    const std::filesystem::path next = folder / part_name(parts.size());
    if (number != parts.size()) {
      throw StoreError(
          fmt::format("cannot read {}: missing, though later parts are there", next.string()));
    }
    parts.push_back(next);
  }
  if (parts.empty()) {
    throw StoreError(fmt::format("cannot read {}: no trajectory there (see output.trajectory)",
                                 folder.string()));
  }
  return parts;
}

void check_parts(const std::filesystem::path& run_folder) {
  for (const std::filesystem::path& part : find_parts(run_folder)) {
    read_hdf5(part, kTrajectoryKind, {}, kAnyBytes);
  }
}

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

using hdf5::check;
using hdf5::Handle;

namespace {

using Dimensions = std::vector<hsize_t>;

/// Relative names, so that a run folder may be moved.
std::string source_file(std::size_t part) {
  return fmt::format("{}/{}", kTrajectoryFolder, part_name(part));
}

Dimensions shape_of(const Column& column, std::uint64_t rows) {
  Dimensions shape = {rows};
  shape.insert(shape.end(), column.row.begin(), column.row.end());
  return shape;
}

/// As Hdf5Writer lays it out.
Dimensions shape_in_part(const Column& column, std::uint64_t rows) {
  return column.width() == 1 ? Dimensions{rows} : Dimensions{rows, column.width()};
}

/// Maps the rows of all parts, in order, into one dataset.
void map_parts(const Handle& creation, const Handle& whole, const Column& column,
               const std::vector<Extents>& parts) {
  Dimensions start(1 + column.row.size(), 0);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const std::uint64_t rows = parts[part][column.axis];
    if (rows == 0) {
      continue;
    }
    const Dimensions block = shape_of(column, rows);
    const Dimensions once(block.size(), 1);
    check(H5Sselect_hyperslab(whole.id(), H5S_SELECT_SET, start.data(), nullptr, once.data(),
                              block.data()),
          "rows of a part");
    const Handle source = hdf5::space_of(shape_in_part(column, rows));
    check(H5Pset_virtual(creation.id(), whole.id(), source_file(part).c_str(), column.path,
                         source.id()),
          "virtual dataset");
    start.front() += rows;
  }
}

/// Fill value for unreadable parts: HDF5 does not report them, so it must not look like data.
template <Number T>
constexpr T no_value() {
  using Numbers = std::numeric_limits<T>;
  return Numbers::has_quiet_NaN ? Numbers::quiet_NaN()
                                : (Numbers::is_signed ? Numbers::min() : Numbers::max());
}

template <Number T>
void add_dataset(const Handle& file, const Column& column, const std::vector<Extents>& parts) {
  std::uint64_t rows = 0;
  for (const Extents& part : parts) {
    rows += part[column.axis];
  }
  const Handle whole = hdf5::space_of(shape_of(column, rows));
  const Handle creation = hdf5::properties(H5P_DATASET_CREATE);
  const T fill = no_value<T>();
  check(H5Pset_fill_value(creation.id(), hdf5::number_type<T>(), &fill), "fill value");
  map_parts(creation, whole, column, parts);
  hdf5::make_dataset(file, column.path, hdf5::number_type<T>(), whole, creation, column.meaning);
}

}  // namespace

void write_index(const OutputFolder& run_folder, const std::vector<Extents>& parts,
                 const Layout& layout) {
  const auto add_all = [&](const Handle& file) {
    const TrajectoryPart none;
    for_each_column(none, layout, [&]<class T>(const Column& column, const std::vector<T>&) {
      add_dataset<T>(file, column, parts);
    });
    check(H5Lcreate_external(source_file(0).c_str(), "/scene", file.id(), "scene", H5P_DEFAULT,
                             H5P_DEFAULT),
          "link");
  };
  run_folder.write(kTrajectoryIndex, hdf5::image(run_folder.path(kTrajectoryIndex), add_all));
}

}  // namespace clca::store
