// What users read of the format comes from the declarations of its keys.

#include "clca/scene/format.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace clca::scene::format_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// What stands between the first `begin` and the `end` after it; moves `place` behind.
std::string between(const std::string& text, const std::string& begin, const std::string& end,
                    std::size_t& place) {
  const std::size_t start = text.find(begin, place);
  if (start == std::string::npos) {
    place = start;
    return {};
  }
  const std::size_t stop = text.find(end, start);
  place = stop;
  return text.substr(start + begin.size(), stop - start - begin.size());
}

TEST(Format, TheTablesOfTheDocumentationAreThoseOfTheDeclarations) {
  const std::string page =
      text_of(std::filesystem::path(CLCA_SOURCE_DIR) / "docs" / "scene-format.md");
  int tables = 0;
  for (std::size_t place = 0; place != std::string::npos;) {
    const std::string keys = between(page, "<!-- keys:", "-->\n", place);
    if (place == std::string::npos) {
      break;
    }
    std::istringstream words(keys);
    std::vector<std::string> paths{std::istream_iterator<std::string>(words), {}};
    if (paths.empty()) {
      paths.emplace_back("");
    }
    EXPECT_EQ(between(page, "-->\n", "<!-- end of keys -->", place), markdown_table(paths))
        << "call scripts/update-format";
    ++tables;
  }
  EXPECT_GE(tables, 20);
}

TEST(Format, ATableOfSeveralMapsHasTheirPaths) {
  const std::string inside = markdown_table({"walls", "walls.disc"});
  EXPECT_THAT(inside, HasSubstr("\n| `disc.radius` |"));
  const std::string beside = markdown_table({"output.frames", "box"});
  EXPECT_THAT(beside, HasSubstr("\n| `width` | 16 to 65536 |"));
  EXPECT_THAT(beside, HasSubstr("\n| `box.width` | 1 to 866025 |"));
}

TEST(Format, ExplainsAKey) {
  EXPECT_EQ(explanation("rules.inertia"),
            "rules.inertia: probability to keep the direction of the last step, if free\n"
            "  0 to 1; default: 0.9\n");
  EXPECT_EQ(explanation("box.width"),
            "box.width: width; columns stand 0.866 apart\n  1 to 866025; required\n");
  EXPECT_THAT(explanation("contact.rolling"),
              EndsWith("none, resistance, free; default: resistance\n"));
}

TEST(Format, ExplainsAKeyByItsNameWhereverItIs) {
  EXPECT_EQ(explanation("inertia"),
            explanation("rules.inertia") + "\n" + explanation("stages.rules.inertia"));
  EXPECT_EQ(explanation("fall_height"), explanation("contact.fall_height"));
  EXPECT_EQ(explanation("lines").find("stages"), std::string::npos);  // the one at the top
}

TEST(Format, DotsAndSpacesAloneAreNoKey) {
  EXPECT_EQ(explanation("box."), explanation("box"));
  for (const std::string path : {".", "..", "box..", " ", "a"}) {
    EXPECT_THAT([&] { explanation(path); },
                ThrowsMessage<UnknownKeyError>("the scene format has no key '" + path + "'"));
  }
  EXPECT_THROW(explanation(" x"), UnknownKeyError);
  EXPECT_THROW(explanation("walls..box"), UnknownKeyError);
}

TEST(Format, LeavesOutWhereToReadOn) {
  EXPECT_THAT(explanation("model"), HasSubstr("or energies of velocities and axes\n"));
  EXPECT_THAT(explanation("begin"), HasSubstr("that this one begins with\n"));
  EXPECT_THAT(explanation("box"), HasSubstr("the box that everything happens in\n"));
}

TEST(Format, SaysADefaultThatIsNoValueInOtherWords) {
  EXPECT_THAT(explanation("output.view"), HasSubstr("; if left out: the whole box\n"));
  EXPECT_THAT(explanation("stages.fill"), HasSubstr("map; default: none\n"));
  EXPECT_THAT(explanation("stages.fill.picture.rows"), HasSubstr("list of texts; this or file\n"));
}

TEST(Format, ExplainsTheKeysOfAMap) {
  EXPECT_THAT(explanation("output.fields"),
              EndsWith("  cell: side of a cell in lattice spacings\n    1 to 1000; default: 8\n\n"
                       "  every: steps of a window\n    1 to 10^12; default: 100\n"));
}

TEST(Format, TakesThePathsOfSet) {
  EXPECT_THAT(explanation("walls.gate.motion.wave.period"),
              HasSubstr("walls.NAME.motion.wave.period"));
  EXPECT_EQ(explanation("stages.flow.until.steps"), explanation("stages.until.steps"));
  EXPECT_EQ(explanation("walls.tray.parts.0.disc.radius"), explanation("walls.parts.disc.radius"));
}

TEST(Format, SaysWhatBothKindsOfScenesHave) {
  EXPECT_THAT(explanation("output"), HasSubstr("In a scene of the Boltzmann equation:\n\noutput"));
  EXPECT_THAT(explanation("boltzmann:output.bins"), HasSubstr("q2 to q1000"));
}

TEST(Format, RefusesAKeyThatItDoesNotHaveWithTheNearest) {
  const auto refusal = [](const std::string& path) -> std::string {
    try {
      return explanation(path);
    } catch (const UnknownKeyError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal("rules.inerta"),
            "the scene format has no key 'rules.inerta'; did you mean 'rules.inertia'?");
  EXPECT_EQ(refusal("axis_order"), "the scene format has no key 'axis_order'; see measure");
  EXPECT_EQ(refusal("adaptive"), "the scene format has no key 'adaptive'; see contact.resolution");
  EXPECT_EQ(refusal("boltzman"),
            "the scene format has no key 'boltzman'; did you mean 'boltzmann'?");
  EXPECT_EQ(refusal("walls.gate.motion.wave.x.y"),
            "the scene format has no key 'walls.gate.motion.wave.x.y'");
}

}  // namespace
}  // namespace clca::scene::format_test
