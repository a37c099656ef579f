// The schema for editors takes and refuses what the parser does, as far as a schema can.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "bad_scenes.hpp"
#include "clca/scene/format.hpp"
#include "clca/scene/parse.hpp"
#include "document/internal/document.hpp"
#include "scene/place.hpp"

namespace clca::scene::schema_test {

namespace {

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
  const auto origin =
      std::make_shared<const document::Origin>(document::Origin{"scene.yaml", true});
  return json_of(document::read_document(text, origin));
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

std::string parser_error(const std::string& text, const std::string& file = "scene.yaml") {
  try {
    parse_any(text, file);
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

std::string resolved(const AnyScene& any) {
  return std::visit([](const auto& scene) { return to_yaml(scene); }, any);
}

}  // namespace

TEST(Schema, AcceptsEverySceneInTheTreeAsTheParserDoes) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes_folder())) {
    if (entry.path().extension() == ".yaml") {
      const std::string text = text_of(entry.path());
      EXPECT_EQ(schema_errors(text), "") << entry.path();
      EXPECT_EQ(parser_error(text, entry.path()), "") << entry.path();
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
      " restitution: 0.5, sweeps: 4, resolution: 0.2, fall_height: 90 cm}\n"
      "walls: {left: {box: [0, 0, 1.5 cm, 50], friction: 0.1}}");
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

TEST(Schema, IsThatOfTheDeclarations) {
  EXPECT_EQ(text_of(scenes_folder() / "scene.schema.json"), json_schema())
      << "call scripts/update-format";
}

}  // namespace clca::scene::schema_test
