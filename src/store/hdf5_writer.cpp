#include <algorithm>
#include <array>

#include "store/hdf5_file.hpp"
#include "store/internal/hdf5.hpp"
#include "store/number_types.hpp"

namespace clca::store {

using hdf5::check;
using hdf5::Handle;

namespace {

constexpr std::size_t kSmall = 4096;         // bytes that are not worth compressing
constexpr hsize_t kChunkNumbers = 1U << 16;  // in a chunk
constexpr unsigned kDeflateLevel = 1;        // more costs time and gains little on shuffled numbers

/// Creates parent groups.
Handle make_links() {
  Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "link creation");
  check(H5Pset_create_intermediate_group(links.id(), 1), "groups");
  check(H5Pset_char_encoding(links.id(), H5T_CSET_UTF8), "encoding");
  return links;
}

/// Layout of datasets: without times, so that equal content gives equal bytes.
Handle layout(hsize_t rows, hsize_t columns, std::size_t number_bytes) {
  Handle create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "dataset creation");
  check(H5Pset_obj_track_times(create.id(), false), "times");
  if (rows * columns * number_bytes > kSmall) {
    const std::array<hsize_t, 2> chunk = {
        std::min(rows, std::max<hsize_t>(1, kChunkNumbers / columns)), columns};
    check(H5Pset_chunk(create.id(), columns == 1 ? 1 : 2, chunk.data()), "chunks");
    check(H5Pset_shuffle(create.id()), "shuffle");
    check(H5Pset_deflate(create.id(), kDeflateLevel), "compression");
  }
  return create;
}

Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text");
  check(H5Tset_size(type.id(), size), "text size");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "encoding");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "padding");
  return type;
}

void write_dataset(hid_t file, const std::string& path, hid_t type, const Handle& space,
                   const Handle& create, const void* data, const Meaning& meaning) {
  const Handle links = make_links();
  const Handle dataset(
      H5Dcreate2(file, path.c_str(), type, space.id(), links.id(), create.id(), H5P_DEFAULT),
      H5Dclose, "dataset");
  check(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "write");
  if (!meaning.text.empty()) {
    hdf5::describe(dataset, meaning.unit, meaning.text);
  }
}

}  // namespace

template <Number T>
void Hdf5Writer::add(const std::string& path, std::span<const T> values, std::size_t columns,
                     const Meaning& meaning) const {
  const std::array<hsize_t, 2> extent = {values.size() / columns, columns};
  const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, extent.data(), nullptr), H5Sclose,
                     "extent");
  write_dataset(file_, path, number_type<T>(), space, layout(extent[0], extent[1], sizeof(T)),
                values.data(), meaning);
}

void Hdf5Writer::add_text(const std::string& path, std::string_view text,
                          const Meaning& meaning) const {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "extent");
  const std::string copy(text.empty() ? std::string_view("\0", 1) : text);
  write_dataset(file_, path, text_type(copy.size()).id(), space, layout(1, 1, 1), copy.data(),
                meaning);
}

void Hdf5Writer::add_texts(const std::string& path, const std::vector<std::string>& texts,
                           const Meaning& meaning) const {
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    longest = std::max(longest, text.size());
  }
  std::string cells;
  for (const std::string& text : texts) {
    cells += text;
    cells.resize(cells.size() + longest - text.size());
  }
  const hsize_t extent = texts.size();
  const Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose, "extent");
  write_dataset(file_, path, text_type(longest).id(), space, layout(1, 1, 1), cells.data(),
                meaning);
}

std::vector<std::uint8_t> hdf5_file(const std::filesystem::path& path, const FileKind& kind,
                                    const std::function<void(const Hdf5Writer& file)>& add) {
  return with_header(kind,
                     hdf5::image(path, [&](const Handle& file) { add(Hdf5Writer(file.id())); }));
}

template void Hdf5Writer::add(const std::string&, std::span<const std::uint8_t>, std::size_t,
                              const Meaning&) const;
template void Hdf5Writer::add(const std::string&, std::span<const std::uint16_t>, std::size_t,
                              const Meaning&) const;
template void Hdf5Writer::add(const std::string&, std::span<const std::uint32_t>, std::size_t,
                              const Meaning&) const;
template void Hdf5Writer::add(const std::string&, std::span<const std::uint64_t>, std::size_t,
                              const Meaning&) const;
template void Hdf5Writer::add(const std::string&, std::span<const std::int32_t>, std::size_t,
                              const Meaning&) const;
template void Hdf5Writer::add(const std::string&, std::span<const double>, std::size_t,
                              const Meaning&) const;

}  // namespace clca::store
