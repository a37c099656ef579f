#include "bad_scenes.hpp"

#include <gtest/gtest.h>

#include <string>

#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"

namespace clca::scene::testing::bad_scenes_test {

namespace {

std::string refusal(const std::string& text) {
  try {
    const AnyScene scene = parse_any(text, "scene.yaml");
    if (const auto* automaton = std::get_if<Scene>(&scene)) {
      check_walls(*automaton);
    }
    return "accepted";
  } catch (const SceneError& error) {
    return error.what();
  }
}

}  // namespace

TEST(BadScenes, DifferFromASceneThatIsRight) {
  EXPECT_EQ(refusal(small_scene()), "accepted");
  EXPECT_EQ(refusal(small_contact()), "accepted");
  EXPECT_EQ(refusal(small_gas()), "accepted");
}

TEST(BadScenes, AreRefusedInOneLineThatNamesThePlaceAndWhatIsAllowed) {
  for (const BadText& bad : bad_scenes()) {
    EXPECT_EQ(refusal(bad.text), bad.message) << bad.what << ":\n" << bad.text;
  }
}

}  // namespace clca::scene::testing::bad_scenes_test
