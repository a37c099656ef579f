// Saving, loading, comparing and hashing by lists of fields.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clca/boltzmann/gas.hpp"
#include "clca/grains/state.hpp"
#include "clca/reflection/columns.hpp"
#include "clca/reflection/hash.hpp"

namespace clca::reflection::reflection_test {
namespace {

using ::testing::ElementsAre;

constexpr double kMuch = 1e6;

enum class Colour : std::uint8_t { red, green };

struct Inner {
  std::int32_t number = 0;
  std::optional<double> perhaps = {};

  bool operator==(const Inner&) const = default;
  CLCA_FIELDS(number, perhaps);
};

struct Outer {
  bool yes = false;
  Colour colour = Colour::red;
  std::string text = {};
  std::vector<Inner> inner = {};
  std::vector<std::vector<std::uint16_t>> lists = {};
  std::array<double, 2> pair = {};
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  std::map<std::pair<std::uint32_t, std::int32_t>, Inner> map = {};
  int not_listed = 7;

  bool operator==(const Outer&) const = default;
  CLCA_FIELDS(yes, colour, text, inner, lists, pair, point, map);
};

Outer example() {
  Outer outer = {.yes = true,
                 .colour = Colour::green,
                 .text = "zwei\n",
                 .inner = {{1, 0.5}, {-2, {}}, {3, -1.0}},
                 .lists = {{1, 2}, {}, {3}},
                 .pair = {0.25, 4},
                 .point = {1, -1}};
  outer.map[{4, -3}] = {9, 1.5};
  outer.map[{4, 2}] = {8, {}};
  return outer;
}

std::string mismatch(const Columns& columns, double max_bytes = kMuch) {
  try {
    Outer outer;
    decode(columns, max_bytes, outer);
  } catch (const ColumnMismatch& error) {
    return error.what();
  }
  return "";
}

template <class T>
Columns with(const std::string& path, std::vector<T> column) {
  Columns columns = encode(example());
  columns[path] = std::move(column);
  return columns;
}

TEST(Fields, WhatIsEncodedIsDecoded) {
  Outer decoded = {.text = "old", .inner = {{5, 5.0}}};
  decode(encode(example()), kMuch, decoded);
  EXPECT_EQ(decoded, example());
}

TEST(Fields, AreColumnsByTheirNames) {
  const Columns columns = encode(example());
  EXPECT_THAT(std::get<std::vector<std::int32_t>>(columns.at("inner/number")),
              ElementsAre(1, -2, 3));
  EXPECT_THAT(std::get<std::vector<std::uint64_t>>(columns.at("inner/perhaps/size")),
              ElementsAre(1, 0, 1));
  EXPECT_THAT(std::get<std::vector<double>>(columns.at("inner/perhaps/values")),
              ElementsAre(0.5, -1));
  EXPECT_THAT(std::get<std::vector<std::uint16_t>>(columns.at("lists/each/values")),
              ElementsAre(1, 2, 3));
  EXPECT_THAT(std::get<std::vector<std::int32_t>>(columns.at("map/first/second")),
              ElementsAre(-3, 2));
  EXPECT_FALSE(columns.contains("not_listed"));
}

TEST(Fields, ThatAreNotListedStay) {
  Outer decoded = {.not_listed = 3};
  decode(encode(example()), kMuch, decoded);
  EXPECT_EQ(decoded.not_listed, 3);
}

TEST(Fields, ThatDoNotBelongAreRefusedByName) {
  Columns missing = encode(example());
  missing.erase("inner/number");
  EXPECT_EQ(mismatch(missing), "inner/number is missing");
  EXPECT_EQ(mismatch(with("yes", std::vector<std::uint8_t>{2})), "yes is neither yes nor no");
  EXPECT_EQ(mismatch(with("yes", std::vector<double>{1})), "yes holds other numbers");
  EXPECT_EQ(mismatch(with("inner/number", std::vector<std::int32_t>{1})),
            "inner/number is too long or too short");
  EXPECT_EQ(mismatch(with("inner/perhaps/size", std::vector<std::uint64_t>{1, 2, 0})),
            "inner/perhaps is there more than once");
  EXPECT_EQ(mismatch(with("map/first/second", std::vector<std::int32_t>{2, 2})),
            "map has a key twice");
  EXPECT_EQ(mismatch(with("lists/size", std::vector<std::uint64_t>{~std::uint64_t{0} / 2})),
            "lists needs more memory than the limit");
  EXPECT_EQ(mismatch(encode(example()), 100), "inner needs more memory than the limit");
}

// Of a state, every field: what is changed is found, saved and hashed.
TEST(Fields, OfAStateAreHashedEachOne) {
  grains::State state{.lattice = lattice::Lattice(4, 4, false)};
  state.particles.resize(2);
  state.origins.resize(2);
  state.walls.resize(1);
  state.sources.resize(1);
  state.outlets.resize(1);
  state.pushes.resize(1);
  const Columns columns = encode(state);
  std::size_t changed = 0;
  for (const auto& [path, column] : columns) {
    Columns other = columns;
    const bool has_numbers = std::visit(
        [](auto& values) {
          if (!values.empty()) {
            values.front() = values.front() == 0 ? 1 : 0;
          }
          return !values.empty();
        },
        other[path]);
    if (!has_numbers || path.ends_with("size")) {
      continue;
    }
    grains::State loaded = state;
    decode(other, kMuch, loaded);
    EXPECT_NE(grains::hash(loaded), grains::hash(state)) << path;
    EXPECT_TRUE(encode(loaded) == other) << path;
    ++changed;
  }
  EXPECT_GT(changed, 20U);
}

TEST(Fields, OfAGasAreItsWholeState) {
  const boltzmann::Gas gas = boltzmann::make_gas({.particle_count = 50}, 4);
  boltzmann::Gas decoded;
  decode(encode(gas), kMuch, decoded);
  EXPECT_EQ(boltzmann::hash(decoded), boltzmann::hash(gas));
  EXPECT_TRUE((decoded.motions == gas.motions).all());
}

}  // namespace
}  // namespace clca::reflection::reflection_test
