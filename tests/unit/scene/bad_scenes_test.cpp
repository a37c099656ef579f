#include "bad_scenes.hpp"

#include <gtest/gtest.h>

#include <string>

#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"

namespace clca::scene::testing {

namespace {

std::string refusal(const std::string& text) {
  try {
    check_walls(parse(text, "scene.yaml"));
    return "accepted";
  } catch (const SceneError& error) {
    return error.what();
  }
}

}  // namespace

TEST(BadScenes, DifferFromASceneThatIsRight) {
  EXPECT_EQ(refusal(small_scene()), "accepted");
}

TEST(BadScenes, AreRefusedInOneLineThatNamesThePlaceAndWhatIsAllowed) {
  for (const BadScene& bad : bad_scenes()) {
    EXPECT_EQ(refusal(scene_with(bad.part)), bad.message) << bad.what << ":\n" << bad.part;
  }
}

}  // namespace clca::scene::testing
