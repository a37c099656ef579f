#include "store/sealed_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "clca/store/file.hpp"
#include "support/runs.hpp"

namespace clca::store {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr FileKind kKind = {"thing", 2};
constexpr double kMuch = 1e8;

std::vector<std::uint8_t> example(const FileKind& kind = kKind) {
  SealedWriter writer(kind);
  writer.add<std::int32_t>("group/inner/numbers", std::vector<std::int32_t>{1, -2, 3, 4, 5, -6}, 3);
  writer.add<double>("reals", std::vector<double>(5000, 0.1));
  writer.add<std::uint8_t>("nothing", {});
  writer.add_text("text", "zwei\nZeilen");
  writer.add_text("no_text", "");
  writer.add_texts("names", {"a", "", "long"});
  return writer.seal();
}

class SealedFileTest : public ::testing::Test {
 protected:
  std::filesystem::path put(const std::vector<std::uint8_t>& bytes) const {
    const auto path = folder_.path() / "file.h5";
    write_whole(path, bytes);
    return path;
  }
  std::string reason(const std::vector<std::uint8_t>& bytes, const FileKind& kind = kKind,
                     double most_bytes = kMuch) const {
    try {
      const SealedReader reader(put(bytes), kind, most_bytes);
    } catch (const StoreError& error) {
      return error.what();
    }
    return "";
  }

  testing::ScratchFolder folder_;
};

TEST_F(SealedFileTest, WhatIsAddedIsRead) {
  const SealedReader reader(put(example()), kKind, kMuch);
  EXPECT_EQ(reader.version(), 2U);
  EXPECT_THAT(reader.read<std::int32_t>("group/inner/numbers", 3), ElementsAre(1, -2, 3, 4, 5, -6));
  EXPECT_EQ(reader.read<double>("reals"), std::vector<double>(5000, 0.1));
  EXPECT_TRUE(reader.read<std::uint8_t>("nothing").empty());
  EXPECT_EQ(reader.read_text("text"), "zwei\nZeilen");
  EXPECT_EQ(reader.read_text("no_text"), "");
  EXPECT_THAT(reader.read_texts("names"), ElementsAre("a", "", "long"));
  EXPECT_TRUE(reader.has("group/inner"));
  EXPECT_FALSE(reader.has("group/other/numbers"));
}

TEST_F(SealedFileTest, SeveralFilesAreOpenAtOnce) {
  SealedWriter one(kKind);
  one.add<std::uint8_t>("value", std::vector<std::uint8_t>{1});
  SealedWriter two(kKind);
  two.add<std::uint8_t>("value", std::vector<std::uint8_t>{2});
  const SealedReader first(put(one.seal()), kKind, kMuch);
  const SealedReader second(put(two.seal()), kKind, kMuch);
  EXPECT_THAT(first.read<std::uint8_t>("value"), ElementsAre(1));
  EXPECT_THAT(second.read<std::uint8_t>("value"), ElementsAre(2));
}

TEST_F(SealedFileTest, EqualContentsAreEqualBytes) {
  EXPECT_EQ(example(), example());
}

TEST_F(SealedFileTest, AnOlderVersionIsReadANewerOneRefused) {
  EXPECT_EQ(SealedReader(put(example({"thing", 1})), kKind, kMuch).version(), 1U);
  EXPECT_THAT(reason(example({"thing", 3})),
              EndsWith("file.h5: its format is version 3, newer than this program, which knows up "
                       "to 2"));
}

TEST_F(SealedFileTest, WhateverIsNotWholeIsRefused) {
  EXPECT_THAT(reason(example({"other", 2})), EndsWith("it is no thing of clca"));
  EXPECT_THAT(reason({}), EndsWith("it is no thing of clca"));
  EXPECT_THAT(reason({'c', 'l', 'c', 'a'}), EndsWith("it is no thing of clca"));
  for (const std::size_t kept : {40U, 511U, 512U, 513U, 5000U}) {
    auto bytes = example();
    bytes.resize(kept);
    EXPECT_THAT(reason(bytes), EndsWith("it is cut off")) << kept;
  }
  for (std::size_t at = 0; at < example().size(); at += 97) {
    auto bytes = example();
    bytes[at] ^= 4U;
    EXPECT_NE(reason(bytes), "") << at;
  }
  auto longer = example();
  longer.push_back(0);
  EXPECT_THAT(reason(longer), HasSubstr("checksum is wrong"));
}

TEST_F(SealedFileTest, WhatNeedsMoreMemoryThanAllowedIsRefused) {
  const auto bytes = example();
  const auto size = static_cast<double>(bytes.size());
  EXPECT_THAT(reason(bytes, kKind, size), HasSubstr("more memory than the limit"));
  const SealedReader reader(put(bytes), kKind, 2 * size + 30'000);
  EXPECT_THROW(reader.read<double>("reals"), StoreError) << "40,000 bytes";
  EXPECT_EQ(reader.read_text("text"), "zwei\nZeilen");
}

TEST_F(SealedFileTest, WhatHasBeenReadBeforeCountsToo) {
  const auto bytes = example();
  const SealedReader reader(put(bytes), kKind, 2 * static_cast<double>(bytes.size()) + 60'000);
  EXPECT_NO_THROW(reader.read<double>("reals")) << "40,000 bytes";
  EXPECT_THROW(reader.read<double>("reals"), StoreError);
}

TEST_F(SealedFileTest, WhatIsAskedForInVainIsNamed) {
  const SealedReader reader(put(example()), kKind, kMuch);
  const auto why = [](const auto& ask) -> std::string {
    try {
      ask();
    } catch (const StoreError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(why([&] { reader.read<double>("group/none"); }), EndsWith("group/none is missing"));
  EXPECT_THAT(why([&] { reader.read<float>("reals"); }), EndsWith("reals holds other numbers"));
  EXPECT_THAT(why([&] { reader.read<double>("reals", 2); }), EndsWith("reals has 1 columns"));
  EXPECT_THAT(why([&] { reader.read_text("reals"); }), EndsWith("reals is no text"));
  EXPECT_THAT(why([&] { reader.read_text("names"); }), EndsWith("names is no single text"));
}

// By the tool that HDF5 brings, where it is at hand.
TEST_F(SealedFileTest, OtherReadersOfHdf5OpenIt) {
  const auto path = put(example());
  const std::string python =
      "/usr/bin/python3 -c 'import h5py, sys; f = h5py.File(sys.argv[1]); "
      "sys.exit(0 if f[\"group/inner/numbers\"][1, 2] == -6 and f[\"reals\"].shape == (5000,) and "
      "f[\"text\"][()].decode().startswith(\"zwei\") else 1)' ";
  EXPECT_EQ(std::system((python + path.string()).c_str()), 0);
}

}  // namespace
}  // namespace clca::store
