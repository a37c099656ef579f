// Files with a right checksum that HDF5 can hold and no run writes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "clca/store/file.hpp"
#include "store/hdf5_file.hpp"
#include "store/internal/hdf5.hpp"
#include "support/runs.hpp"
#include "support/sanitizers.hpp"

namespace clca::store::hostile_hdf5_test {
namespace {

using hdf5::Handle;
using ::testing::EndsWith;
using Bytes = std::vector<std::uint8_t>;

constexpr FileKind kKind = {"thing", 1};
constexpr double kMuch = 1e8;

Handle properties(hid_t of) {
  return {H5Pcreate(of), H5Pclose, "properties"};
}

/// A list of u8 called `numbers`.
void add_numbers(const Handle& file, hsize_t rows, const Handle& creation,
                 hid_t type = H5T_NATIVE_UINT8) {
  const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose, "extent");
  const Handle dataset(
      H5Dcreate2(file.id(), "numbers", type, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
      H5Dclose, "dataset");
}

class HostileHdf5 : public ::testing::Test {
 protected:
  std::filesystem::path path() const { return folder_.path() / "file.h5"; }

  /// What comes of reading `numbers`.
  std::string reason(const Bytes& content, double max_bytes = kMuch) {
    write_whole(path(), with_header(kKind, content));
    try {
      read_hdf5(path(), kKind, {{.path = "numbers", .values = &numbers_}}, max_bytes);
    } catch (const StoreError& error) {
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
      return error.what();
    }
    return "";
  }
  std::string reason(const std::function<void(const Handle& file)>& fill,
                     double max_bytes = kMuch) {
    return reason(hdf5::image(path(), fill), max_bytes);
  }

  testing::ScratchFolder folder_;
  std::vector<std::uint8_t> numbers_;
};

TEST_F(HostileHdf5, LinksToOtherFilesAreNotFollowed) {
  const auto other = folder_.path() / "other.h5";
  write_whole(other, hdf5::image(other, [](const Handle& file) {
                add_numbers(file, 4, properties(H5P_DATASET_CREATE));
              }));
  EXPECT_THAT(reason([&](const Handle& file) {
                hdf5::check(H5Lcreate_external(other.c_str(), "/numbers", file.id(), "numbers",
                                               H5P_DEFAULT, H5P_DEFAULT),
                            "link");
              }),
              EndsWith("file.h5: numbers is a link to somewhere else"));
}

TEST_F(HostileHdf5, SoftLinksAreNotFollowed) {
  EXPECT_THAT(reason([](const Handle& file) {
                hdf5::check(
                    H5Lcreate_soft("/numbers", file.id(), "numbers", H5P_DEFAULT, H5P_DEFAULT),
                    "link");
              }),
              EndsWith("file.h5: numbers is a link to somewhere else"));
}

TEST_F(HostileHdf5, ADatasetThatLiesInAnotherFileIsNotRead) {
  const auto secret = folder_.path() / "secret";
  write_whole(secret, "the secret of another");
  EXPECT_THAT(reason([&](const Handle& file) {
                const Handle creation = properties(H5P_DATASET_CREATE);
                hdf5::check(H5Pset_external(creation.id(), secret.c_str(), 0, 10), "external");
                add_numbers(file, 10, creation);
              }),
              EndsWith("file.h5: numbers lies in another file"));
  EXPECT_TRUE(numbers_.empty());
}

TEST_F(HostileHdf5, AVirtualDatasetIsNotRead) {
  EXPECT_THAT(reason([&](const Handle& file) {
                const Handle creation = properties(H5P_DATASET_CREATE);
                const hsize_t rows = 10;
                const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose, "extent");
                hdf5::check(
                    H5Pset_virtual(creation.id(), space.id(), "other.h5", "numbers", space.id()),
                    "virtual");
                add_numbers(file, rows, creation);
              }),
              EndsWith("file.h5: numbers has an unknown layout"));
}

TEST_F(HostileHdf5, HugeChunksAreNotAllocated) {
  const auto fill = [](const Handle& file) {
    const Handle creation = properties(H5P_DATASET_CREATE);
    const hsize_t chunk = 900U << 20U;
    hdf5::check(H5Pset_chunk(creation.id(), 1, &chunk), "chunk");
    hdf5::check(H5Pset_deflate(creation.id(), 1), "compression");
    const hsize_t rows = 10;
    const hsize_t most = H5S_UNLIMITED;
    const Handle space(H5Screate_simple(1, &rows, &most), H5Sclose, "extent");
    const Handle dataset(H5Dcreate2(file.id(), "numbers", H5T_NATIVE_UINT8, space.id(), H5P_DEFAULT,
                                    creation.id(), H5P_DEFAULT),
                         H5Dclose, "dataset");
  };
  EXPECT_THAT(reason(fill), EndsWith("file.h5: numbers has chunks that are too large"));
}

TEST_F(HostileHdf5, RowsThatAreNotThereAreNotAllocatedBeyondTheLimit) {
  const auto with_rows = [](hsize_t rows) {
    return [rows](const Handle& file) { add_numbers(file, rows, properties(H5P_DATASET_CREATE)); };
  };
  EXPECT_EQ(reason(with_rows(1'000'000)), "") << "all are the fill value";
  EXPECT_EQ(numbers_, Bytes(1'000'000, 0));
  EXPECT_THAT(reason(with_rows(hsize_t{1} << 40U)),
              EndsWith("file.h5: numbers needs more memory than the limit"));
  EXPECT_THAT(reason(with_rows(1'000'000), 1'500'000),
              EndsWith("file.h5: numbers needs more memory than the limit"));
}

TEST_F(HostileHdf5, OtherFiltersAreNotUsed) {
  EXPECT_THAT(reason([](const Handle& file) {
                const Handle creation = properties(H5P_DATASET_CREATE);
                const hsize_t chunk = 10;
                hdf5::check(H5Pset_chunk(creation.id(), 1, &chunk), "chunk");
                hdf5::check(H5Pset_nbit(creation.id()), "filter");
                add_numbers(file, 10, creation);
              }),
              EndsWith("file.h5: numbers is compressed in another way"));
}

TEST_F(HostileHdf5, TextsOfVariableLengthAreNotRead) {
  write_whole(path(), with_header(kKind, hdf5::image(path(), [](const Handle& file) {
                                    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text");
                                    hdf5::check(H5Tset_size(type.id(), H5T_VARIABLE), "size");
                                    add_numbers(file, 3, properties(H5P_DATASET_CREATE), type.id());
                                  })));
  std::vector<std::string> texts;
  EXPECT_THAT([&] { read_hdf5(path(), kKind, {{.path = "numbers", .values = &texts}}, kMuch); },
              ::testing::ThrowsMessage<StoreError>(EndsWith("file.h5: numbers is no text")));
}

TEST_F(HostileHdf5, DeepGroupsAndLinksInCirclesDoNoHarm) {
  EXPECT_EQ(reason([](const Handle& file) {
              std::string path;
              for (int depth = 0; depth < 500; ++depth) {
                path += "/g";
                const Handle group(
                    H5Gcreate2(file.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                    H5Gclose, "group");
              }
              hdf5::check(H5Lcreate_hard(file.id(), "/", file.id(), (path + "/top").c_str(),
                                         H5P_DEFAULT, H5P_DEFAULT),
                          "link");
              add_numbers(file, 4, properties(H5P_DATASET_CREATE));
            }),
            "");
}

TEST_F(HostileHdf5, WhatIsNoHdf5IsRefused) {
  EXPECT_THAT(reason(Bytes()), EndsWith("file.h5: it is no HDF5 file"));
  EXPECT_THAT(reason(Bytes(5000, 0xFF)), EndsWith("file.h5: it is no HDF5 file"));
}

/// 1000 rows in one chunk, for which these bytes stand.
auto with_chunk(const Bytes& compressed) {
  return [compressed](const Handle& file) {
    const Handle creation = properties(H5P_DATASET_CREATE);
    const hsize_t rows = 1000;
    hdf5::check(H5Pset_chunk(creation.id(), 1, &rows), "chunk");
    hdf5::check(H5Pset_deflate(creation.id(), 1), "compression");
    add_numbers(file, rows, creation);
    const Handle dataset(H5Dopen2(file.id(), "numbers", H5P_DEFAULT), H5Dclose, "dataset");
    const hsize_t first = 0;
    hdf5::check(
        H5Dwrite_chunk(dataset.id(), H5P_DEFAULT, 0, &first, compressed.size(), compressed.data()),
        "chunk");
  };
}

TEST_F(HostileHdf5, AChunkThatIsNotCompressedDataIsRefused) {
  EXPECT_THAT(reason(with_chunk(Bytes(5000, 0x78))), EndsWith("file.h5: numbers cannot be read"));
}

// The library inflates all of a chunk, however much there is: the limit of the child ends it.
TEST_F(HostileHdf5, AChunkThatInflatesWithoutEndIsRefused) {
  const Bytes zeros(std::size_t{200} << 20U, 0);
  uLongf size = ::compressBound(zeros.size());
  Bytes compressed(size);
  ASSERT_EQ(::compress(compressed.data(), &size, zeros.data(), zeros.size()), Z_OK);
  compressed.resize(size);
  const std::string answer = reason(with_chunk(compressed), 1e6);
  if (!testing::kSanitized) {
    EXPECT_THAT(answer, EndsWith("file.h5: out of memory"));
  }
}

}  // namespace
}  // namespace clca::store::hostile_hdf5_test
