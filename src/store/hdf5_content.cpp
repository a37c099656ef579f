#include "store/hdf5_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "store/internal/hdf5.hpp"
#include "store/number_types.hpp"

namespace clca::store::hdf5 {

namespace {

constexpr double kMaxChunkBytes = 1U << 24U;  // ours have up to 512 KiB
constexpr std::size_t kMaxTextBytes = 1U << 16U;

/// Lends the file to the library without copies; it is not changed.
hid_t give_in_place(const Handle& access, std::span<const std::uint8_t> file) {
  H5FD_file_image_callbacks_t callbacks = {
      .image_malloc = [](std::size_t, H5FD_file_image_op_t, void* bytes) { return bytes; },
      .image_memcpy = [](void* to, const void*, std::size_t, H5FD_file_image_op_t,
                         void*) { return to; },
      .image_realloc = [](void*, std::size_t, H5FD_file_image_op_t, void*) -> void* {
        return nullptr;
      },
      .image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; },
      .udata_copy = [](void* bytes) { return bytes; },
      .udata_free = [](void*) -> herr_t { return 0; },
      .udata = const_cast<std::uint8_t*>(file.data())};
  check(H5Pset_file_image_callbacks(access.id(), &callbacks), "image");
  check(H5Pset_file_image(access.id(), callbacks.udata, file.size()), "image");
  return access.id();
}

Handle open_image(std::span<const std::uint8_t> file) {
  constexpr std::size_t kGrowth = 1U << 20U;
  constexpr const char* kNone = "it is no HDF5 file";
  if (file.empty()) {
    throw Error(kNone);
  }
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  check(H5Pset_fapl_core(access.id(), kGrowth, false), "memory driver");
  return {H5Fopen("image", H5F_ACC_RDONLY, give_in_place(access, file)), H5Fclose, kNone};
}

/// Whether something has this path. Only hard links: others may lead to other files or form
/// cycles.
bool is_there(const Handle& file, const std::string& path) {
  for (std::size_t end = path.find('/');; end = path.find('/', end + 1)) {
    const std::string front = path.substr(0, end);
    H5L_info_t link{};
    const htri_t exists = H5Lexists(file.id(), front.c_str(), H5P_DEFAULT);
    if (exists == 0) {
      return false;
    }
    if (exists < 0 || H5Lget_info(file.id(), front.c_str(), &link, H5P_DEFAULT) < 0) {
      fail("is missing");
    }
    if (link.type != H5L_TYPE_HARD) {
      throw Error("is a link to somewhere else");
    }
    if (end == std::string::npos) {
      return true;
    }
  }
}

/// Only the layout of Hdf5Writer: no external files, no foreign filters, chunks of limited size.
void check_layout(const Handle& dataset, std::size_t item_bytes) {
  const Handle creation(H5Dget_create_plist(dataset.id()), H5Pclose, "has no layout");
  const H5D_layout_t layout = H5Pget_layout(creation.id());
  if (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) {
    throw Error("has an unknown layout");
  }
  if (H5Pget_external_count(creation.id()) != 0) {
    throw Error("lies in another file");
  }
  const int filters = H5Pget_nfilters(creation.id());
  for (int filter = 0; filter < filters; ++filter) {
    unsigned flags = 0;
    unsigned settings = 0;
    std::size_t values = 0;
    const H5Z_filter_t kind = H5Pget_filter2(creation.id(), static_cast<unsigned>(filter), &flags,
                                             &values, nullptr, 0, nullptr, &settings);
    if (kind != H5Z_FILTER_SHUFFLE && kind != H5Z_FILTER_DEFLATE) {
      throw Error("is compressed in another way");
    }
  }
  if (layout == H5D_CHUNKED) {
    std::array<hsize_t, H5S_MAX_RANK> chunk = {};
    const int dimensions = H5Pget_chunk(creation.id(), H5S_MAX_RANK, chunk.data());
    check(dimensions, "has no chunks");
    auto bytes = static_cast<double>(item_bytes);
    for (int dimension = 0; dimension < dimensions; ++dimension) {
      bytes *= static_cast<double>(chunk.at(static_cast<std::size_t>(dimension)));
    }
    if (bytes > kMaxChunkBytes) {
      throw Error("has chunks that are too large");
    }
  }
}

/// Number of rows and columns; lists have one column.
std::array<hsize_t, 2> extent_of(const Handle& space) {
  std::array<hsize_t, 2> extent = {1, 1};
  const H5S_class_t kind = H5Sget_simple_extent_type(space.id());
  const int dimensions = H5Sget_simple_extent_ndims(space.id());
  if ((kind != H5S_SCALAR && kind != H5S_SIMPLE) || dimensions < 0 || dimensions > 2 ||
      H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr) < 0) {
    throw Error("has an unexpected extent");
  }
  return extent;
}

void check_type(const Handle& type, const Hdf5Dataset::Values& values) {
  std::visit(
      [&]<class T>(const std::vector<T>* /*values*/) {
        if constexpr (Number<T>) {
          if (H5Tequal(type.id(), number_type<T>()) <= 0) {
            throw Error("holds other numbers");
          }
        } else if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0 ||
                   H5Tget_size(type.id()) > kMaxTextBytes) {
          throw Error("is no text");
        }
      },
      values);
}

/// A dataset that has been checked.
struct CheckedDataset {
  Handle dataset;
  Handle type;
  DatasetHeader header;
  std::size_t columns = 1;

  double bytes() const {
    return static_cast<double>(header.rows) * static_cast<double>(columns) *
           static_cast<double>(header.item_bytes);
  }
};

std::optional<CheckedDataset> open(const Handle& file, const Hdf5Dataset& wanted) {
  if (!is_there(file, wanted.path)) {
    if (wanted.may_be_missing) {
      return std::nullopt;
    }
    throw Error("is missing");
  }
  Handle dataset(H5Dopen2(file.id(), wanted.path.c_str(), H5P_DEFAULT), H5Dclose, "is no dataset");
  Handle type(H5Dget_type(dataset.id()), H5Tclose, "has no type");
  check_type(type, wanted.values);
  const std::size_t item_bytes = H5Tget_size(type.id());
  const auto extent = extent_of(Handle(H5Dget_space(dataset.id()), H5Sclose, "has no extent"));
  if (extent[1] != wanted.columns) {
    throw Error(fmt::format("has {} columns", extent[1]));
  }
  check_layout(dataset, item_bytes);
  return CheckedDataset{.dataset = std::move(dataset),
                        .type = std::move(type),
                        .header = {.rows = extent[0], .item_bytes = item_bytes},
                        .columns = wanted.columns};
}

void send_dataset(const std::optional<CheckedDataset>& opened, const process::Child::Send& send) {
  const DatasetHeader header = opened ? opened->header : DatasetHeader();
  std::vector<std::uint8_t> bytes(opened ? static_cast<std::size_t>(opened->bytes()) : 0);
  if (opened) {
    check(H5Dread(opened->dataset.id(), opened->type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                  bytes.data()),
          "cannot be read");
  }
  send({reinterpret_cast<const std::uint8_t*>(&header), sizeof header});
  send(bytes);
}

/// Calls a function for each dataset; errors name the dataset.
template <class Call>
void for_each_named(const std::vector<Hdf5Dataset>& datasets, Call call) {
  for (std::size_t i = 0; i < datasets.size(); ++i) {
    try {
      call(i);
    } catch (const Error& error) {
      throw Error(fmt::format("{} {}", datasets[i].path, error.what()));
    }
  }
}

}  // namespace

void send_datasets(std::span<const std::uint8_t> file, const std::vector<Hdf5Dataset>& datasets,
                   double max_bytes, const process::Child::Send& send) {
  const Session session;
  check(H5PLset_loading_state(0), "plugins");  // of the child process
  const Handle image = open_image(file);
  std::vector<std::optional<CheckedDataset>> all;
  all.reserve(datasets.size());
  double sum = 0;
  double largest = 0;
  for_each_named(datasets, [&](std::size_t i) {
    all.push_back(open(image, datasets[i]));
    const double bytes = all.back() ? all.back()->bytes() : 0;
    sum += bytes;
    largest = std::max(largest, bytes);
    if (sum + largest > max_bytes) {
      throw Error("needs more memory than the limit");
    }
  });
  for_each_named(datasets, [&](std::size_t i) { send_dataset(all[i], send); });
}

}  // namespace clca::store::hdf5
