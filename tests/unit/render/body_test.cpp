#include "clca/render/body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>

namespace clca::render::body_test {
namespace {

using lattice::Axial;
using lattice::Shape;

/// Areas in small triangles.
int area_of(const Trapezoid& piece) {
  const int heights = piece.left_high.q - piece.left_low.q + piece.right_high.q - piece.right_low.q;
  return heights * (piece.right_low.x - piece.left_low.x);
}

int area_of(const std::vector<Trapezoid>& pieces) {
  int sum = 0;
  for (const Trapezoid& piece : pieces) {
    sum += area_of(piece);
  }
  return sum;
}

int area_of(const Outline& outline) {
  int area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Axial a = outline[i];
    const Axial b = outline[(i + 1) % outline.size()];
    area += a.x * b.q - b.x * a.q;
  }
  return area;
}

/// Weight of the particle at a point in axial coordinates, as the lookup shader counts it.
double weight_of(const Shape& shape, double x, double q) {
  const Axial cell = {static_cast<int>(std::floor(x)), static_cast<int>(std::floor(q))};
  const double right = x - cell.x;
  const double above = q - cell.q;
  const bool upper = right + above >= 1;
  const auto weight = [&](Axial corner, double share) {
    return shape.contains(cell + corner) ? share : 0;
  };
  if (upper) {
    return weight({1, 1}, right + above - 1) + weight({1, 0}, 1 - above) +
           weight({0, 1}, 1 - right);
  }
  return weight({0, 0}, 1 - right - above) + weight({1, 0}, right) + weight({0, 1}, above);
}

/// Number of small triangles that the particle owns by weight.
int area_by_weight(const Shape& shape) {
  int count = 0;
  constexpr int kReach = 24;  // small steps
  for (int x = -kReach; x <= kReach; ++x) {
    for (int q = -kReach; q <= kReach; ++q) {
      for (const double third : {1.0 / 3, 2.0 / 3}) {
        count += weight_of(shape, (x + third) / 2, (q + third) / 2) >= 0.5 ? 1 : 0;
      }
    }
  }
  return count;
}

std::vector<Shape> shapes() {
  constexpr std::array<Axial, 3> kTriangle = {{{0, 0}, {4, 0}, {0, 4}}};
  return {Shape::hexagon(0),
          Shape::hexagon(1),
          Shape::hexagon(3),
          Shape::rod(0, 4),
          Shape::rod(1, 5).rotated(1),
          Shape::polygon(kTriangle),
          Shape({{0, 0}, {1, 0}, {2, -1}, {2, -2}, {1, -2}}),
          Shape({{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}}),  // a ring with a gap
          Shape({{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 3}})};
}

/// Grown site by site; no holes.
Shape random_shape(std::mt19937& random, std::size_t size) {
  std::vector<Axial> sites = {{0, 0}};
  while (sites.size() < size) {
    const Axial from = sites[random() % sites.size()];
    std::vector<Axial> grown = sites;
    grown.push_back(from + lattice::unit(lattice::kDirections[random() % 6]));
    try {
      sites = Shape(grown).sites();
    } catch (const std::invalid_argument&) {
      continue;  // taken already, or it would close a ring
    }
  }
  return Shape(sites);
}

void expect_one_body(const Shape& shape) {
  const int area = area_by_weight(shape);
  EXPECT_EQ(area_of(outline(shape)), area);
  EXPECT_EQ(area_of(trapezoids(shape)), area);
}

TEST(Body, OwnsHalfOfTheWeightInOutlineAndFill) {
  for (const Shape& shape : shapes()) {
    expect_one_body(shape);
  }
}

TEST(Body, OwnsHalfOfTheWeightForRandomShapes) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    expect_one_body(random_shape(random, 1 + static_cast<std::size_t>(i) / 8));
  }
}

TEST(Body, OfAHexagonIsAHexagonHalfASpacingLarger) {
  for (int radius = 0; radius < 5; ++radius) {
    const Shape shape = Shape::hexagon(radius);
    const Outline line = outline(shape);
    EXPECT_EQ(line.size(), 6U);
    for (const Axial corner : line) {
      EXPECT_NEAR(position_from_halves(corner).norm(), radius + 0.5, 1e-12);
    }
    EXPECT_EQ(trapezoids(shape).size(), 2U);
    EXPECT_EQ(area_of(line), 6 * (2 * radius + 1) * (2 * radius + 1));
  }
}

TEST(Body, OfAnUprightRodHasSixCorners) {
  EXPECT_EQ(outline(Shape::rod(0, 5)).size(), 6U);
}

TEST(Body, HasCornersOf120Or240DegreesOnly) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const Outline line = outline(random_shape(random, 12));
    for (std::size_t k = 0; k < line.size(); ++k) {
      const Eigen::Vector2d in =
          position(line[k]) - position(line[(k + line.size() - 1) % line.size()]);
      const Eigen::Vector2d out = position(line[(k + 1) % line.size()]) - position(line[k]);
      EXPECT_NEAR(in.normalized().dot(out.normalized()), 0.5, 1e-12);
    }
  }
}

}  // namespace
}  // namespace clca::render::body_test
