#include "clca/document/document.hpp"

#include <gtest/gtest.h>

namespace clca::document::document_test {

TEST(CanonicalValue, IsOneForAllFormsOfAValue) {
  for (const char* text : {"0.5", "0.50", "5e-1", "=1/2", " 0.5"}) {
    EXPECT_EQ(canonical_value(text), canonical_value("0.5")) << text;
  }
  EXPECT_EQ(canonical_value("[1,{a: 0.50}]"), canonical_value("[ 1.0, {a: 0.5} ]"));
  EXPECT_EQ(canonical_value("~"), canonical_value("null"));
  EXPECT_NE(canonical_value("'0.5'"), canonical_value("0.5"));
  EXPECT_NE(canonical_value("settled"), canonical_value("all"));
  EXPECT_EQ(canonical_value("=L0"), "=L0");
  EXPECT_EQ(canonical_value("[1"), "[1");
}

}  // namespace clca::document::document_test
