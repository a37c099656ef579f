#include "report/map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "unit/report/markup.hpp"

namespace clca::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(AMap, FindsTheSizeOfItsCells) {
  Map map;
  map.cells = {{.x = 1, .y = 1}, {.x = 3, .y = 1}, {.x = 7, .y = 6}, {.x = 3, .y = 11}};
  set_cell_size(map);
  EXPECT_EQ(map.cell_width, 2);
  EXPECT_EQ(map.cell_height, 5);
}

TEST(AMap, OfManyCellsIsDrawnWithFewerOfTheSameMean) {
  Map map;
  map.value_title = "packing";
  for (int x = 0; x < 200; ++x) {
    for (int y = 0; y < 200; ++y) {
      map.cells.push_back({.x = x + 0.5, .y = y + 0.5, .value = x < 100 ? 0.25 : 0.75});
    }
  }
  set_cell_size(map);
  const Map coarse = coarsened(map);
  EXPECT_LE(coarse.cells.size(), 4100U);
  const double sum = std::accumulate(coarse.cells.begin(), coarse.cells.end(), 0.0,
                                     [](double all, const Cell& cell) { return all + cell.value; });
  EXPECT_NEAR(sum / static_cast<double>(coarse.cells.size()), 0.5, 1e-9);
}

TEST(AMap, DrawsCellsArrowsAndLinesAndNoMoreThanIsThere) {
  Map map = {.title = "<m>", .value_title = "v", .arrow_title = "u", .line_title = "w"};
  map.cells = {{.x = 1, .y = 1, .value = 0.5, .dx = 1, .dy = 0},
               {.x = 2, .y = 1, .value = std::numeric_limits<double>::quiet_NaN()}};
  map.lines = {{0, 0, 2, 2, 3}};
  const std::string html = to_html(map);
  EXPECT_EQ(testing::markup_error(html), "");
  EXPECT_THAT(html, HasSubstr("<rect"));
  EXPECT_EQ(html.find("<rect"), html.rfind("<rect"));
  EXPECT_THAT(
      html, ::testing::AllOf(HasSubstr("class=\"arrows\" d=\"M"), HasSubstr("stroke-width=\"6.0\""),
                             Not(HasSubstr("nan")), Not(HasSubstr("<m>"))));
  EXPECT_EQ(to_html(Map()), "");
}

}  // namespace
}  // namespace clca::report
