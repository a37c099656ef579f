#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>

#include "clca/scene/parse.hpp"

namespace clca::scene::bad_texts_test {

namespace {

using namespace std::string_view_literals;

struct BadText {
  std::string_view what;
  std::string_view text;
  std::string_view message;
};

constexpr auto kTexts = std::to_array<BadText>({
    {"an empty file", ""sv,
     "scene.yaml:1:1: error: expected a scene, which begins with 'clca: 1', found nothing"},
    {"a file of comments", "# a scene\n\n# to come\n"sv,
     "scene.yaml:1:1: error: expected a scene, which begins with 'clca: 1', found nothing"},
    {"an empty document", "---\n"sv,
     "scene.yaml:2:1: error: expected a scene, which begins with 'clca: 1', found nothing"},
    {"a word", "clca\n"sv,
     "scene.yaml:1:1: error: expected a scene, which begins with 'clca: 1', found 'clca'"},
    {"a list", "- clca: 1\n"sv,
     "scene.yaml:1:1: error: expected a scene, which begins with 'clca: 1', found a list"},
    {"a scene without a version", "box: {width: 9, height: 9}\n"sv,
     "scene.yaml:1:1: error: scene: key 'clca' is missing"},
    {"a scene without a box", "clca: 1\nspecies: {a: {shape: {hexagon: 1}}}\n"sv,
     "scene.yaml:1:1: error: scene: key 'box' is missing"},
    {"a duplicate key", "clca: 1\nseed: 1\nbox: {width: 9, height: 9}\nseed: 2\n"sv,
     "scene.yaml:4:1: error: duplicate key 'seed' (first on line 2)"},
    {"a duplicate key in brackets", "clca: 1\nbox: {width: 9, height: 9, width: 8}\n"sv,
     "scene.yaml:2:28: error: duplicate key 'width' (first on line 2)"},
    {"a duplicate name", "clca: 1\nspecies:\n  a: {}\n  a: {}\n"sv,
     "scene.yaml:4:3: error: duplicate key 'a' (first on line 3)"},
    {"an anchor", "clca: &one 1\nseed: *one\n"sv,
     "scene.yaml:1:7: error: anchors ('&') are not part of the format"},
    {"an anchor on a map", "clca: 1\nbox: &box {width: 9, height: 9}\n"sv,
     "scene.yaml:2:6: error: anchors ('&') are not part of the format"},
    {"an alias of nothing", "clca: 1\nseed: *one\n"sv,
     "scene.yaml:2:7: error: aliases ('*') are not part of the format; repeat the value"},
    {"an alias that contains itself", "clca: &a [1, *a]\n"sv,
     "scene.yaml:1:7: error: anchors ('&') are not part of the format"},
    {"a merge key", "clca: 1\nbox: {<<: {width: 9}, height: 9}\n"sv,
     "scene.yaml:2:7: error: merge keys ('<<') are not part of the format"},
    {"a tag", "clca: !!int 1\n"sv, "scene.yaml:1:7: error: tags ('!') are not part of the format"},
    {"a bare tag", "clca: ! 1\n"sv, "scene.yaml:1:7: error: tags ('!') are not part of the format"},
    {"a local tag on a map", "clca: 1\nbox: !box {width: 9}\n"sv,
     "scene.yaml:2:6: error: tags ('!') are not part of the format"},
    {"a directive", "%YAML 1.2\n---\nclca: 1\n"sv,
     "scene.yaml:1:1: error: YAML directives ('%') are not part of the format"},
    {"a second document", "clca: 1\n---\nclca: 1\n"sv,
     "scene.yaml:2:1: error: a second document, or text after the end of the first"},
    {"text after the end", "{clca: 1} {seed: 2}\n"sv,
     "scene.yaml:1:11: error: a second document, or text after the end of the first"},
    {"a document after the end mark", "clca: 1\n...\nclca: 1\n"sv,
     "scene.yaml:3:1: error: a second document, or text after the end of the first"},
    {"a double quote that is never closed", "clca: 1\ntitle: \"Heap\nseed: 1\n"sv,
     "scene.yaml:2:8: error: the quote that opens here is not closed"},
    {"a single quote that is never closed", "clca: 1\ntitle: 'it''s a heap\n"sv,
     "scene.yaml:2:8: error: the quote that opens here is not closed"},
    {"a quote that is never closed at the very end", "clca: 1\ntitle: \"Heap"sv,
     "scene.yaml:2:13: error: the text ends inside quotes"},
    {"a brace that is never closed", "clca: 1\nbox: {width: 9, height: 9\nseed: 1\n"sv,
     "scene.yaml:2:6: error: the '{' is not closed, or a ',' is missing after it"},
    {"a bracket that is never closed", "clca: 1\nstages: [{name: a}, {name: b}\n"sv,
     "scene.yaml:2:9: error: the '[' is not closed, or a ',' is missing after it"},
    {"a bracket of pairs that is never closed", "clca: 1\nsites: [[0, 0], [0, 1]\n"sv,
     "scene.yaml:2:8: error: the '[' is not closed, or a ',' is missing after it"},
    {"a bracket that another one closes",
     "clca: 1\nfill: {region: [0, 0, 9, 9, counts: {a: 2}}\n"sv,
     "scene.yaml:2:43: error: a '}' while a '[' is still open"},
    {"a brace that another one closes", "clca: 1\nboxes: [{a: 2, b: 3], {a: 3}]\n"sv,
     "scene.yaml:2:20: error: a ']' while a '{' is still open"},
    {"a bracket too many", "clca: 1\nbox: {width: 9, height: 9}}\n"sv,
     "scene.yaml:2:27: error: a closing bracket that was never opened"},
    {"a colon in plain text", "clca: 1\ntitle: Heap: small\n"sv,
     "scene.yaml:2:12: error: a ':' that belongs to no key (check indentation, or quote the "
     "text)"},
    {"a key indented like nothing else", "clca: 1\n  seed: 2\n"sv,
     "scene.yaml:2:7: error: a ':' that belongs to no key (check indentation, or quote the "
     "text)"},
    {"a list where keys are expected", "clca: 1\n- seed\n"sv,
     "scene.yaml:2:1: error: expected 'KEY: VALUE' here (check the indentation)"},
    {"a key that is a list", "clca: 1\n[a, b]: 2\n"sv,
     "scene.yaml:2:1: error: a key is text, found a list"},
    {"a key that is empty", "clca: 1\n~: 2\n"sv,
     "scene.yaml:2:1: error: a key is text, found nothing"},
    {"a reserved character", "clca: 1\ntitle: @home\n"sv,
     "scene.yaml:2:8: error: a character that no value can begin with; quote the text"},
    {"a tab for indentation", "clca: 1\nbox:\n\twidth: 9\n"sv,
     "scene.yaml:3:1: error: a tab; indent and align with spaces"},
    {"a tab between key and value", "clca:\t1\n"sv,
     "scene.yaml:1:6: error: a tab; indent and align with spaces"},
    {"a byte order mark",
     "\xEF\xBB\xBF"
     "clca: 1\n"sv,
     "scene.yaml:1:1: error: a byte order mark; save the file as UTF-8 without it"},
    {"a NUL",
     "clca: 1\nseed: \x00"
     "1\n"sv,
     "scene.yaml:2:7: error: the control character U+0000 is not allowed"},
    {"text in another encoding", "clca: 1\ntitle: K\xF6rner\n"sv,
     "scene.yaml:2:9: error: the byte 0xf6 is not UTF-8 text"},
    {"an encoding cut short", "clca: 1\ntitle: K\xC3"sv,
     "scene.yaml:2:9: error: the byte 0xc3 is not UTF-8 text"},
    {"half of a pair of surrogates", "clca: 1\ntitle: \xED\xA0\x80\n"sv,
     "scene.yaml:2:8: error: the byte 0xed is not UTF-8 text"},
    {"a control character", "clca: 1\ntitle: a\x1B[31m\n"sv,
     "scene.yaml:2:9: error: the control character U+001B is not allowed"},
    {"an old line end", "clca: 1\rseed: 2\r"sv,
     "scene.yaml:1:8: error: the control character U+000D is not allowed"},
    {"a control character in an escape", "clca: 1\n\"\\x1b[31m\": 2\n"sv,
     R"(scene.yaml:2:1: error: unknown key '\x1b[31m' (allowed: clca, let, title, seed, model, )"
     "begin, box, species, rules, contact, voids, baxter, units, walls, sources, outlets, probes, "
     "lines, "
     "stages, "
     "measure, "
     "output)"},
    {"a column counted in characters", "clca: 1\nbox: {\"größe\": 9, width: 9}\n"sv,
     "scene.yaml:2:7: error: unknown key 'größe' in box (allowed: width, height, periodic)"},
    {"a very long word", "clca: 1\nthis-is-not-a-key-that-anyone-would-ever-think-of: 2\n"sv,
     "scene.yaml:2:1: error: unknown key 'this-is-not-a-key-that-anyone-would-ever...' "
     "(allowed: clca, let, title, seed, model, begin, box, species, rules, contact, voids, baxter, "
     "units, "
     "walls, "
     "sources, "
     "outlets, probes, lines, stages, measure, output)"},
});

std::string refusal(std::string_view text) {
  try {
    parse(text, "scene.yaml");
    return "accepted";
  } catch (const SceneError& error) {
    return error.what();
  }
}

}  // namespace

TEST(BadTexts, AreRefusedInOneLineThatNamesThePlace) {
  for (const BadText& bad : kTexts) {
    EXPECT_EQ(refusal(bad.text), bad.message) << bad.what;
  }
}

TEST(BadTexts, AreRefusedWhenTheyNestTooDeeply) {
  const std::string text = "clca: " + std::string(100'000, '[');
  EXPECT_EQ(refusal(text), "scene.yaml:1:39: error: nested deeper than 32 levels");
}

TEST(BadTexts, NestOnlyWhereABracketOpensAValue) {
  const std::string brackets(40, '[');
  for (const std::string& title :
       {"title: '" + brackets + "'", "title: \"\\\"" + brackets + "\"", "title: a" + brackets,
        "title: a # " + brackets, "title: it's " + brackets}) {
    EXPECT_EQ(refusal(title).find("nested"), std::string::npos) << refusal(title);
  }
  std::string lists = "clca: 1\n";
  for (int i = 0; i < 40; ++i) {
    lists += "k" + std::to_string(i) + ": [[{a: ']'}], ['[']]\n";
  }
  EXPECT_EQ(refusal(lists).find("nested"), std::string::npos) << refusal(lists);
}

TEST(BadTexts, AreRefusedWhenTheyAreTooLong) {
  EXPECT_EQ(refusal(std::string((4U << 20U) + 1, '#')),
            "scene.yaml:1:1: error: the text is larger than 4 MiB");
}

TEST(BadTexts, AreRefusedWhenTheyHoldTooManyValues) {
  std::string text = "clca: [";
  for (int i = 0; i < 260'000; ++i) {
    text += "1,";
  }
  EXPECT_EQ(refusal(text + "1]"), "scene.yaml:1:520005: error: more than 260000 values");
  std::string map = "clca: 1\nlet:\n";
  for (int i = 0; i < 10'001; ++i) {
    map += fmt::format(" a{}: 1\n", i);
  }
  EXPECT_EQ(refusal(map), "scene.yaml:10003:2: error: more than 10000 keys in a map");
}

TEST(BadTexts, AreNamedWithoutControlCharacters) {
  try {
    parse("", "a\nb\x1b.yaml");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_STREQ(error.what(),
                 "a\\nb\\x1b.yaml:1:1: error: expected a scene, which begins with 'clca: 1', "
                 "found nothing");
  }
}

}  // namespace clca::scene::bad_texts_test
