#include "bad_scenes.hpp"

#include <gtest/gtest.h>

#include <regex>
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

// Of each message of the corpus that says what to write instead: that is written there.
TEST(BadScenes, AreNotRefusedThereOnceTheAdviceHasBeenFollowed) {
  const std::regex advice(
      R"(^(scene\.yaml:(\d+):(\d+): error: ).*?(?:found|unknown key|no \w+) '([^']+)'.*(did you mean|write) ('[^'.]+'|\[.*\]))");
  std::size_t followed = 0;
  for (const BadText& bad : bad_scenes()) {
    std::cmatch found;
    if (!std::regex_search(bad.message.begin(), bad.message.end(), found, advice)) {
      continue;
    }
    std::string text = bad.text;
    std::size_t place = 0;
    for (int line = std::stoi(found[2]); line > 1; --line) {
      place = text.find('\n', place) + 1;
    }
    place += std::stoul(found[3]) - 1;
    const std::string wrong = found[4].str();
    const std::string said = found[6].str();
    const bool is_list = said.starts_with('[');
    if (text.compare(place, wrong.size(), wrong) != 0) {
      ADD_FAILURE() << bad.message;
      continue;
    }
    text.replace(place, wrong.size(), is_list ? said : said.substr(1, said.size() - 2));
    const std::string then = refusal(text);
    // A suggested key may be there already; a suggested value may need something else.
    const bool is_same = then.starts_with(found[1].str()) &&
                         (is_list || then.find(": expected ") != std::string::npos ||
                          then.find(": unknown ") != std::string::npos);
    EXPECT_FALSE(is_same) << bad.message << "\n" << then;
    ++followed;
  }
  EXPECT_GT(followed, 20U);
}

}  // namespace clca::scene::testing::bad_scenes_test
