#include "export/h5md_file.hpp"

namespace clca::exports {

using store::hdf5::check;

namespace {

constexpr unsigned kDeflateLevel = 1;

Handle space_of(const Dimensions& size, const Dimensions& most) {
  return {H5Screate_simple(static_cast<int>(size.size()), size.data(), most.data()), H5Sclose,
          "extent"};
}

Handle new_dataset(const Handle& file, const std::string& path, hid_t type, const Dimensions& chunk,
                   const void* fill) {
  const Handle create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties");
  check(H5Pset_obj_track_times(create.id(), false), "times");
  check(H5Pset_chunk(create.id(), static_cast<int>(chunk.size()), chunk.data()), "chunks");
  check(H5Pset_shuffle(create.id()), "shuffle");
  check(H5Pset_deflate(create.id(), kDeflateLevel), "compression");
  if (fill != nullptr) {
    check(H5Pset_fill_value(create.id(), type, fill), "fill value");
  }
  const Handle space =
      space_of(Dimensions(chunk.size(), 0), Dimensions(chunk.size(), H5S_UNLIMITED));
  return {
      H5Dcreate2(file.id(), path.c_str(), type, space.id(), H5P_DEFAULT, create.id(), H5P_DEFAULT),
      H5Dclose, "dataset"};
}

}  // namespace

Handle new_file(const std::string& file) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  check(H5Pset_file_locking(access.id(), false, true), "locks");
  return {H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, "file"};
}

Handle new_group(const Handle& file, const std::string& path) {
  return {H5Gcreate2(file.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
          "group"};
}

void add_attribute(const Handle& object, const char* name, hid_t type, const Dimensions& size,
                   const void* values) {
  const Handle space = space_of(size, size);
  const Handle attribute(H5Acreate2(object.id(), name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, "attribute");
  check(H5Awrite(attribute.id(), type, values), "attribute");
}

void add_texts(const Handle& object, const char* name, const std::vector<std::string_view>& texts) {
  std::size_t length = 0;
  for (const std::string_view text : texts) {
    length = std::max(length, text.size());
  }
  std::string cells;
  for (const std::string_view text : texts) {
    cells += text;
    cells.resize(cells.size() + length - text.size());
  }
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text");
  check(H5Tset_size(type.id(), length), "text size");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "padding");
  add_attribute(object, name, type.id(),
                texts.size() == 1 ? Dimensions() : Dimensions{texts.size()}, cells.data());
}

GrowingDataset::GrowingDataset(const Handle& file, const std::string& path, hid_t type,
                               const Dimensions& chunk, const void* fill)
    : type_(type), dataset_(new_dataset(file, path, type, chunk, fill)) {}

void GrowingDataset::append(const Dimensions& size, const void* row) {
  Dimensions count = {rows_ + 1};
  count.insert(count.end(), size.begin(), size.end());
  check(H5Dset_extent(dataset_.id(), count.data()), "extent");
  Dimensions start(count.size(), 0);
  start.front() = rows_;
  count.front() = 1;
  const Handle memory = space_of(count, count);
  const Handle file(H5Dget_space(dataset_.id()), H5Sclose, "extent");
  check(
      H5Sselect_hyperslab(file.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
      "row");
  check(H5Dwrite(dataset_.id(), type_, memory.id(), file.id(), H5P_DEFAULT, row), "write");
  ++rows_;
}

}  // namespace clca::exports
