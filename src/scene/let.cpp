#include "scene/let.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "clca/text/message.hpp"
#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

bool is_expression(const Value& value) {
  return value.is(Value::Kind::scalar) && value.text.starts_with('=');
}

/// Shortest text that reads as the number; whole numbers without an exponent.
std::string number_text(double number) {
  constexpr double kMaxExact = 9007199254740992;  // 2^53
  return number == std::floor(number) && std::abs(number) <= kMaxExact
             ? fmt::format("{}", static_cast<std::int64_t>(number))
             : fmt::format("{}", number);
}

class Evaluator {
 public:
  Evaluator();
  void define(const Entry& entry);
  void evaluate(Value& value);

 private:
  double result_of(const Value& value);
  [[noreturn]] void explain(const Value& value, const mu::ParserError& error) const;

  mu::Parser parser_;
  std::vector<std::string_view> names_;
};

// Those of the library have 13 digits.
Evaluator::Evaluator() {
  parser_.ClearConst();
  parser_.DefineConst("_pi", std::numbers::pi);
  parser_.DefineConst("_e", std::numbers::e);
}

void Evaluator::define(const Entry& entry) {
  const std::string path = join_path("let", entry.key);
  const auto refuse_name = [&](const std::string& why) {
    fail(entry.location, fmt::format("{}: {}", path, why));
  };
  for (const auto& keys : {names_of(*scene_type().keys), names_of(*boltzmann_type().keys)}) {
    if (std::find(keys.begin(), keys.end(), entry.key) != keys.end()) {
      refuse_name("a key of the scene has this name");
    }
  }
  const auto number =
      entry.value.is(Value::Kind::scalar) ? to_number(entry.value.text) : std::nullopt;
  if (!number || entry.value.quoted) {
    fail(entry.value.location,
         fmt::format("{}: expected a number or an expression like '=2*a', found {}", path,
                     found(entry.value)));
  }
  constexpr const char* kNames =
      "a name has up to 64 letters, digits and '_', no digit first, and is no function or constant";
  if (entry.key.size() > kMaxNameLength || parser_.GetFunDef().contains(entry.key) ||
      parser_.GetConst().contains(entry.key)) {
    refuse_name(kNames);
  }
  try {
    parser_.DefineConst(entry.key, *number);
  } catch (const mu::ParserError&) {
    refuse_name(kNames);
  }
  names_.push_back(entry.key);
}

void Evaluator::evaluate(Value& value) {
  if (is_expression(value)) {
    value.expression = value.text;
    value.text = number_text(result_of(value));
    value.quoted = false;
  }
  for (Value& item : value.items) {
    evaluate(item);
  }
  for (Entry& entry : value.entries) {
    evaluate(entry.value);
  }
}

double Evaluator::result_of(const Value& value) {
  try {
    parser_.SetExpr(value.text.substr(1));
    int count = 0;
    const double* results = parser_.Eval(count);
    if (count != 1) {
      fail(value.location,
           fmt::format("{}: expected one number, found {}", text::shown(value.text), count));
    }
    if (!std::isfinite(results[0])) {
      fail(value.location, fmt::format("{} is no finite number", text::shown(value.text)));
    }
    return results[0] + 0.0;  // no negative zero
  } catch (const mu::ParserError& error) {
    explain(value, error);
  }
}

void Evaluator::explain(const Value& value, const mu::ParserError& error) const {
  const std::string expression = text::shown(value.text);
  if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN) {
    // The rest of the expression, from the name on.
    const std::string& token = error.GetToken();  // with a space behind
    const std::string rest = token.substr(0, token.find_last_not_of(' ') + 1);
    const std::string name = rest.substr(0, rest.find_first_of(" +-*/^()<>=!&|?:,"));
    if (name.empty() || (name.front() != '_' && std::isalpha(name.front()) == 0)) {
      fail(value.location,
           fmt::format("cannot evaluate {}: {} is not expected", expression, text::shown(rest)));
    }
    fail(value.location,
         fmt::format("unknown name {} in {} ({}){}", text::shown(name), expression,
                     names_.empty() ? "nothing stands under let" : "known: " + text::listed(names_),
                     text::suggestion(name, names_)));
  }
  std::string reason = text::printable(error.GetMsg());
  reason.resize(std::min({reason.find(" at position"), reason.find('.'), reason.size()}));
  fail(value.location, fmt::format("cannot evaluate {}: {}", expression, reason));
}

}  // namespace

void evaluate_expression(Value& value) {
  Evaluator().evaluate(value);
}

void evaluate_expressions(Value& root) {
  Evaluator evaluator;
  Value* let = root.find("let");
  if (let != nullptr && !(let->is(Value::Kind::scalar) && let->text == "none")) {
    if (!let->is(Value::Kind::map)) {
      fail(let->location, fmt::format("let: expected a map, found {}", found(*let)));
    }
    for (Entry& entry : let->entries) {
      evaluator.evaluate(entry.value);
      evaluator.define(entry);
    }
  }
  for (Entry& entry : root.entries) {
    if (entry.key != "title") {
      evaluator.evaluate(entry.value);
    }
  }
}

}  // namespace clca::scene
