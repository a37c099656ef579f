#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "clca/store/file.hpp"
#include "store/hdf5.hpp"
#include "store/number_types.hpp"
#include "store/seal.hpp"
#include "store/sealed_file.hpp"

namespace clca::store {

using hdf5::check;
using hdf5::Handle;

namespace {

/// HDF5 copies what it is given, and again when it opens it: never more than two are there at once.
Handle open_image(std::vector<std::uint8_t> file) {
  constexpr std::size_t kGrowth = 1U << 20U;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  check(H5Pset_fapl_core(access.id(), kGrowth, false), "memory driver");
  check(H5Pset_file_image(access.id(), file.data() + kSealBytes, file.size() - kSealBytes),
        "image");
  file.clear();
  file.shrink_to_fit();
  return {H5Fopen(hdf5::name_in_memory().c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose,
          "it is no HDF5 file"};
}

/// Rows and columns; plain lists have one column.
std::array<hsize_t, 2> extent_of(const Handle& space) {
  std::array<hsize_t, 2> extent = {1, 1};
  const int dimensions = H5Sget_simple_extent_ndims(space.id());
  if (dimensions < 0 || dimensions > 2 ||
      H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr) < 0) {
    throw hdf5::Error("has an extent out of the ordinary");
  }
  return extent;
}

}  // namespace

class SealedReader::File {
 public:
  File(const FileKind& kind, const std::filesystem::path& path, double most_bytes) {
    std::vector<std::uint8_t> bytes = read_whole(path, most_bytes / 2);
    version_ = check_seal(kind, bytes);
    bytes_left_ = most_bytes - 2 * static_cast<double>(bytes.size());
    hdf5_.emplace(open_image(std::move(bytes)));
  }

  std::uint32_t version() const { return version_; }

  Handle dataset(const std::string& path) const {
    return {H5Dopen2(hdf5_->id(), path.c_str(), H5P_DEFAULT), H5Dclose, "is missing"};
  }
  bool has(const std::string& path) const {
    for (std::size_t end = path.find('/'); end != std::string::npos;
         end = path.find('/', end + 1)) {
      if (H5Lexists(hdf5_->id(), path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) {
        return false;
      }
    }
    return H5Lexists(hdf5_->id(), path.c_str(), H5P_DEFAULT) > 0;
  }
  /// All that is read counts: whoever reads keeps it.
  void take(double bytes) {
    if (bytes > bytes_left_) {
      throw hdf5::Error("needs more memory than the limit");
    }
    bytes_left_ -= bytes;
  }

 private:
  double bytes_left_ = 0;  // that may be taken
  std::uint32_t version_ = 0;
  std::optional<Handle> hdf5_;
};

SealedReader::SealedReader(std::filesystem::path path, const FileKind& kind, double most_bytes)
    : path_(std::move(path)) {
  const hdf5::Session session;
  try {
    file_ = std::make_unique<File>(kind, path_, most_bytes);
  } catch (const StoreError&) {
    throw;
  } catch (const std::runtime_error& error) {
    refuse(error.what());
  }
}

SealedReader::~SealedReader() {
  const hdf5::Session session;
  file_.reset();
}

std::uint32_t SealedReader::version() const {
  return file_->version();
}

bool SealedReader::has(const std::string& path) const {
  const hdf5::Session session;
  return file_->has(path);
}

template <Number T>
bool SealedReader::holds(const std::string& path) const {
  const hdf5::Session session;
  if (!file_->has(path)) {
    return false;
  }
  const Handle dataset = file_->dataset(path);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose, "type");
  return H5Tequal(type.id(), number_type<T>()) > 0;
}

template <Number T>
std::vector<T> SealedReader::read(const std::string& path, std::size_t columns) const {
  const hdf5::Session session;
  try {
    const Handle dataset = file_->dataset(path);
    const Handle type(H5Dget_type(dataset.id()), H5Tclose, "type");
    if (H5Tequal(type.id(), number_type<T>()) <= 0) {
      throw hdf5::Error("holds other numbers");
    }
    const auto extent = extent_of(Handle(H5Dget_space(dataset.id()), H5Sclose, "extent"));
    if (extent[1] != columns) {
      throw hdf5::Error(fmt::format("has {} columns", extent[1]));
    }
    const double numbers = static_cast<double>(extent[0]) * static_cast<double>(columns);
    file_->take(numbers * sizeof(T));
    std::vector<T> values(extent[0] * columns);
    check(H5Dread(dataset.id(), number_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "cannot be read");
    return values;
  } catch (const hdf5::Error& error) {
    refuse(fmt::format("{} {}", path, error.what()));
  }
}

std::string SealedReader::read_text(const std::string& path) const {
  const std::vector<std::string> texts = read_texts(path);
  if (texts.size() != 1) {
    refuse(fmt::format("{} is no single text", path));
  }
  return texts.front();
}

std::vector<std::string> SealedReader::read_texts(const std::string& path) const {
  const hdf5::Session session;
  try {
    const Handle dataset = file_->dataset(path);
    const Handle type(H5Dget_type(dataset.id()), H5Tclose, "type");
    if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0) {
      throw hdf5::Error("is no text");
    }
    const auto extent = extent_of(Handle(H5Dget_space(dataset.id()), H5Sclose, "extent"));
    const std::size_t size = H5Tget_size(type.id());
    file_->take(2 * static_cast<double>(extent[0]) * static_cast<double>(extent[1]) *
                static_cast<double>(size));
    std::string cells(extent[0] * extent[1] * size, '\0');
    check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()),
          "cannot be read");
    std::vector<std::string> texts;
    for (std::size_t at = 0; at < cells.size(); at += size) {
      const std::string cell = cells.substr(at, size);
      texts.push_back(cell.substr(0, cell.find_last_not_of('\0') + 1));
    }
    return texts;
  } catch (const hdf5::Error& error) {
    refuse(fmt::format("{} {}", path, error.what()));
  }
}

void SealedReader::refuse(const std::string& reason) const {
  throw StoreError(fmt::format("cannot read {}: {}", path_.string(), reason));
}

template bool SealedReader::holds<std::uint8_t>(const std::string&) const;
template bool SealedReader::holds<std::uint16_t>(const std::string&) const;
template bool SealedReader::holds<std::uint32_t>(const std::string&) const;
template bool SealedReader::holds<std::uint64_t>(const std::string&) const;
template bool SealedReader::holds<std::int32_t>(const std::string&) const;
template bool SealedReader::holds<double>(const std::string&) const;

template std::vector<std::uint8_t> SealedReader::read(const std::string&, std::size_t) const;
template std::vector<std::uint16_t> SealedReader::read(const std::string&, std::size_t) const;
template std::vector<std::uint32_t> SealedReader::read(const std::string&, std::size_t) const;
template std::vector<std::uint64_t> SealedReader::read(const std::string&, std::size_t) const;
template std::vector<std::int32_t> SealedReader::read(const std::string&, std::size_t) const;
template std::vector<float> SealedReader::read(const std::string&, std::size_t) const;
template std::vector<double> SealedReader::read(const std::string&, std::size_t) const;

}  // namespace clca::store
