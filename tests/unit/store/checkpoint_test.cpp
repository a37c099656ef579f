#include "clca/store/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "clca/store/file.hpp"
#include "store/checksum_header.hpp"
#include "support/runs.hpp"

namespace clca::store::checkpoint_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

constexpr double kMuch = 1e9;
constexpr FileKind kKind = {"checkpoint", 4};
constexpr std::size_t kMany = 200'000;  // more than a block

template <class T>
std::vector<T> numbers(std::size_t count) {
  std::vector<T> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<T>(static_cast<double>(i * i) / 3);
  }
  return values;
}

Checkpoint example() {
  return {.kind = "automaton",
          .scene_name = "silo",
          .scene_text = "clca: 1\n",
          .summary_json = std::string("{\0}", 3),
          .fields = {
              {"a/u8", numbers<std::uint8_t>(15)},
              {"a/u16", std::vector<std::uint16_t>{0, 1, 0xFFFF}},
              {"a/u32", std::vector<std::uint32_t>{0, 1, 0xFFFFFFFF}},
              {"a/u64", std::vector<std::uint64_t>{0, 1, ~std::uint64_t{0}}},
              {"a/i32", std::vector<std::int32_t>{0, -1, std::numeric_limits<int>::min()}},
              {"a/f64", std::vector<double>{0.1, -1e300, std::numeric_limits<double>::infinity()}},
              {"empty", std::vector<double>{}},
              {"many", numbers<double>(kMany)},
              {"same", std::vector<std::uint32_t>(kMany, 5)}}};
}

/// An entry by its parts, whatever they say.
struct Entry {
  std::uint8_t type = 1;
  std::string name = "name";
  std::uint64_t count = 0;
  std::uint64_t length = 0;
  Bytes data = {};

  Bytes bytes() const {
    Bytes result = {type};
    const auto put = [&](std::uint64_t number, int size) {
      for (int i = 0; i < size; ++i) {
        result.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
      }
    };
    put(name.size(), 2);
    put(count, 8);
    put(length, 8);
    result.insert(result.end(), name.begin(), name.end());
    result.insert(result.end(), data.begin(), data.end());
    return result;
  }
};

std::string reason(const Bytes& file, double max_bytes = kMuch) {
  try {
    parse_checkpoint(file, max_bytes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// The example with something behind it, under a right checksum.
Bytes with_more(const Bytes& more) {
  const Bytes whole = checkpoint_bytes(example());
  Bytes content(whole.begin() + kHeaderBytes, whole.end());
  content.insert(content.end(), more.begin(), more.end());
  return with_header(kKind, content);
}

TEST(Checkpoint, WhatIsWrittenIsReadAsItWas) {
  const Checkpoint read = parse_checkpoint(checkpoint_bytes(example()), kMuch);
  EXPECT_EQ(read.kind, "automaton");
  EXPECT_EQ(read.scene_name, "silo");
  EXPECT_EQ(read.scene_text, "clca: 1\n");
  EXPECT_EQ(read.summary_json, std::string("{\0}", 3));
  EXPECT_EQ(read.fields, example().fields);
}

TEST(Checkpoint, EqualOnesAreEqualBytes) {
  EXPECT_EQ(checkpoint_bytes(example()), checkpoint_bytes(example()));
}

TEST(Checkpoint, NumbersThatAreAlikeTakeLittleRoom) {
  Checkpoint checkpoint = example();
  checkpoint.fields = {{"same", std::vector<std::uint32_t>(kMany, 5)}};
  EXPECT_LT(checkpoint_bytes(checkpoint).size(), kMany / 40);
}

TEST(Checkpoint, IsRefusedWhereMemoryIsTooSmallForIt) {
  const Bytes file = checkpoint_bytes(example());
  const double need = static_cast<double>(file.size() + kMany * (8 + 4));
  EXPECT_THAT(reason(file, need), HasSubstr("more memory than the limit"));
  EXPECT_EQ(reason(file, need + 10'000), "");
}

TEST(Checkpoint, WhateverIsNotWholeIsRefused) {
  const Bytes whole = checkpoint_bytes(example());
  for (std::size_t kept : {0U, 100U, 511U, 512U, 600U}) {
    EXPECT_NE(reason(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept))), "");
  }
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 50) {
    Bytes changed = whole;
    changed[at] ^= 16U;
    EXPECT_NE(reason(changed), "") << at;
  }
}

TEST(Checkpoint, AnEntryThatLiesIsRefused) {
  const auto refusal = [](const Entry& entry) { return reason(with_more(entry.bytes())); };
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(refusal({}), "") << "nothing is wrong with it";
  EXPECT_EQ(refusal({.type = 8}), "an entry of an unknown type");
  EXPECT_EQ(refusal({.name = "many"}), "an entry that is there twice");
  EXPECT_EQ(refusal({.type = 0, .name = "kind"}), "an entry that is there twice");
  EXPECT_EQ(refusal({.type = 0, .name = "other"}), "a text of an unknown name");
  EXPECT_EQ(refusal({.length = 1}), "an entry goes beyond its end");
  EXPECT_EQ(refusal({.length = kMost}), "an entry goes beyond its end");
  EXPECT_EQ(refusal({.count = 1}), "an entry that is longer than its data can be");
  EXPECT_EQ(refusal({.count = kMost}), "an entry that is longer than its data can be");
  EXPECT_EQ(refusal({.count = 50'000, .length = 40, .data = Bytes(40, 0)}),
            "an entry that is longer than its data can be");
  EXPECT_EQ(refusal({.type = 6, .count = kMost / 8 + 1, .length = 3, .data = {1, 2, 3}}),
            "an entry that is longer than its data can be");
  EXPECT_EQ(refusal({.count = 3, .length = 3, .data = {1, 2, 3}}),
            "its compressed data is damaged");
  EXPECT_EQ(refusal({.count = 0, .length = 3, .data = {1, 2, 3}}),
            "its compressed data is damaged");
  EXPECT_EQ(reason(with_more({0})), "an entry goes beyond its end");
  EXPECT_EQ(reason(with_header(kKind, {})), "a text is missing");
}

TEST(Checkpoint, DataOfAnotherLengthIsRefused) {
  const Bytes whole = checkpoint_bytes(
      {.kind = "k", .scene_name = "", .scene_text = "", .summary_json = "", .fields = {}});
  const auto with_count = [&](std::uint8_t count) {
    Bytes content(whole.begin() + kHeaderBytes, whole.end());
    content[3] = count;  // of the first text
    return reason(with_header(kKind, content));
  };
  EXPECT_EQ(with_count(1), "");
  EXPECT_EQ(with_count(0), "its compressed data is damaged");
  EXPECT_EQ(with_count(2), "its compressed data is damaged");
}

}  // namespace
}  // namespace clca::store::checkpoint_test
