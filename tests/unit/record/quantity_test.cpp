#include "clca/record/quantity.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "clca/text/read.hpp"

namespace clca::record::quantity_test {
namespace {

using Kind = KnownQuantities::Kind;

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string page(const char* name) {
  const std::ifstream file(std::filesystem::path(CLCA_SOURCE_DIR) / "docs" / name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Quantity, TheTableOfTheDocumentationIsThatOfTheDeclarations) {
  EXPECT_THAT(page("scene-format.md"), HasSubstr("<!-- quantities -->\n" + quantities_markdown() +
                                                 "<!-- end of quantities -->\n"))
      << "call scripts/update-format";
}

TEST(Quantity, TheDocumentsHaveTheColumnsOfEachTable) {
  const std::string documents =
      page("scene-format.md") + page("boltzmann.md") + page("sweep.md") + page("trajectory.md");
  for (const std::string& table : table_names()) {
    EXPECT_THAT(documents, HasSubstr("<!-- columns: " + table + " -->\n" + columns_markdown(table) +
                                     "<!-- end of columns -->\n"))
        << "call scripts/update-format; a new table needs a place in one of them first";
  }
}

TEST(Quantity, ATableThatThereIsNotIsRefusedWithTheNamesOfAll) {
  EXPECT_THAT([] { columns_markdown("serie"); },
              ::testing::ThrowsMessage<text::InputError>(AllOf(
                  HasSubstr("no table 'serie'"), HasSubstr("series, "), HasSubstr("profile"))));
}

TEST(Quantity, OfAVectorOrAMeanHasTwoColumns) {
  EXPECT_EQ(find_quantity("vx"), find_quantity("vy"));
  EXPECT_EQ(find_quantity("flux_se")->unit, "sites/(step·spacing)");
  EXPECT_THAT(columns_markdown("lines"), HasSubstr("| `flux` (`_se`) |"));
}

TEST(Quantity, IsFoundByItsKeyAlsoOfOneOutlet) {
  ASSERT_NE(find_quantity("runout_99"), nullptr);
  EXPECT_EQ(find_quantity("runout_99")->unit, "spacings");
  EXPECT_EQ(find_quantity("clogged.drain"), find_quantity("clogged"));
  EXPECT_EQ(find_quantity("travel.plate")->unit, "sites");
  EXPECT_EQ(find_quantity("force_x.floor")->unit, "weights of a site");
  EXPECT_EQ(find_quantity("force_x")->unit, "grain weights") << "of walls-STAGE.csv";
  EXPECT_EQ(find_quantity("runout_9"), nullptr);
}

TEST(Quantity, OfAGasMayHaveTheKeyOfOneOfGrains) {
  EXPECT_EQ(find_quantity("t_tr", Kind::gas)->name, "Translational temperature");
  EXPECT_EQ(find_quantity("t_tr"), nullptr);
  EXPECT_NE(find_quantity("time")->unit, find_quantity("time", Kind::gas)->unit);
}

TEST(Quantity, OfASweepHasTheMeasuresOfStagesAndColumnsOfItsOwn) {
  EXPECT_EQ(find_quantity("time", Kind::sweep)->meaning, "of the stage");
  EXPECT_EQ(find_quantity("time")->meaning, "of the whole run");
  EXPECT_EQ(find_quantity("discharged_until_clog.drain", Kind::sweep)->unit, "particles");
  EXPECT_EQ(find_quantity("standard_error", Kind::sweep)->name, "Standard error");
  EXPECT_EQ(find_quantity("standard_error"), nullptr);
  EXPECT_EQ(find_quantity("runout_99", Kind::sweep), find_quantity("runout_99"));
}

TEST(Quantity, HasTheUnitsOfARun) {
  const scene::UnitConversion units = {
      .length_unit = "m", .time_unit = "s", .velocity_unit = "m/s"};
  EXPECT_EQ(shown_unit("sites/time", units), "sites/s");
  EXPECT_EQ(shown_unit("(spacings/step)²", units), "(m/s)²");
  EXPECT_EQ(shown_unit("sites/time", {}), "sites/time");
}

TEST(Quantities, OfASweepSayWhereTheUnitsOfItsRunsDiffer) {
  const KnownQuantities with_units = {
      .kind = Kind::sweep,
      .units = scene::UnitConversion{.length_unit = "m", .time_unit = "s", .velocity_unit = "m/s"}};
  const auto units = [&](const std::vector<KnownQuantities>& known) {
    std::vector<std::string> found;
    for (const auto& column :
         sweep_column_summaries("runs", {"flow.fluctuation_energy", "flow.time"}, known)) {
      found.push_back(column.unit);
    }
    return found;
  };
  EXPECT_THAT(units({with_units}), ::testing::ElementsAre("(m/s)²", "s"));
  EXPECT_THAT(units({with_units, {.kind = Kind::sweep}}),
              ::testing::ElementsAre("units differ", "s"))
      << "runs without units have no time";
}

}  // namespace
}  // namespace clca::record::quantity_test
