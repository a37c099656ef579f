#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "clca/store/file.hpp"
#include "clca/store/table.hpp"
#include "support/runs.hpp"

namespace clca::store::read_table_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ReadTableTest : public ::testing::Test {
 protected:
  ParsedTable read(std::string_view text) const {
    write_whole_file(file_, text);
    return read_table(file_);
  }
  void expect_refused(std::string_view text, const std::string& reason) const {
    EXPECT_THAT([&] { read(text); }, ::testing::ThrowsMessage<StoreError>(
                                         "cannot read " + file_.string() + ": " + reason))
        << text;
  }

  testing::ScratchFolder folder_;
  std::filesystem::path file_ = folder_.path() / "table.csv";
};

TEST_F(ReadTableTest, GivesBackWhatWasWritten) {
  Table table({"step", "a,\"b\"", "value"});
  table.add_row({std::uint64_t{3}, std::string("\"x\", \n\"\"y"), 0.1 + 0.2});
  table.add_row({std::uint64_t{4}, std::string("\""), std::nan("")});
  const ParsedTable back = read(table.to_csv());
  EXPECT_THAT(back.column_names, ElementsAre("step", "a,\"b\"", "value"));
  EXPECT_THAT(*back.find_column("a,\"b\""), ElementsAre("\"x\", \n\"\"y", "\""));
  EXPECT_THAT(back.column_numbers("step"), ElementsAre(3, 4));
  EXPECT_EQ(back.column_numbers("value")[0], 0.1 + 0.2);
  EXPECT_TRUE(std::isnan(back.column_numbers("value")[1]));
}

TEST_F(ReadTableTest, ATableMayHaveNoRows) {
  const ParsedTable table = read("a,b\n");
  EXPECT_EQ(table.row_count(), 0U);
  EXPECT_THAT(table.column_numbers("b"), ElementsAre());
}

TEST_F(ReadTableTest, WhatTableDoesNotWriteIsAnErrorWithItsLine) {
  expect_refused("", "line 1: the file is cut off");
  expect_refused("a,b\n1,2", "line 2: the file is cut off");
  expect_refused("a,b\n1\n", "line 2: 1 cells in 2 columns");
  expect_refused("a,b\n1,2\n1,2,3\n", "line 3: 3 cells in 2 columns");
  expect_refused("a,b\n\n", "line 2: 1 cells in 2 columns");
  expect_refused("a,b\r\n1,2\r\n", "line 1: a quote or carriage return out of place");
  expect_refused("a,b\n1,2\"\n", "line 2: a quote or carriage return out of place");
  expect_refused("a,b\n1,\"2\"3\n", "line 2: a character after a closing quote");
  expect_refused("a,b\n1,\"2\n", "line 2: a quote is not closed");
  expect_refused("a,a\n", "line 1: the name 'a' of a column is empty or there twice");
  expect_refused("a,\n", "line 1: the name '' of a column is empty or there twice");
}

TEST_F(ReadTableTest, TextWhereANumberShouldStandIsAnErrorWithItsLine) {
  const ParsedTable table = read("a,b\n1,2\n3,4x\n");
  EXPECT_THAT(
      [&] { table.column_numbers("b"); },
      ::testing::ThrowsMessage<StoreError>(HasSubstr("line 3: '4x' in column 'b' is no number")));
  EXPECT_THAT([&] { table.column_numbers("c"); },
              ::testing::ThrowsMessage<StoreError>(HasSubstr("no column 'c'")));
}

}  // namespace
}  // namespace clca::store::read_table_test
