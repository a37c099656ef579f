#include "report/chart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/axis.hpp"
#include "report/decimate.hpp"
#include "unit/report/markup.hpp"

namespace clca::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> texts;
  for (const double tick : axis.ticks()) {
    texts.push_back(axis.label(tick));
  }
  return texts;
}

Chart chart_of(std::vector<double> x, std::vector<double> y) {
  Curve curve;
  curve.name = "a";
  curve.x = std::move(x);
  curve.y = std::move(y);
  Chart chart;
  chart.title = "t";
  chart.curves = {curve};
  return chart;
}

TEST(AnAxis, HasRoundTicks) {
  EXPECT_THAT(labels(Axis::linear(0, 1, true)),
              ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_THAT(labels(Axis::linear(-0.013, 0.057, true)),
              ElementsAre("−0.02", "0.00", "0.02", "0.04", "0.06"));
  EXPECT_THAT(labels(Axis::linear(3, 540, false)), ElementsAre("100", "200", "300", "400", "500"));
  EXPECT_THAT(labels(Axis::logarithmic(2e-4, 3)),
              ElementsAre("10⁻⁴", "10⁻³", "0.01", "0.1", "1", "10"));
}

TEST(AnAxis, WritesLargeAndSmallNumbersWithAPowerApart) {
  const Axis large = Axis::linear(0, 4e9, true);
  EXPECT_EQ(large.exponent(), 9);
  EXPECT_THAT(labels(large), ElementsAre("0", "1", "2", "3", "4"));
  EXPECT_EQ(Axis::linear(0, 3e-5, true).exponent(), -5);
}

TEST(AnAxis, IsSoundWhateverItSpans) {
  for (const auto& [low, high] :
       {std::pair(0.0, 0.0), std::pair(5.0, 5.0), std::pair(-1e308, 1e308),
        std::pair(1e-320, 1e-310), std::pair(1.0, 1 + 1e-15)}) {
    const Axis axis = Axis::linear(low, high, true);
    EXPECT_LT(axis.low(), axis.high());
    EXPECT_THAT(axis.ticks().size(), ::testing::AllOf(::testing::Ge(1U), ::testing::Le(13U)));
    EXPECT_TRUE(std::isfinite(axis.part(low)));
  }
  EXPECT_LE(Axis::logarithmic(1e-320, 1e308).ticks().size(), 8U);
}

TEST(KeptRows, AreBoundedAndLoseNoPeak) {
  std::vector<double> y(1'000'000, 0.5);
  y[123'456] = 7;
  y[765'432] = -7;
  y[500'000] = kNothing;
  const auto rows = kept_rows(y, 1000);
  EXPECT_LE(rows.size(), 1000U);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  for (const std::size_t row : {0UL, 123'456UL, 500'000UL, 765'432UL, 999'999UL}) {
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), row)) << row;
  }
}

TEST(KeptRows, AreAllWhereThereAreFew) {
  EXPECT_THAT(kept_rows({1, kNothing, 3}, 1000), ElementsAre(0, 1, 2));
  EXPECT_THAT(kept_rows({}, 1000), ElementsAre());
}

TEST(AChart, LeavesAGapWhereThereIsNoValue) {
  const std::string html = to_html(chart_of({0, 1, 2, 3}, {1, 2, kNothing, 4}), 1);
  EXPECT_EQ(testing::markup_error(html), "");
  const std::size_t path = html.find(R"(class="curve" d="M64.0)");
  ASSERT_NE(path, std::string::npos);
  const std::string line = html.substr(path, html.find('>', path) - path);
  EXPECT_EQ(std::count(line.begin(), line.end(), 'M'), 2) << line;
  EXPECT_EQ(std::count(line.begin(), line.end(), 'L'), 1) << line;
  EXPECT_THAT(html, Not(HasSubstr("nan")));
}

TEST(AChart, LeavesOutWhatItsAxisCannotShow) {
  Chart chart = chart_of({0, 1, 2}, {0, -1, std::numeric_limits<double>::infinity()});
  EXPECT_TRUE(is_drawable(chart));
  chart.is_logarithmic = true;
  EXPECT_FALSE(is_drawable(chart));
  EXPECT_FALSE(is_drawable(chart_of({0, 1}, {kNothing, kNothing})));
  EXPECT_FALSE(is_drawable(chart_of({}, {})));
}

TEST(AChart, EscapesItsTexts) {
  Chart chart = chart_of({0, 1}, {1, 2});
  chart.title = "<b>";
  chart.x_title = "\"'<i>";
  chart.curves[0].name = "</ul><script>";
  const std::string html = to_html(chart, 1);
  EXPECT_EQ(testing::markup_error(html), "");
  EXPECT_THAT(html,
              ::testing::AllOf(Not(HasSubstr("<b>")), Not(HasSubstr("<i>")), HasSubstr("&lt;/ul")));
}

TEST(AChart, WithManyCurvesGivesEachAColour) {
  Chart chart;
  for (int i = 0; i < 12; ++i) {
    chart.curves.push_back(chart_of({0, 1}, {1.0 * i, 2}).curves[0]);
  }
  const std::string html = to_html(chart, 1);
  EXPECT_EQ(testing::markup_error(html), "");
  EXPECT_THAT(html, ::testing::AllOf(HasSubstr("hsl(255 "), HasSubstr("hsl(10 ")));
}

}  // namespace
}  // namespace clca::report
