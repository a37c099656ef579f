#include "store/hdf5_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "clca/store/file.hpp"
#include "store/hdf5.hpp"

namespace clca::store {

using hdf5::check;
using hdf5::Error;
using hdf5::Handle;

namespace {

/// Properties of a dataset of numbers.
Handle layout(hsize_t rows, hsize_t columns, std::size_t number_bytes) {
  constexpr std::size_t kSmall = 4096;         // bytes that are not worth compressing
  constexpr hsize_t kChunkNumbers = 1U << 16;  // in a chunk
  constexpr unsigned kDeflateLevel = 1;  // more costs time and gains little on shuffled numbers
  Handle creation = hdf5::properties(H5P_DATASET_CREATE);
  if (rows * columns * number_bytes > kSmall) {
    const std::array<hsize_t, 2> chunk = {
        std::min(rows, std::max<hsize_t>(1, kChunkNumbers / columns)), columns};
    check(H5Pset_chunk(creation.id(), columns == 1 ? 1 : 2, chunk.data()), "chunks");
    check(H5Pset_shuffle(creation.id()), "shuffle");
    check(H5Pset_deflate(creation.id(), kDeflateLevel), "compression");
  }
  return creation;
}

void write_dataset(const Handle& file, const std::string& path, hid_t type, const Handle& space,
                   const Handle& creation, const void* data, const Meaning& meaning) {
  const Handle dataset = hdf5::make_dataset(file, path, type, space, creation, meaning);
  check(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "write");
}

template <Number T>
void write_values(const Handle& file, const std::string& path, std::span<const T> values,
                  std::size_t columns, const Meaning& meaning) {
  const hsize_t rows = values.size() / columns;
  const Handle space = columns == 1 ? hdf5::space_of({rows}) : hdf5::space_of({rows, columns});
  write_dataset(file, path, hdf5::number_type<T>(), space, layout(rows, columns, sizeof(T)),
                values.data(), meaning);
}

/// All in cells of one length, padded with zeros.
void write_texts(const Handle& file, const std::string& path, std::span<const std::string> texts,
                 const Handle& space, const Meaning& meaning) {
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    longest = std::max(longest, text.size());
  }
  std::string cells;
  for (const std::string& text : texts) {
    cells += text;
    cells.resize(cells.size() + longest - text.size());
  }
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text");
  check(H5Tset_size(type.id(), longest), "text size");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "encoding");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "padding");
  write_dataset(file, path, type.id(), space, hdf5::properties(H5P_DATASET_CREATE), cells.data(),
                meaning);
}

/// Number of rows and columns; lists have one column.
std::array<hsize_t, 2> extent_of(const Handle& dataset) {
  std::array<hsize_t, 2> extent = {1, 1};
  const Handle space(H5Dget_space(dataset.id()), H5Sclose, "has no extent");
  if (H5Sget_simple_extent_ndims(space.id()) > 2 ||
      H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr) < 0) {
    throw Error("has an unexpected extent");
  }
  return extent;
}

class Reader {
 public:
  Reader(std::span<const std::uint8_t> content, double max_bytes)
      : file_(hdf5::open_image(content)), bytes_left_(max_bytes) {}

  void read(const Hdf5Dataset& wanted) {
    std::visit([](auto* values) { values->clear(); }, wanted.values);
    if (H5Lexists(file_.id(), wanted.path.c_str(), H5P_DEFAULT) <= 0) {
      if (!wanted.may_be_missing) {
        throw Error("is missing");
      }
      return;
    }
    const Handle dataset(H5Dopen2(file_.id(), wanted.path.c_str(), H5P_DEFAULT), H5Dclose,
                         "is no dataset");
    const auto extent = extent_of(dataset);
    if (extent[1] != wanted.columns) {
      throw Error(fmt::format("has {} columns", extent[1]));
    }
    std::visit([&](auto* values) { read(dataset, extent, *values); }, wanted.values);
  }

 private:
  using Extent = std::array<hsize_t, 2>;

  template <Number T>
  void read(const Handle& dataset, const Extent& extent, std::vector<T>& values) {
    const Handle type = type_of(dataset);
    if (H5Tequal(type.id(), hdf5::number_type<T>()) <= 0) {
      throw Error("holds other numbers");
    }
    take(extent, sizeof(T));
    values.resize(extent[0] * extent[1]);
    read_into(dataset, type, values.data());
  }

  void read(const Handle& dataset, const Extent& extent, std::vector<std::string>& texts) {
    const Handle type = type_of(dataset);
    if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0) {
      throw Error("is no text");
    }
    const std::size_t size = H5Tget_size(type.id());
    take(extent, sizeof(std::string) + 2 * static_cast<double>(size));
    std::string cells(extent[0] * extent[1] * size, '\0');
    read_into(dataset, type, cells.data());
    for (std::size_t at = 0; at < cells.size(); at += size) {
      std::string& text = texts.emplace_back(cells.substr(at, size));
      text.resize(text.find_last_not_of('\0') + 1);
    }
  }

  static Handle type_of(const Handle& dataset) {
    return {H5Dget_type(dataset.id()), H5Tclose, "has no type"};
  }
  static void read_into(const Handle& dataset, const Handle& type, void* data) {
    check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "cannot be read");
  }

  /// All data read count, as the caller keeps them.
  void take(const Extent& extent, double item_bytes) {
    bytes_left_ -= static_cast<double>(extent[0]) * static_cast<double>(extent[1]) * item_bytes;
    if (bytes_left_ < 0) {
      throw Error("needs more memory than the limit");
    }
  }

  Handle file_;
  double bytes_left_;
};

}  // namespace

void Hdf5Writer::add(const std::string& path, const Values& values, std::size_t columns,
                     const Meaning& meaning) const {
  std::visit(
      [&]<class T>(const T& list) {
        if constexpr (std::same_as<T, std::string_view>) {
          const std::string text(list);
          write_texts(file_, path, {&text, 1}, hdf5::space_of({}), meaning);
        } else if constexpr (std::same_as<T, std::span<const std::string>>) {
          write_texts(file_, path, list, hdf5::space_of({list.size()}), meaning);
        } else {
          write_values(file_, path, list, columns, meaning);
        }
      },
      values);
}

std::vector<std::uint8_t> hdf5_file(const std::filesystem::path& path, const FileKind& kind,
                                    const std::function<void(const Hdf5Writer& file)>& add) {
  return with_header(kind, hdf5::image(path, [&](const Handle& file) { add(Hdf5Writer(file)); }));
}

void read_hdf5(const std::filesystem::path& path, const FileKind& kind,
               const std::vector<Hdf5Dataset>& datasets, double max_bytes) {
  constexpr double kCopies = 3;  // as it was read, and of the library
  const std::vector<std::uint8_t> file = read_whole(path, max_bytes);
  const double bytes_left = max_bytes - kCopies * static_cast<double>(file.size());
  try {
    const auto content = content_of(kind, file);
    if (bytes_left < 0) {
      throw Error("it needs more memory than the limit");
    }
    const hdf5::Session session;
    Reader reader(content, bytes_left);
    for (const Hdf5Dataset& dataset : datasets) {
      try {
        reader.read(dataset);
      } catch (const Error& error) {
        throw Error(fmt::format("{} {}", dataset.path, error.what()));
      }
    }
  } catch (const std::runtime_error& error) {
    throw StoreError(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
}

}  // namespace clca::store
