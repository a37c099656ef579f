// The schema for editors says what the parser says.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "bad_scenes.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/resolve.hpp"
#include "scene/document.hpp"
#include "scene/names.hpp"

namespace clca::scene {

namespace {

using Words = std::set<std::string>;

std::filesystem::path scenes_folder() {
  return std::filesystem::path(CLCA_SOURCE_DIR) / "scenes";
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

const nlohmann::json& schema_text() {
  static const auto kText = nlohmann::json::parse(text_of(scenes_folder() / "scene.schema.json"));
  return kText;
}

/// A plain scalar as YAML's core schema takes it, which is what editors do.
nlohmann::json scalar(const Value& value) {
  const auto number = [&]() -> nlohmann::json {
    try {
      std::size_t end = 0;
      if (value.text.find_first_not_of("-0123456789") == std::string::npos) {
        const bool negative = value.text.starts_with('-');
        const nlohmann::json result = negative ? nlohmann::json(std::stoll(value.text, &end))
                                               : nlohmann::json(std::stoull(value.text, &end));
        return end == value.text.size() ? result : nlohmann::json();
      }
      const bool plain = value.text.find_first_not_of("-+.eE0123456789") == std::string::npos;
      const double result = plain ? std::stod(value.text, &end) : 0;
      return plain && end == value.text.size() ? nlohmann::json(result) : nlohmann::json();
    } catch (const std::out_of_range&) {
      return 1e300;
    } catch (const std::invalid_argument&) {
      return nullptr;
    }
  };
  if (value.quoted) {
    return value.text;
  }
  if (value.text == "true" || value.text == "false") {
    return value.text == "true";
  }
  const nlohmann::json result = number();
  return result.is_null() ? nlohmann::json(value.text) : result;
}

nlohmann::json json_of(const Value& value) {
  nlohmann::json result;
  switch (value.kind) {
    case Value::Kind::nothing:
      return nullptr;
    case Value::Kind::scalar:
      return scalar(value);
    case Value::Kind::list:
      result = nlohmann::json::array();
      for (const Value& item : value.items) {
        result.push_back(json_of(item));
      }
      return result;
    case Value::Kind::map:
      result = nlohmann::json::object();
      for (const Entry& entry : value.entries) {
        result[entry.key] = json_of(entry.value);
      }
      return result;
  }
  return result;
}

nlohmann::json json_of(std::string_view text) {
  const auto origin = std::make_shared<const Origin>(Origin{"scene.yaml", true});
  return json_of(read_document(text, origin));
}

/// What the schema says against the scene; empty when it is right.
std::string schema_errors(std::string_view text) {
  static const auto kSchema = [] {
    auto schema = std::make_unique<valijson::Schema>();
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_text()), *schema);
    return schema;
  }();
  const nlohmann::json scene = json_of(text);
  valijson::ValidationResults results;
  valijson::Validator(valijson::Validator::kStrongTypes)
      .validate(*kSchema, valijson::adapters::NlohmannJsonAdapter(scene), &results);
  std::string errors;
  for (const auto& error : results) {
    errors += error.description;
    errors += '\n';
  }
  return errors;
}

std::string parser_error(const std::string& text) {
  try {
    parse_any(text, "scene.yaml");
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

std::string resolved(const AnyScene& any) {
  return std::visit([](const auto& scene) { return to_yaml(scene); }, any);
}

template <std::size_t kCount>
Words words_of(const std::array<std::string_view, kCount>& words) {
  return {words.begin(), words.end()};
}

/// All maps and choices of the schema, by JSON pointer.
void collect(const nlohmann::json& node, const std::string& pointer,
             std::map<std::string, Words>& keys, std::map<std::string, Words>& choices) {
  const bool condition = pointer == "/definitions/in_steps" || pointer == "/definitions/of_contact";
  if (!condition && node.is_object() && node.contains("properties") &&
      node["properties"].is_object()) {
    for (const auto& [key, property] : node["properties"].items()) {
      keys[pointer].insert(key);
    }
    EXPECT_EQ(node.value("additionalProperties", true), false) << pointer;
  }
  if (node.is_object() && node.contains("enum") && node["enum"].front().is_string()) {
    for (const auto& word : node["enum"]) {
      choices[pointer].insert(word.get<std::string>());
    }
  }
  if (node.is_structured()) {
    for (const auto& [key, child] : node.items()) {
      collect(child, fmt::format("{}/{}", pointer, key), keys, choices);
    }
  }
}

}  // namespace

TEST(Schema, AcceptsEverySceneInTheTreeAsTheParserDoes) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes_folder())) {
    if (entry.path().extension() == ".yaml") {
      const std::string text = text_of(entry.path());
      EXPECT_EQ(schema_errors(text), "") << entry.path();
      EXPECT_EQ(parser_error(text), "") << entry.path();
      EXPECT_EQ(schema_errors(resolved(parse_any_file(entry.path()))), "") << entry.path();
      ++count;
    }
  }
  EXPECT_GE(count, 4);
}

TEST(Schema, AcceptsEveryKeyOfTheContactModel) {
  const std::string text = testing::contact_with(
      "units: {spacing: 1.5 cm, gravity: 1.62}\n"
      "stages: [{name: first, fill: {region: [0, 0, 50, 50], counts: {small: 5}},"
      " sources: [spout], until: {time: 2}}]\n"
      "contact: {friction: 0.2, wall_friction: 0.3, rolling: none, rolling_friction: 0.1,"
      " restitution: 0.5, sweeps: 4, resolution: 0.2, fall_height: 90,"
      " sleeping: true}\n"
      "walls: {left: {box: [0, 0, 1, 50], friction: 0.1}}");
  EXPECT_EQ(schema_errors(text), "");
  EXPECT_EQ(schema_errors(resolved(parse_any(text, "scene.yaml"))), "");
  EXPECT_EQ(schema_errors(resolved(parse_any(testing::small_contact(), "scene.yaml"))), "");
}

TEST(Schema, RefusesWhatTheParserRefusesForItsForm) {
  for (const testing::BadText& bad : testing::bad_scenes()) {
    const std::string errors = schema_errors(bad.text);
    EXPECT_EQ(errors.empty(), bad.judge == testing::Judge::parser) << bad.what << '\n' << errors;
  }
}

TEST(Schema, KnowsTheKeysAndWordsOfTheParser) {
  std::map<std::string, Words> keys;
  std::map<std::string, Words> choices;
  collect(schema_text(), "", keys, choices);
  const std::map<std::string, Words> known_keys = {
      {"/definitions/automaton", words_of(kSceneKeys)},
      {"/definitions/automaton/properties/box", words_of(kBoxKeys)},
      {"/definitions/automaton/properties/rules", words_of(kRulesKeys)},
      {"/definitions/automaton/properties/contact", words_of(kContactModelKeys)},
      {"/definitions/automaton/properties/units", words_of(kUnitsKeys)},
      {"/definitions/automaton/properties/outlets/additionalProperties", words_of(kOutletKeys)},
      {"/definitions/automaton/properties/output", words_of(kOutputKeys)},
      {"/definitions/boltzmann_scene", words_of(kBoltzmannSceneKeys)},
      {"/definitions/boltzmann_scene/properties/output", words_of(kBoltzmannOutputKeys)},
      {"/definitions/boltzmann_scene/properties/output/properties/series", words_of(kSeriesKeys)},
      {"/definitions/boltzmann", words_of(kBoltzmannKeys)},
      {"/definitions/uniform_bins", words_of(kUniformBinsKeys)},
      {"/definitions/species", words_of(kSpeciesKeys)},
      {"/definitions/shape", words_of(kShapeKeys)},
      {"/definitions/shape/properties/rod", words_of(kRodKeys)},
      {"/definitions/vessel", words_of(kVesselKeys)},
      {"/definitions/vessel/properties/rotate", words_of(kRotateKeys)},
      {"/definitions/vessel/properties/shake", words_of(kVesselShakeKeys)},
      {"/definitions/vessel/properties/tilt/anyOf/1", words_of(kTiltKeys)},
      {"/definitions/wall", words_of(kWallKeys)},
      {"/definitions/part", words_of(kPartKeys)},
      {"/definitions/line", words_of(kLineKeys)},
      {"/definitions/disc", words_of(kDiscKeys)},
      {"/definitions/ring", words_of(kRingKeys)},
      {"/definitions/arc", words_of(kArcKeys)},
      {"/definitions/motion", words_of(kMotionKeys)},
      {"/definitions/motion/properties/wave", words_of(kWaveKeys)},
      {"/definitions/motion/properties/shake", words_of(kShakeKeys)},
      {"/definitions/source", words_of(kSourceKeys)},
      {"/definitions/stage", words_of(kStageKeys)},
      {"/definitions/stage/properties/fill", words_of(kFillKeys)},
      {"/definitions/until", words_of(kUntilKeys)},
      {"/definitions/frames", words_of(kFramesKeys)},
      {"/definitions/series", words_of(kSeriesKeys)},
      {"/definitions/fields", words_of(kFieldsKeys)},
      {"/definitions/contacts", words_of(kContactsKeys)},
      {"/definitions/trajectory", words_of(kTrajectoryKeys)},
      {"/definitions/checkpoint", words_of(kCheckpointKeys)},
      {"/definitions/gas_checkpoint", words_of(kGasCheckpointKeys)},
  };
  EXPECT_EQ(keys, known_keys);
  const std::string rules = "/definitions/automaton/properties/rules/properties/";
  const std::map<std::string, Words> known_choices = {
      {"/definitions/automaton/properties/model", words_of(words(kModelNames))},
      {"/definitions/automaton/properties/contact/properties/rolling",
       words_of(words(kRollingNames))},
      {rules + "candidates", words_of(words(kCandidateNames))},
      {rules + "gravity", words_of(words(kDirectionNames))},
      {rules + "update_priority/items", words_of(words(kUpdateClassNames))},
      {rules + "ties", words_of(words(kTiesNames))},
      {"/definitions/stage/properties/fill/properties/method", words_of(words(kFillMethodNames))},
      {"/definitions/automaton/properties/measure/items", words_of(words(kMeasureNames))},
      {"/definitions/boltzmann/properties/initial", words_of(words(kInitialNames))},
      {"/definitions/boltzmann/properties/sampling", words_of(words(kSamplingNames))},
      {"/definitions/boltzmann/properties/scheme", words_of(words(kSchemeNames))},
      {"/definitions/frames/properties/color_by", words_of(words(kColorByNames))},
      {"/definitions/frames/properties/drawing", words_of(words(kDrawingNames))},
      {"/definitions/vessel/properties/shake/properties/direction",
       words_of(words(kShakeDirectionNames))},
      {"/definitions/frames/properties/overlay", words_of(words(kOverlayNames))},
      {"/definitions/wall/properties/passive", words_of(words(kPassiveNames))},
      {"/definitions/motion/properties/direction", words_of(words(kDirectionNames))},
      {"/definitions/motion/properties/wave/properties/form", words_of(words(kWaveformNames))},
  };
  EXPECT_EQ(choices, known_choices);
}

TEST(Schema, NamesTheDefaultsOfTheParser) {
  constexpr std::string_view kDefaults =
      "rules: {}\n"
      "walls: {plate: {box: [0, 40, 9, 42], motion: {shake: {amplitude: 1}}, passive: overlap}}\n"
      "stages: [{name: first, sources: [spout], move: [plate], max_steps: 9}]\n"
      "output: {frames: {}, series: {}, fields: {}, contacts: {}, trajectory: {}}";
  nlohmann::json scene = json_of(to_yaml(parse(testing::scene_with(kDefaults), "scene.yaml")));
  scene["output"]["frames"]["upright"] = false;  // the contact model's only
  scene["output"]["trajectory"]["contacts"] = false;
  const auto contact =
      json_of(to_yaml(parse(testing::contact_with("units: {spacing: 1 m}"), "scene.yaml")));
  scene["contact"] = contact.at("contact");
  scene["units"] = contact.at("units");
  const auto compare = [&](const std::string& schema_pointer, const std::string& scene_pointer) {
    const auto& properties = schema_text().at(nlohmann::json::json_pointer(schema_pointer));
    const auto required = properties.value("required", std::vector<std::string>());
    const auto is_required = [&](const std::string& key) {
      return std::find(required.begin(), required.end(), key) != required.end();
    };
    for (const auto& [key, property] : properties.at("properties").items()) {
      const auto& value = scene.at(nlohmann::json::json_pointer(scene_pointer));
      if (property.contains("default")) {
        EXPECT_EQ(property["default"], value.at(key)) << key;
      } else if (!is_required(key)) {
        EXPECT_FALSE(value.contains(key)) << key << " has a default that the schema does not name";
      }
    }
  };
  compare("/definitions/automaton/properties/rules", "/rules");
  compare("/definitions/automaton/properties/contact", "/contact");
  compare("/definitions/automaton/properties/units", "/units");
  compare("/definitions/frames", "/output/frames");
  compare("/definitions/series", "/output/series");
  compare("/definitions/fields", "/output/fields");
  compare("/definitions/contacts", "/output/contacts");
  compare("/definitions/trajectory", "/output/trajectory");
}

TEST(Schema, NamesTheDefaultsOfTheParserForTheBoltzmannEquation) {
  const auto printed = [](std::string_view scheme) {
    const std::string text = testing::gas_with(
        fmt::format("boltzmann: {{restitution: 1, friction: 0{}}}\noutput: {{}}", scheme));
    return json_of(resolved(parse_any(text, "scene.yaml")));
  };
  const nlohmann::json majorant = printed("");
  const nlohmann::json in_steps = printed(", scheme: ogawa-kato");
  const auto compare = [](const std::string& schema_pointer, const nlohmann::json& shown,
                          const Words& without) {
    const auto& properties = schema_text().at(nlohmann::json::json_pointer(schema_pointer));
    for (const auto& [key, property] : properties.items()) {
      EXPECT_EQ(property.contains("default"), !without.contains(key)) << key;
      if (property.contains("default")) {
        EXPECT_EQ(property["default"], shown.at(key)) << key;
      }
    }
  };
  nlohmann::json block = in_steps.at("boltzmann");
  block.update(majorant.at("boltzmann"));
  compare("/definitions/boltzmann/properties", block, {"restitution", "friction"});
  const nlohmann::json& output = majorant.at("output");
  const std::string outputs = "/definitions/boltzmann_scene/properties/output/properties";
  compare(outputs, output, {"series", "histograms"});
  compare(outputs + "/series/properties", output.at("series"), {});
}

}  // namespace clca::scene
