#include <gtest/gtest.h>

#include "clca/document/document.hpp"

namespace clca::document::expression_test {

TEST(Expression, HasAValueWhereAllThatItNamesHasOneAndItIsFinite) {
  const auto values = [](std::string_view name) -> std::optional<double> {
    return name == "a" ? std::optional(-3.0) : name == "b.c" ? std::optional(0.1) : std::nullopt;
  };
  EXPECT_EQ(expression_value("=a^2 + 2*b.c", values), 9.2);
  EXPECT_EQ(expression_value("=sqrt(abs(a)*3)*_pi/_pi", values), 3);
  EXPECT_EQ(expression_value("=a > 0 ? 1 : 2", values), 2);
  EXPECT_EQ(expression_value("=a/(b.c - b.c)", values), std::nullopt);
  EXPECT_EQ(expression_value("=sqrt(a)", values), std::nullopt);
  EXPECT_EQ(expression_value("=a + d", values), std::nullopt);
}

TEST(Expression, HasNamesThatAreNoFunctionsAndNoConstants) {
  EXPECT_EQ(names_in("=max(a, b.c) + 1.5e-3*a + _pi"), (std::vector<std::string>{"a", "b.c", "a"}));
}

}  // namespace clca::document::expression_test
