#include "clca/text/read.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/runs.hpp"

namespace clca::text::read_test {
namespace {

namespace fs = std::filesystem;

class ReadFile : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }

  /// Why it cannot be read.
  static std::string reason(const fs::path& file, double max_bytes = 100) {
    try {
      read_file(file, max_bytes);
    } catch (const ReadError& error) {
      return error.what();
    }
    return "read";
  }

  testing::ScratchFolder folder_;
};

TEST_F(ReadFile, IsAllOfItUpToTheLimit) {
  std::ofstream(path("a")) << std::string(100'000, 'x');
  EXPECT_EQ(read_file(path("a"), 100'000), std::vector<std::uint8_t>(100'000, 'x'));
  EXPECT_EQ(reason(path("a"), 99'999), "it is larger than the limit of 0.09537 MiB");
}

TEST_F(ReadFile, AFileMayHaveNoEndAlthoughItSaysThatItIsEmpty) {
  EXPECT_EQ(fs::file_size("/proc/self/maps"), 0U);
  EXPECT_EQ(reason("/proc/self/maps"), "it is larger than the limit of 9.537e-05 MiB");
}

TEST_F(ReadFile, WhatIsNoRegularFileIsRefusedAtOnce) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", path("link"));
  for (const fs::path& file : {path("pipe"), path("link"), fs::path("/dev/zero")}) {
    EXPECT_EQ(reason(file), "it is not a regular file") << file;
  }
  EXPECT_EQ(reason(folder_.path()), "it is a folder");
}

TEST_F(ReadFile, TheReasonIsThatOfTheSystem) {
  EXPECT_EQ(reason(path("none")), "No such file or directory");
  std::ofstream(path("a")) << "x";
  EXPECT_EQ(reason(path("a") / "b"), "Not a directory");
  fs::create_symlink("loop", path("loop"));
  EXPECT_EQ(reason(path("loop")), "Too many levels of symbolic links");
}

}  // namespace
}  // namespace clca::text::read_test
