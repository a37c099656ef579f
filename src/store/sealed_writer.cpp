#include <algorithm>
#include <array>

#include "store/hdf5.hpp"
#include "store/number_types.hpp"
#include "store/seal.hpp"
#include "store/sealed_file.hpp"

namespace clca::store {

using hdf5::check;
using hdf5::Handle;

namespace {

constexpr std::size_t kSmall = 4096;         // bytes that are not worth compressing
constexpr hsize_t kChunkNumbers = 1U << 16;  // in a chunk
constexpr unsigned kDeflateLevel = 1;        // more costs time and gains little on shuffled numbers

/// In memory only.
Handle access_in_memory() {
  constexpr std::size_t kGrowth = 1U << 20U;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  check(H5Pset_fapl_core(access.id(), kGrowth, false), "memory driver");
  return access;
}

Handle create_file() {
  const Handle access = access_in_memory();
  return {H5Fcreate(hdf5::name_in_memory().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()),
          H5Fclose, "file"};
}

/// Groups on the way are made.
Handle make_links() {
  Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "link creation");
  check(H5Pset_create_intermediate_group(links.id(), 1), "groups");
  check(H5Pset_char_encoding(links.id(), H5T_CSET_UTF8), "encoding");
  return links;
}

/// How a dataset is laid out: no times, so that equal contents are equal bytes.
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

}  // namespace

class SealedWriter::File {
 public:
  explicit File(const FileKind& kind) : kind_(kind), hdf5_(create_file()), links_(make_links()) {}

  void write(const std::string& path, hid_t type, const Handle& space, const Handle& create,
             const void* data) {
    const Handle dataset(H5Dcreate2(hdf5_.id(), path.c_str(), type, space.id(), links_.id(),
                                    create.id(), H5P_DEFAULT),
                         H5Dclose, "dataset");
    check(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "write");
  }

  std::vector<std::uint8_t> image() const {
    check(H5Fflush(hdf5_.id(), H5F_SCOPE_LOCAL), "flush");
    const ssize_t size = H5Fget_file_image(hdf5_.id(), nullptr, 0);
    check(size < 0 ? -1 : 0, "size of the file");
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    check(H5Fget_file_image(hdf5_.id(), bytes.data(), bytes.size()) < 0 ? -1 : 0, "file");
    return bytes;
  }

  const FileKind& kind() const { return kind_; }

 private:
  FileKind kind_;
  Handle hdf5_;
  Handle links_;
};

SealedWriter::SealedWriter(const FileKind& kind) {
  const hdf5::Session session;
  file_ = std::make_unique<File>(kind);
}

SealedWriter::~SealedWriter() {
  const hdf5::Session session;
  file_.reset();
}

template <Number T>
void SealedWriter::add(const std::string& path, std::span<const T> values, std::size_t columns) {
  const hdf5::Session session;
  const std::array<hsize_t, 2> extent = {values.size() / columns, columns};
  const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, extent.data(), nullptr), H5Sclose,
                     "extent");
  file_->write(path, number_type<T>(), space, layout(extent[0], extent[1], sizeof(T)),
               values.data());
}

void SealedWriter::add_text(const std::string& path, std::string_view text) {
  const hdf5::Session session;
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "extent");
  const std::string copy(text.empty() ? std::string_view("\0", 1) : text);
  file_->write(path, text_type(copy.size()).id(), space, layout(1, 1, 1), copy.data());
}

void SealedWriter::add_texts(const std::string& path, const std::vector<std::string>& texts) {
  const hdf5::Session session;
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
  file_->write(path, text_type(longest).id(), space, layout(1, 1, 1), cells.data());
}

std::vector<std::uint8_t> SealedWriter::seal() {
  const hdf5::Session session;
  const std::vector<std::uint8_t> content = file_->image();
  std::vector<std::uint8_t> file = seal_of(file_->kind(), content);
  file.insert(file.end(), content.begin(), content.end());
  return file;
}

template void SealedWriter::add(const std::string&, std::span<const std::uint8_t>, std::size_t);
template void SealedWriter::add(const std::string&, std::span<const std::uint16_t>, std::size_t);
template void SealedWriter::add(const std::string&, std::span<const std::uint32_t>, std::size_t);
template void SealedWriter::add(const std::string&, std::span<const std::uint64_t>, std::size_t);
template void SealedWriter::add(const std::string&, std::span<const std::int32_t>, std::size_t);
template void SealedWriter::add(const std::string&, std::span<const float>, std::size_t);
template void SealedWriter::add(const std::string&, std::span<const double>, std::size_t);

}  // namespace clca::store
