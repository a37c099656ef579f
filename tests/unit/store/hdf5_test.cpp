#include "store/hdf5.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <thread>

#include "clca/store/file.hpp"
#include "support/runs.hpp"

namespace clca::store::hdf5_test {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

constexpr FileKind kKind = {"thing", 2};
constexpr double kMuch = 1e8;

template <class Values>
void add(const hdf5::Handle& file, const char* path, Values values, std::size_t columns = 1) {
  hdf5::add_dataset(file, {path, &values, columns});
}

Bytes example(const FileKind& kind = kKind) {
  return with_header(
      kind, hdf5::file_bytes("file.h5", [](const hdf5::Handle& file) {
        add(file, "group/inner/numbers", std::vector<std::int32_t>{1, -2, 3, 4, 5, -6}, 3);
        add(file, "reals", std::vector<double>(5000, 0.1));
        add(file, "nothing", Bytes());
        add(file, "text", std::string("zwei\nZeilen"));
        add(file, "no_text", std::string());
        add(file, "names", std::vector<std::string>{"a", "", "long"});
      }));
}

class Hdf5FileTest : public ::testing::Test {
 protected:
  std::filesystem::path put(const Bytes& bytes) const {
    const auto path = folder_.path() / "file.h5";
    write_whole_file(path, bytes);
    return path;
  }
  /// Of the file that was put last.
  template <class T>
  std::vector<T> read(const std::string& path, std::size_t columns = 1) const {
    std::vector<T> values;
    read_hdf5(folder_.path() / "file.h5", kKind, {{path, &values, columns}}, kMuch);
    return values;
  }
  /// Why these datasets cannot be read of a file.
  std::string reason(const Bytes& bytes, const std::vector<Hdf5Dataset>& datasets,
                     double max_bytes = kMuch) const {
    try {
      read_hdf5(put(bytes), kKind, datasets, max_bytes);
    } catch (const StoreError& error) {
      return error.what();
    }
    return "";
  }

  testing::ScratchFolder folder_;
};

TEST_F(Hdf5FileTest, WhatIsAddedIsRead) {
  put(example());
  EXPECT_THAT(read<std::int32_t>("group/inner/numbers", 3), ElementsAre(1, -2, 3, 4, 5, -6));
  EXPECT_EQ(read<double>("reals"), std::vector<double>(5000, 0.1));
  EXPECT_TRUE(read<std::uint8_t>("nothing").empty());
  EXPECT_THAT(read<std::string>("text"), ElementsAre("zwei\nZeilen"));
  std::string text = "before";
  read_hdf5(folder_.path() / "file.h5", kKind, {{"text", &text}}, kMuch);
  EXPECT_EQ(text, "zwei\nZeilen");
  EXPECT_THAT(read<std::string>("no_text"), ElementsAre(""));
  EXPECT_THAT(read<std::string>("names"), ElementsAre("a", "", "long"));
}

TEST_F(Hdf5FileTest, SeveralDatasetsAreReadAtOnce) {
  std::vector<std::string> names;
  std::vector<double> reals = {1, 2, 3};
  read_hdf5(put(example()), kKind, {{"names", &names}, {"reals", &reals}}, kMuch);
  EXPECT_EQ(names.size(), 3U);
  EXPECT_EQ(reals.size(), 5000U) << "in place of what was there";
}

TEST_F(Hdf5FileTest, EqualContentsAreEqualBytes) {
  EXPECT_EQ(example(), example());
}

TEST_F(Hdf5FileTest, AnotherVersionIsRefused) {
  EXPECT_THAT(reason(example({"thing", 3}), {}),
              EndsWith("file.h5: its format is version 3, this program reads version 2"));
  EXPECT_THAT(reason(example({"thing", 1}), {}),
              EndsWith("file.h5: its format is version 1, this program reads version 2"));
}

TEST_F(Hdf5FileTest, WhateverIsNotWholeIsRefused) {
  EXPECT_EQ(reason(example(), {}), "");
  EXPECT_THAT(reason(example({"other", 2}), {}), EndsWith("it is no thing of clca"));
  EXPECT_THAT(reason({}, {}), EndsWith("it is no thing of clca"));
  EXPECT_THAT(reason({'c', 'l', 'c', 'a'}, {}), EndsWith("it is no thing of clca"));
  for (const std::size_t kept : {40U, 511U, 512U, 513U, 5000U}) {
    auto bytes = example();
    bytes.resize(kept);
    EXPECT_THAT(reason(bytes, {}), EndsWith("it is cut off")) << kept;
  }
  const Bytes whole = example();
  for (std::size_t at = 0; at < whole.size(); at += 97) {
    auto bytes = whole;
    bytes[at] ^= 4U;
    EXPECT_NE(reason(bytes, {}), "") << at;
  }
  auto longer = whole;
  longer.push_back(0);
  EXPECT_THAT(reason(longer, {}), HasSubstr("checksum is wrong"));
}

TEST_F(Hdf5FileTest, WhatNeedsMoreMemoryThanAllowedIsRefused) {
  const auto bytes = example();
  const double size = 3 * static_cast<double>(bytes.size());
  std::vector<double> reals;
  EXPECT_THAT(reason(bytes, {{"reals", &reals}}, size - 1), HasSubstr("than the limit"));
  EXPECT_THAT(reason(bytes, {{"reals", &reals}}, size + 39'999),
              EndsWith("reals needs more memory than the limit"));
  EXPECT_EQ(reason(bytes, {{"reals", &reals}}, size + 40'000), "");
  EXPECT_THAT(reason(bytes, {{"reals", &reals}, {"reals", &reals}}, size + 79'999),
              EndsWith("reals needs more memory than the limit"));
}

TEST_F(Hdf5FileTest, WhatIsAskedForInVainIsNamed) {
  std::vector<double> reals;
  std::vector<std::uint64_t> numbers;
  std::vector<std::string> texts;
  const auto why = [&](const Hdf5Dataset& dataset) { return reason(example(), {dataset}); };
  EXPECT_THAT(why({"group/none", &reals}), EndsWith("group/none is missing"));
  EXPECT_THAT(why({"none/at/all", &reals}), EndsWith("none/at/all is missing"));
  EXPECT_THAT(why({"group/inner", &reals}), EndsWith("group/inner is no dataset"));
  EXPECT_THAT(why({"reals/of", &reals}), EndsWith("reals/of is missing"));
  EXPECT_THAT(why({"reals", &numbers}), EndsWith("reals holds other numbers"));
  EXPECT_THAT(why({"reals", &reals, 2}), EndsWith("reals has 1 columns"));
  EXPECT_THAT(why({"reals", &texts}), EndsWith("reals is no text"));
  EXPECT_THAT(why({"names", &numbers}), EndsWith("names holds other numbers"));
}

/// A file with the numbers `rows`, which fill it adds.
Bytes file_with_rows(hsize_t rows, const std::function<void(const hdf5::Handle& rows)>& fill) {
  return with_header(kKind, hdf5::file_bytes("file.h5", [&](const hdf5::Handle& file) {
                       const hdf5::Handle creation = hdf5::make_properties(H5P_DATASET_CREATE);
                       const hsize_t chunk = 1000;
                       hdf5::check(H5Pset_chunk(creation.id(), 1, &chunk), "chunk");
                       hdf5::check(H5Pset_deflate(creation.id(), 1), "compression");
                       fill(hdf5::make_dataset(file, {"rows", {}}, H5T_NATIVE_UINT8,
                                               hdf5::dataspace({rows}), creation));
                     }));
}

TEST_F(Hdf5FileTest, RowsThatAreNotInTheFileAreNotAllocatedBeyondTheLimit) {
  Bytes rows;
  const auto why = [&](hsize_t count) {
    return reason(file_with_rows(count, [](const hdf5::Handle&) {}), {{"rows", &rows}});
  };
  EXPECT_EQ(why(1000), "");
  EXPECT_EQ(rows, Bytes(1000, 0));
  EXPECT_THAT(why(hsize_t{1} << 40U), EndsWith("rows needs more memory than the limit"));
  EXPECT_THAT(why(hsize_t{1} << 62U), EndsWith("rows needs more memory than the limit"));
}

TEST_F(Hdf5FileTest, WhatTheLibraryCannotReadIsOneLineAndNothingOnTheTerminal) {
  ::testing::internal::CaptureStderr();
  EXPECT_THAT(reason(with_header(kKind, Bytes()), {}), EndsWith("file.h5: it is no HDF5 file"));
  EXPECT_THAT(reason(with_header(kKind, Bytes(5000, 0xFF)), {}),
              EndsWith("file.h5: it is no HDF5 file"));
  const Bytes damaged = file_with_rows(1000, [](const hdf5::Handle& rows) {
    const Bytes no_stream(5000, 0x78);
    const hsize_t first = 0;
    hdf5::check(
        H5Dwrite_chunk(rows.id(), H5P_DEFAULT, 0, &first, no_stream.size(), no_stream.data()),
        "chunk");
  });
  Bytes rows;
  EXPECT_THAT(reason(damaged, {{"rows", &rows}}), EndsWith("file.h5: rows cannot be read"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(Hdf5FileTest, WhatGoesWrongWhileItIsMadeIsOneLine) {
  const auto why = [](const std::function<void(const hdf5::Handle& file)>& add) {
    try {
      hdf5::file_bytes("file.h5", add);
    } catch (const StoreError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(why([](const hdf5::Handle& file) {
              add(file, "text", std::string());
              add(file, "text", std::string());
            }),
            "cannot write file.h5: the HDF5 library: dataset");
  EXPECT_THROW(why([](const hdf5::Handle&) { throw std::bad_alloc(); }), std::bad_alloc);
}

TEST_F(Hdf5FileTest, ThreadsMakeAndReadFilesAtOnce) {
  const auto path = put(example());
  const Bytes alone = example();
  std::atomic<int> wrong = 0;
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread) {
      threads.emplace_back([&, thread] {
        for (int round = 0; round < 20; ++round) {
          if (thread % 2 == 0) {
            wrong += example() == alone ? 0 : 1;
          } else {
            std::vector<double> reals;
            read_hdf5(path, kKind, {{"reals", &reals}}, kMuch);
            wrong += reals == std::vector<double>(5000, 0.1) ? 0 : 1;
          }
        }
      });
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST_F(Hdf5FileTest, OtherReadersOfHdf5OpenIt) {
  const auto path = put(example());
  const std::string python =
      "/usr/bin/python3 -c 'import h5py, sys; f = h5py.File(sys.argv[1]); "
      "sys.exit(0 if f[\"group/inner/numbers\"][1, 2] == -6 and f[\"reals\"].shape == (5000,) and "
      "f[\"text\"][()].decode().startswith(\"zwei\") else 1)' ";
  EXPECT_EQ(std::system((python + path.string()).c_str()), 0);
}

}  // namespace
}  // namespace clca::store::hdf5_test
