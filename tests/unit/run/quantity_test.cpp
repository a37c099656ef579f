#include "clca/run/quantity.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace clca::run::quantity_test {
namespace {

using ::testing::HasSubstr;

TEST(Quantity, TheTableOfTheDocumentationIsThatOfTheDeclarations) {
  const std::ifstream file(std::filesystem::path(CLCA_SOURCE_DIR) / "docs" / "scene-format.md");
  std::ostringstream page;
  page << file.rdbuf();
  EXPECT_THAT(page.str(), HasSubstr("<!-- quantities -->\n" + quantities_table() +
                                    "<!-- end of quantities -->\n"))
      << "call scripts/update-format";
}

TEST(Quantity, IsFoundByItsKeyAlsoOfOneOutlet) {
  ASSERT_NE(find_quantity("runout_99"), nullptr);
  EXPECT_EQ(find_quantity("runout_99")->unit, "spacings");
  EXPECT_EQ(find_quantity("clogged.drain"), find_quantity("clogged"));
  EXPECT_EQ(find_quantity("travel.plate")->unit, "sites");
  EXPECT_EQ(find_quantity("runout_9"), nullptr);
}

TEST(Quantity, OfAGasMayHaveTheKeyOfOneOfGrains) {
  EXPECT_EQ(find_gas_quantity("t_tr")->name, "Translational temperature");
  EXPECT_EQ(find_quantity("t_tr"), nullptr);
  EXPECT_NE(find_quantity("time")->unit, find_gas_quantity("time")->unit);
}

TEST(Quantity, HasTheUnitsOfARun) {
  const scene::Conversion units = {.length_unit = "m", .time_unit = "s", .velocity_unit = "m/s"};
  EXPECT_EQ(shown_unit("sites/time", units), "sites/s");
  EXPECT_EQ(shown_unit("(spacings/step)²", units), "(m/s)²");
  EXPECT_EQ(shown_unit("sites/time", {}), "sites/time");
}

}  // namespace
}  // namespace clca::run::quantity_test
