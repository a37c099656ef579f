// Masses and normals of grains that touch.

#include <gtest/gtest.h>

#include <cmath>

#include "contact/rule/law.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact::pair_coefficients_test {
namespace {

using lattice::Axial;
using lattice::Direction;
using lattice::Shape;

Axial times(int factor, Axial vector) {
  return {factor * vector.x, factor * vector.q};
}

bool overlap(const Shape& one, const Shape& other, Axial apart) {
  for (const Axial site : other.sites()) {
    if (one.contains(site + apart)) {
      return true;
    }
  }
  return false;
}

/// Whether a site of one lies beside a site of the other.
bool are_neighbours(const Shape& one, const Shape& other, Axial apart) {
  for (const Axial site : other.sites()) {
    for (const Direction direction : lattice::kDirections) {
      if (one.contains(site + apart + unit(direction))) {
        return true;
      }
    }
  }
  return false;
}

template <class Visit>
void for_each_place(int reach, Visit visit) {
  for (int x = -reach; x <= reach; ++x) {
    for (int q = -reach; q <= reach; ++q) {
      visit(Axial{x, q});
    }
  }
}

TEST(Hexagons, TouchExactlyWhereTheyAreNeighboursAndAlongTheLineOfTheirCentres) {
  for (const int first : {0, 1, 3}) {
    for (const int second : {0, 2}) {
      const Shape one = Shape::hexagon(first);
      const Shape other = Shape::hexagon(second);
      for_each_place(7, [&](Axial apart) {
        if (overlap(one, other, apart)) {
          return;
        }
        const auto normal = normal_between(one, other, apart);
        ASSERT_EQ(normal.has_value(), are_neighbours(one, other, apart));
        if (normal) {
          const Eigen::Vector2d along = -position(apart).normalized();
          EXPECT_NEAR(std::ldexp(normal->x, -kUnitBits), along.x(), 0x1p-29);
          EXPECT_NEAR(std::ldexp(normal->y, -kUnitBits), along.y(), 0x1p-29);
          const auto back = normal_between(other, one, Axial() - apart);
          EXPECT_EQ(*back, (UnitVector{-normal->x, -normal->y}));
        }
      });
    }
  }
}

TEST(OtherGrains, TouchAgainstTheDirectionsThatAreBlocked) {
  const Shape upright = Shape::rod(0, 4);
  const Shape point = Shape::hexagon(0);
  const auto normal = normal_between(upright, point, {1, 1});
  // Up right and down right are blocked, by a site beside the middle of the rod.
  ASSERT_TRUE(normal);
  EXPECT_EQ(*normal, (UnitVector{-(1 << kUnitBits), 0}));
  const auto below = normal_between(upright, point, {0, -1});
  ASSERT_TRUE(below);
  EXPECT_EQ(*below, (UnitVector{0, 1 << kUnitBits}));
  EXPECT_FALSE(normal_between(upright, point, {2, 0}));
}

TEST(OtherGrains, ThatHoldEachOtherFromBothSidesHaveNoNormal) {
  const Shape fork = Shape({{0, 0}, {0, 1}, {0, 2}, {1, -1}, {2, -1}, {2, 0}, {2, 1}});
  const Shape tooth = Shape::rod(0, 2);
  int held = 0;
  for_each_place(4, [&](Axial apart) {
    if (!overlap(fork, tooth, apart)) {
      const auto normal = normal_between(fork, tooth, apart);
      EXPECT_TRUE(!normal || are_neighbours(fork, tooth, apart));
      held += !normal && are_neighbours(fork, tooth, apart) ? 1 : 0;
    }
  });
  EXPECT_GT(held, 0) << "a tooth between the prongs";
}

TEST(ANormalTable, SaysWhatTheShapesSay) {
  const std::vector<grains::Kind> kinds = {{Shape::hexagon(1), 0},
                                           {Shape::rod(0, 3).rotated(1), 1},
                                           {Shape({{0, 0}, {1, 0}, {1, 1}}), 2}};
  NormalTable table(kinds);
  for (int again = 0; again < 2; ++again) {
    for (std::uint16_t one = 0; one < kinds.size(); ++one) {
      for (std::uint16_t other = 0; other < kinds.size(); ++other) {
        for_each_place(9, [&](Axial apart) {
          EXPECT_EQ(
              table.normal(one, other, apart),
              normal_between(kinds[one].shape, kinds[other].shape, apart).value_or(UnitVector()));
        });
      }
    }
  }
}

TEST(OnlyHexagons, AboutTheirReferenceSiteAreHexagons) {
  EXPECT_TRUE(Shape::hexagon(0).is_hexagon());
  EXPECT_TRUE(Shape::hexagon(6).is_hexagon());
  EXPECT_TRUE(Shape::disc(2).is_hexagon());
  EXPECT_FALSE(Shape::disc(6.3).is_hexagon());
  EXPECT_FALSE(Shape::rod(0, 7).is_hexagon());
  std::vector<Axial> shifted = Shape::hexagon(1).sites();
  for (Axial& site : shifted) {
    site = site + times(1, unit(Direction::up));
  }
  EXPECT_FALSE(Shape(shifted).is_hexagon());
}

TEST(RoundShapes, AreHexagonsAndDiscsAboutTheirReferenceSite) {
  for (const double radius : {0.0, 1.0, 1.75, 2.7, 3.5, 20.0}) {
    EXPECT_TRUE(Shape::disc(radius).is_disc()) << radius;
  }
  EXPECT_TRUE(Shape::hexagon(6).is_disc()) << "the next row is 6.06 away";
  EXPECT_FALSE(Shape::hexagon(7).is_disc());
  EXPECT_TRUE(Shape::hexagon(7).is_round());
  EXPECT_FALSE(Shape::rod(0, 7).is_round());
  EXPECT_FALSE(Shape::rod(3, 2).is_round());
  std::vector<Axial> notched = Shape::disc(3.5).sites();
  notched.pop_back();
  EXPECT_FALSE(Shape(notched).is_round());
}

TEST(Discs, TouchAlongTheLineOfTheirCentres) {
  const Shape disc = Shape::disc(2.7);
  for_each_place(7, [&](Axial apart) {
    if (const auto normal = normal_between(disc, disc, apart)) {
      const UnitVector line = unit_vector(Axial() - apart);
      EXPECT_EQ(normal->x, line.x);
      EXPECT_EQ(normal->y, line.y);
    }
  });
}

TEST(ReducedMasses, AreThoseOfTheTwoOrOfTheGrainAloneAtAWall) {
  const std::vector<grains::Kind> kinds = {{Shape::hexagon(1), 0}, {Shape::hexagon(2), 1}};
  const std::vector<PairCoefficients> pairs = all_pair_coefficients(kinds);
  const PairCoefficients& both = pairs[1];
  const PairCoefficients& larger_at_wall = pairs[5];
  const double unit = mass_unit(kinds);
  const double reduced = 7.0 * 19 / (7 + 19) / unit;
  const auto mass = [](std::int32_t value) { return std::ldexp(value, -kMassBits); };
  EXPECT_NEAR(mass(both.mass), reduced, 0x1p-11);
  EXPECT_NEAR(mass(both.shear_mass), reduced * 2 / 7, 0x1p-11);
  EXPECT_NEAR(mass(larger_at_wall.mass), 19 / unit, 0x1p-11);
  EXPECT_EQ(larger_at_wall.other_inverse_mass, 0);
  EXPECT_EQ(larger_at_wall.other_rolling_response, 0);
  EXPECT_NEAR(std::ldexp(both.other_inverse_mass, -kInverseMassBits), unit / 19,
              std::ldexp(0.5, -kInverseMassBits));
}

}  // namespace
}  // namespace clca::contact::pair_coefficients_test
