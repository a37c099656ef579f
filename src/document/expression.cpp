#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "clca/document/document.hpp"
#include "clca/text/message.hpp"
#include "document/internal/document.hpp"

namespace clca::document {

namespace {

/// Calls visit(value) for each expression in a value.
template <class Visit>
void for_each_expression(Value& value, const Visit& visit) {
  if (value.text.starts_with('=')) {
    visit(value);
  }
  for (Value& item : value.items) {
    for_each_expression(item, visit);
  }
  for (Entry& entry : value.entries) {
    for_each_expression(entry.value, visit);
  }
}

/// Shortest text that reads as the number; whole numbers without an exponent.
std::string number_text(double number) {
  return number == std::floor(number) && std::abs(number) < 0x1p64 ? fmt::format("{:.0f}", number)
                                                                   : fmt::format("{}", number);
}

bool is_letter(char letter) {
  return letter == '_' || std::isalpha(static_cast<unsigned char>(letter)) != 0;
}

using IsKnown = std::function<bool(std::string_view name)>;

/// What the text begins with: a name, which may have dots, a number, or a single character. Names
/// behind a dot, as of outlets, may have '-': the longest one that is known.
std::string_view first_token(std::string_view text, const IsKnown& is_known) {
  const auto is_part = [&](std::size_t at) {
    return is_letter(text[at]) || is_digit(text[at]) || text[at] == '.';
  };
  const auto length = [&](const auto& goes_on) {
    std::size_t end = 1;
    while (end < text.size() && goes_on(end)) {
      ++end;
    }
    return end;
  };
  if (!is_part(0)) {
    return text.substr(0, 1);
  }
  if (!is_letter(text.front())) {
    return text.substr(0, length([&](std::size_t at) {
                         const bool is_exponent = text[at - 1] == 'e' || text[at - 1] == 'E';
                         return is_part(at) ||
                                (is_exponent && (text[at] == '-' || text[at] == '+'));
                       }));
  }
  const std::string_view name = text.substr(0, length(is_part));
  if (name.find('.') == std::string_view::npos) {
    return name;
  }
  for (std::size_t end = length([&](auto at) { return is_part(at) || text[at] == '-'; });
       end > name.size(); end = text.rfind('-', end - 1)) {
    const bool is_call = end < text.size() && text[end] == '(';
    if (!is_call && is_known(text.substr(0, end))) {
      return text.substr(0, end);
    }
  }
  return name;
}

/// Calls visit(token, is_name) for the parts of an expression, in their order.
template <class Visit>
void for_each_token(std::string_view expression, const IsKnown& is_known, const Visit& visit) {
  for (std::size_t at = 0; at < expression.size();) {
    const std::string_view token = first_token(expression.substr(at), is_known);
    at += token.size();
    const bool is_call = at < expression.size() && expression[at] == '(';
    visit(token, is_letter(token.front()) && !is_call);
  }
}

class Evaluator {
 public:
  Evaluator() {
    parser_.ClearConst();  // those of the library have 13 digits
    parser_.DefineConst("_pi", std::numbers::pi);
    parser_.DefineConst("_e", std::numbers::e);
  }

  /// A number under `let`, unless its name is taken.
  void define(const Entry& entry, const std::vector<std::string_view>& taken) {
    const std::string path = join_path("let", entry.key);
    const auto refuse_name = [&](const std::string& why) {
      fail(entry.location, "{}: {}", path, why);
    };
    if (std::ranges::count(taken, entry.key) > 0) {
      refuse_name("a key of the scene has this name");
    }
    const auto number = number_in<double>(entry.value);
    if (!number) {
      fail(entry.value.location, "{}: expected a number or an expression like '=2*a', found {}",
           path, found(entry.value));
    }
    constexpr const char* kNames =
        "a name has up to 64 letters, digits and '_', no digit first, and is no function or "
        "constant";
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

  /// What stands under `let` is defined one after the other.
  void begin_let() { let_begins_ = true; }
  /// All names have been replaced.
  void expect_no_names() { has_names_ = false; }

  void evaluate(Value& value) {
    value.expression = value.text;
    const double result = result_of(value.text.substr(1), value);
    if (!std::isfinite(result)) {
      fail(value.location, "{} is no finite number", text::quoted(value.text));
    }
    value.text = number_text(result + 0.0);  // no negative zero
    value.quoted = false;
  }

  /// Puts numbers for names that have one into an expression.
  void put_numbers_for_names(Value& value) const {
    value.expression = value.text;
    value.text = with_names_replaced(value.text, [&](std::string_view name) {
      const auto& numbers = parser_.GetConst();
      const auto found = numbers.find(std::string(name));
      return found == numbers.end() ? std::nullopt : std::optional(found->second);
    });
  }

  /// The value of `expression`, which the text of the value stands for.
  double result_of(const std::string& expression, const Value& value) {
    try {
      parser_.SetExpr(expression);
      int count = 0;
      const double* results = parser_.Eval(count);
      if (count != 1) {
        fail(value.location, "{}: expected one number, found {}", text::quoted(value.text), count);
      }
      return results[0];
    } catch (const mu::ParserError& error) {
      explain(value, error);
    }
  }

  /// Whether it is the name of a function or a number.
  bool is_known(const std::string& name) const {
    return parser_.GetFunDef().contains(name) || parser_.GetConst().contains(name);
  }

 private:
  [[noreturn]] void explain(const Value& value, const mu::ParserError& error) const {
    const std::string expression = text::quoted(value.text);
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN) {
      // The rest of the expression, from the name on.
      const std::string& token = error.GetToken();  // with a space behind
      const std::string rest = token.substr(0, token.find_last_not_of(' ') + 1);
      const std::string name = rest.substr(0, rest.find_first_of(" +-*/^()<>=!&|?:,"));
      const bool is_name =
          !name.empty() && (name.front() == '_' || std::isalpha(name.front()) != 0);
      if (is_name && value.text.find(name + '(') != std::string::npos) {
        fail(value.location, "cannot evaluate {}: {} is not a function", expression,
             text::quoted(name));
      }
      if (!has_names_ || !is_name) {
        fail(value.location, "cannot evaluate {}: {} is not expected", expression,
             text::quoted(rest));
      }
      const std::string known = !names_.empty() ? "known: " + text::comma_separated(names_)
                                : let_begins_   ? "nothing stands before it under let"
                                                : "nothing stands under let";
      fail(value.location, "unknown name {} in {} ({}){}", text::quoted(name), expression, known,
           text::suggestion(name, names_));
    }
    std::string reason = text::printable(error.GetMsg());
    reason.resize(std::min({reason.find(" at position"), reason.find('.'), reason.size()}));
    fail(value.location, "cannot evaluate {}: {}", expression, reason);
  }

  mu::Parser parser_;
  std::vector<std::string_view> names_;  // under `let`, so far
  bool let_begins_ = false;              // an expression under `let` has been reached
  bool has_names_ = true;                // expressions may have names
};

/// Numbers in one form only; texts in quotes, and nothing as null. Keys stay as they are.
void make_canonical(Value& value) {
  if (value.is(Value::Kind::nothing)) {
    value = Value::scalar("null");
  } else if (const auto number = number_in<double>(value)) {
    value = Value::number(*number + 0.0);
  } else if (value.is(Value::Kind::scalar)) {
    value.quoted = true;
  }
  std::ranges::for_each(value.items, make_canonical);
  std::ranges::for_each(value.entries, make_canonical, &Entry::value);
}

}  // namespace

std::string canonical_value(const std::string& text) {
  try {
    Value value = read_value(text, std::make_shared<const Origin>());
    Evaluator evaluator;
    for_each_expression(value, [&](Value& each) { evaluator.evaluate(each); });
    make_canonical(value);
    return flow_text(value);
  } catch (const Error&) {
    return text;
  }
}

std::string with_names_replaced(
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
  return name.size() <= kMaxNameLength && !name.empty() && is_letter(name.front()) &&
         !Evaluator().is_known(name) && std::ranges::all_of(name, [](char letter) {
           return is_letter(letter) || is_digit(letter);
         });
}

void check_expression(const Value& value) {
  Evaluator evaluator;
  evaluator.expect_no_names();
  const auto any_number = [&](std::string_view name) {
    return evaluator.is_known(std::string(name)) || name.ends_with('-') ? std::nullopt
                                                                        : std::optional(1.0);
  };
  evaluator.result_of(with_names_replaced(value.text.substr(1), any_number), value);
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

std::optional<double> expression_value(
    std::string_view expression,
    const std::function<std::optional<double>(std::string_view name)>& values) {
  Value value = Value::scalar(std::string(expression), {std::make_shared<const Origin>(), 1, 1});
  try {
    const double result =
        Evaluator().result_of(with_names_replaced(expression.substr(1), values), value);
    return std::isfinite(result) ? std::optional(result) : std::nullopt;
  } catch (const Error&) {  // a name without a value, or a value that a function refuses
    return std::nullopt;
  }
}

void evaluate_expressions(Value& root, const std::vector<std::string_view>& taken,
                          std::string_view text, std::string_view open) {
  Evaluator evaluator;
  const auto evaluate = [&](Value& value) { evaluator.evaluate(value); };
  Value* let = root.find("let");
  if (let != nullptr && let->text != "none") {
    if (!let->is(Value::Kind::map)) {
      fail(let->location, "let: expected a map, found {}", found(*let));
    }
    for (Entry& entry : let->entries) {
      evaluator.begin_let();
      for_each_expression(entry.value, evaluate);
      evaluator.define(entry, taken);
    }
  }
  for (Entry& entry : root.entries) {
    if (entry.key == open) {
      for_each_expression(entry.value,
                          [&](Value& value) { evaluator.put_numbers_for_names(value); });
    } else if (entry.key != text) {
      for_each_expression(entry.value, evaluate);
    }
  }
}

}  // namespace clca::document
