#include <gtest/gtest.h>

#include <string>

#include "clca/text/read.hpp"

namespace clca::text::name_test {
namespace {

TEST(FileName, IsOneComponentOfAPathThatEndingsFitBehind) {
  for (const std::string& name :
       {std::string("a"), std::string("silo-collapse"), std::string("a b"), std::string("-x"),
        std::string("höhe"), std::string(200, 'a')}) {
    EXPECT_TRUE(is_file_name(name)) << name;
  }
}

TEST(FileName, LeadsNowhereElse) {
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string(".hidden"),
        std::string("a/b"), std::string("../a"), std::string("/a"), std::string("a\nb"),
        std::string("a\033[2J"), std::string("a\177"), std::string("a\0b", 3),
        std::string(201, 'a')}) {
    EXPECT_FALSE(is_file_name(name)) << name;
  }
}

}  // namespace
}  // namespace clca::text::name_test
