#include "clca/document/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "clca/document/document.hpp"
#include "clca/text/message.hpp"
#include "document/internal/document.hpp"
#include "document/internal/number.hpp"

namespace clca::document {

namespace {

bool is_expression(const Value& value) {
  return value.is(Value::Kind::scalar) && value.text.starts_with('=');
}

/// Shortest text that reads as the number; whole numbers without an exponent.
std::string number_text(double number) {
  return number == std::floor(number) && std::abs(number) < 0x1p64 ? fmt::format("{:.0f}", number)
                                                                   : fmt::format("{}", number);
}

bool is_letter(char letter) {
  return letter == '_' || std::isalpha(static_cast<unsigned char>(letter)) != 0;
}

/// What stands at `begin`: a name, which may have dots, a number, or a single character.
std::string_view token_at(std::string_view text, std::size_t begin) {
  std::size_t end = begin + 1;
  const auto goes_on = [&] {
    return is_letter(text[end]) || is_digit(text[end]) || text[end] == '.';
  };
  const bool is_number = is_digit(text[begin]) || text[begin] == '.';
  while ((is_number || is_letter(text[begin])) && end < text.size()) {
    const char before = text[end - 1];
    const bool is_sign =
        is_number && (before == 'e' || before == 'E') && (text[end] == '-' || text[end] == '+');
    if (!goes_on() && !is_sign) {
      break;
    }
    ++end;
  }
  return text.substr(begin, end - begin);
}

using IsKnown = std::function<bool(std::string_view name)>;

/// The same where names behind a dot, as of outlets, may have '-': the longest one that is known.
std::string_view token_at(std::string_view text, std::size_t begin, const IsKnown& is_known) {
  const std::string_view token = token_at(text, begin);
  if (!is_letter(token.front()) || token.find('.') == std::string_view::npos) {
    return token;
  }
  std::size_t end = begin;
  while (end < text.size() &&
         (is_letter(text[end]) || is_digit(text[end]) || text[end] == '.' || text[end] == '-')) {
    ++end;
  }
  while (end > begin + token.size()) {
    const bool is_call = end < text.size() && text[end] == '(';
    if (!is_call && is_known(text.substr(begin, end - begin))) {
      return text.substr(begin, end - begin);
    }
    end = text.rfind('-', end - 1);
  }
  return token;
}

/// Calls visit(token, is_name) for the parts of an expression, in their order.
template <class Visit>
void for_each_token(std::string_view expression, const IsKnown& is_known, const Visit& visit) {
  for (std::size_t at = 0; at < expression.size();) {
    const std::string_view token = token_at(expression, at, is_known);
    at += token.size();
    const bool is_call = at < expression.size() && expression[at] == '(';
    visit(token, is_letter(token.front()) && !is_call);
  }
}

class Evaluator {
 public:
  Evaluator();
  /// A number under `let`, unless its name is taken.
  void define(const Entry& entry, const std::vector<std::string_view>& taken);
  /// What stands under `let` is defined one after the other.
  void begin_let() { let_begins_ = true; }
  /// All names have been replaced.
  void expect_no_names() { has_names_ = false; }
  void evaluate(Value& value);
  /// Puts numbers for names that have one into the expressions of a value.
  void name_numbers(Value& value);
  /// The value of `expression`, which the text of the value stands for.
  double result_of(const std::string& expression, const Value& value);
  /// Whether it is the name of a function or a number.
  bool is_known(const std::string& name) const {
    return parser_.GetFunDef().contains(name) || parser_.GetConst().contains(name);
  }

 private:
  [[noreturn]] void explain(const Value& value, const mu::ParserError& error) const;

  mu::Parser parser_;
  std::vector<std::string_view> names_;
  bool let_begins_ = false;
  bool has_names_ = true;
};

// Those of the library have 13 digits.
Evaluator::Evaluator() {
  parser_.ClearConst();
  parser_.DefineConst("_pi", std::numbers::pi);
  parser_.DefineConst("_e", std::numbers::e);
}

void Evaluator::define(const Entry& entry, const std::vector<std::string_view>& taken) {
  const std::string path = join_path("let", entry.key);
  const auto refuse_name = [&](const std::string& why) {
    fail(entry.location, "{}: {}", path, why);
  };
  if (std::ranges::count(taken, entry.key) > 0) {
    refuse_name("a key of the scene has this name");
  }
  const auto number =
      entry.value.is(Value::Kind::scalar) ? number_in<double>(entry.value.text) : std::nullopt;
  if (!number || entry.value.quoted) {
    fail(entry.value.location, "{}: expected a number or an expression like '=2*a', found {}", path,
         found(entry.value));
  }
  constexpr const char* kNames =
      "a name has up to 64 letters, digits and '_', no digit first, and is no function or constant";
  if (entry.key.size() > kMaxNameLength || is_known(entry.key)) {
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
    const double result = result_of(value.text.substr(1), value);
    if (!std::isfinite(result)) {
      fail(value.location, "{} is no finite number", text::shown(value.text));
    }
    value.text = number_text(result + 0.0);  // no negative zero
    value.quoted = false;
  }
  for (Value& item : value.items) {
    evaluate(item);
  }
  for (Entry& entry : value.entries) {
    evaluate(entry.value);
  }
}

void Evaluator::name_numbers(Value& value) {
  if (is_expression(value)) {
    value.expression = value.text;
    value.text = with_numbers(value.text, [&](std::string_view name) {
      const auto& numbers = parser_.GetConst();
      const auto found = numbers.find(std::string(name));
      return found == numbers.end() ? std::nullopt : std::optional(found->second);
    });
  }
  for (Value& item : value.items) {
    name_numbers(item);
  }
  for (Entry& entry : value.entries) {
    name_numbers(entry.value);
  }
}

double Evaluator::result_of(const std::string& expression, const Value& value) {
  try {
    parser_.SetExpr(expression);
    int count = 0;
    const double* results = parser_.Eval(count);
    if (count != 1) {
      fail(value.location, "{}: expected one number, found {}", text::shown(value.text), count);
    }
    return results[0];
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
    const bool is_name = !name.empty() && (name.front() == '_' || std::isalpha(name.front()) != 0);
    if (is_name && value.text.find(name + '(') != std::string::npos) {
      fail(value.location, "cannot evaluate {}: {} is not a function", expression,
           text::shown(name));
    }
    if (!has_names_ || !is_name) {
      fail(value.location, "cannot evaluate {}: {} is not expected", expression, text::shown(rest));
    }
    const std::string known = !names_.empty() ? "known: " + text::listed(names_)
                              : let_begins_   ? "nothing stands before it under let"
                                              : "nothing stands under let";
    fail(value.location, "unknown name {} in {} ({}){}", text::shown(name), expression, known,
         text::suggestion(name, names_));
  }
  std::string reason = text::printable(error.GetMsg());
  reason.resize(std::min({reason.find(" at position"), reason.find('.'), reason.size()}));
  fail(value.location, "cannot evaluate {}: {}", expression, reason);
}

}  // namespace

void evaluate_expression(Value& value) {
  Evaluator().evaluate(value);
}

std::string with_numbers(
    std::string_view expression,
    const std::function<std::optional<double>(std::string_view name)>& number_of) {
  std::string result;
  const auto is_known = [&](std::string_view name) { return number_of(name).has_value(); };
  for_each_token(expression, is_known, [&](std::string_view token, bool is_name) {
    const auto number = is_name ? number_of(token) : std::nullopt;
    const std::string text = number ? number_text(*number) : std::string(token);
    result += number && *number < 0 ? "(" + text + ")" : text;
  });
  return result;
}

bool is_expression_name(const std::string& name) {
  return name.size() <= kMaxNameLength && name.find('.') == std::string::npos && !name.empty() &&
         is_letter(name.front()) && token_at(name, 0) == name && !Evaluator().is_known(name);
}

void check_expression(const Value& value) {
  Evaluator evaluator;
  evaluator.expect_no_names();
  const auto any_number = [&](std::string_view name) {
    return evaluator.is_known(std::string(name)) || name.ends_with('-') ? std::nullopt
                                                                        : std::optional(1.0);
  };
  evaluator.result_of(with_numbers(value.text.substr(1), any_number), value);
}

std::vector<std::string> names_in(std::string_view expression, const IsKnown& is_known) {
  const Evaluator evaluator;
  std::vector<std::string> names;
  for_each_token(expression, is_known, [&](std::string_view token, bool is_name) {
    if (is_name && !evaluator.is_known(std::string(token))) {
      names.emplace_back(token);
    }
  });
  return names;
}

std::optional<double> value_of(
    std::string_view expression,
    const std::function<std::optional<double>(std::string_view name)>& values) {
  const auto has_value = [&](std::string_view name) { return values(name).has_value(); };
  if (!std::ranges::all_of(names_in(expression, has_value), has_value)) {
    return std::nullopt;
  }
  Value value = Value::scalar(std::string(expression), {std::make_shared<const Origin>(), 1, 1});
  try {
    const double result = Evaluator().result_of(with_numbers(expression.substr(1), values), value);
    return std::isfinite(result) ? std::optional(result) : std::nullopt;
  } catch (const Error&) {  // a value that a function refuses
    return std::nullopt;
  }
}

void evaluate_expressions(Value& root, const ExpressionKeys& keys) {
  Evaluator evaluator;
  Value* let = root.find("let");
  if (let != nullptr && !(let->is(Value::Kind::scalar) && let->text == "none")) {
    if (!let->is(Value::Kind::map)) {
      fail(let->location, "let: expected a map, found {}", found(*let));
    }
    for (Entry& entry : let->entries) {
      evaluator.begin_let();
      evaluator.evaluate(entry.value);
      evaluator.define(entry, keys.taken);
    }
  }
  for (Entry& entry : root.entries) {
    if (entry.key == keys.open) {
      evaluator.name_numbers(entry.value);
    } else if (entry.key != keys.text) {
      evaluator.evaluate(entry.value);
    }
  }
}

}  // namespace clca::document
