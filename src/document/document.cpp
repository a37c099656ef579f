#include "document/internal/document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "clca/document/document.hpp"
#include "clca/text/message.hpp"
#include "clca/text/utf8.hpp"

namespace clca::document {

namespace {

constexpr std::size_t kMaxDepth = 32;  // nesting of lists and maps
constexpr std::size_t kMaxValues = 260'000;

/// The text before YAML parsing: allowed characters and line numbers.
class SourceText {
 public:
  /// Throws as check_text().
  SourceText(std::string_view text, std::shared_ptr<const Origin> origin)
      : text_(text), origin_(std::move(origin)) {
    if (text_.size() > kMaxBytes) {
      fail({origin_, 1, 1}, "the text is larger than {} MiB", kMaxBytes >> 20U);
    }
    characters_before_.reserve(text_.size() + 1);
    for (std::size_t i = 0; i < text_.size(); ++i) {
      const bool begins = (static_cast<unsigned char>(text_[i]) & 0xC0U) != 0x80;  // a character
      characters_before_.push_back(characters_before_.back() + (begins ? 1 : 0));
      if (text_[i] == '\n') {
        line_starts_.push_back(i + 1);
      }
    }
    check_characters();
    check_directives();
    check_brackets();
  }

  std::string_view text() const { return text_; }
  /// The location of the byte at `position`.
  TextLocation location(std::size_t position) const {
    const std::size_t end = std::min(position, text_.size());
    const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), end);
    const auto line = static_cast<std::size_t>(next - line_starts_.begin());
    return {origin_, line,
            characters_before_[end] - characters_before_[line_starts_[line - 1]] + 1};
  }

  /// Where the quote that opens at `begin` closes; the size of the text if it does not.
  std::size_t end_of_quote(std::size_t begin) const {
    const char quote = text_[begin];
    for (std::size_t i = begin + 1; i < text_.size(); ++i) {
      const bool is_doubled = quote == '\'' && text_.substr(i, 2) == "''";  // a quote inside quotes
      if (text_[i] == quote && !is_doubled) {
        return i;
      }
      i += is_doubled || (quote == '"' && text_[i] == '\\') ? 1 : 0;
    }
    return text_.size();
  }

 private:
  void check_character(std::size_t position, std::size_t length) const {
    if (length == 0) {
      fail(location(position), "the byte 0x{:02x} is not UTF-8 text",
           static_cast<unsigned char>(text_[position]));
    }
    const char32_t character = text::character_at(text_, position);
    if (position == 0 && character == 0xFEFF) {
      fail(location(0), "a byte order mark; save the file as UTF-8 without it");
    }
    const bool line_end = text_.substr(position, 2) == "\r\n";
    if (text::is_control_character(character) && character != '\n' && character != '\t' &&
        !line_end) {
      fail(location(position), "the control character U+{:04X} is not allowed",
           static_cast<unsigned>(character));
    }
  }

  void check_characters() const {
    bool comment = false;
    for (std::size_t i = 0; i < text_.size();) {
      const std::size_t length = text::character_bytes(text_, i);
      check_character(i, length);
      if (text_[i] == '\t' && !comment) {
        fail(location(i), "a tab; indent and align with spaces");
      }
      comment = text_[i] != '\n' && (comment || text_[i] == '#');
      i += length;
    }
  }

  void check_directives() const {
    for (const std::size_t start : line_starts_) {
      const std::string_view rest = text_.substr(start);
      if (rest.starts_with('%')) {
        fail(location(start), "YAML directives ('%') are not part of the format");
      }
      const std::size_t first = std::min(rest.find_first_not_of(" \r"), rest.size());
      if (first < rest.size() && rest[first] != '\n' && rest[first] != '#') {
        return;
      }
    }
  }

  // yaml-cpp keeps all of a value in brackets in memory before it hands on the first of it: some
  // 200 bytes a value. A value follows a comma, a colon, a bracket or the dash of a list.
  void check_brackets() const {
    constexpr std::string_view kBeforeValue = "\n:,-?[{";
    std::size_t depth = 0;
    std::size_t values = 0;
    char before = '\n';  // the last character that is no space
    for (std::size_t i = 0; i < text_.size(); ++i) {
      const char letter = text_[i];
      const bool begins = kBeforeValue.find(before) != std::string_view::npos;
      if (letter == '#' && (i == 0 || text_[i - 1] == ' ' || text_[i - 1] == '\n')) {
        i = std::min(text_.find('\n', i), text_.size()) - 1;
      } else if (begins && (letter == '"' || letter == '\'')) {
        i = end_of_quote(i);
        before = letter;
      } else if (letter != ' ' && letter != '\r') {
        const bool opens = letter == '[' || letter == '{';
        if (opens && begins && ++depth > kMaxDepth) {
          fail(location(i), "nested deeper than {} levels", kMaxDepth);
        }
        depth -= (letter == ']' || letter == '}') && depth > 0 ? 1 : 0;
        before = opens && !begins ? 'a' : letter;  // in the middle of a text it is a letter
        const bool dash =
            letter == '-' && (text_.substr(i, 2) == "- " || text_.substr(i, 2) == "-\n");
        values += opens || dash || letter == ',' || letter == ':' || letter == '?' ? 1 : 0;
        if (values > kMaxValues) {
          fail(location(i), "more than {} values", kMaxValues);
        }
      }
    }
  }

  std::string_view text_;
  std::shared_ptr<const Origin> origin_;
  std::vector<std::size_t> line_starts_ = {0};
  std::vector<std::uint32_t> characters_before_ = {0};  // each byte: lines may be long
};

constexpr std::size_t kMaxKeys = 10'000;  // of a map

constexpr std::string_view kNoAliases =
    "aliases ('*') are not part of the format; repeat the value";

/// Messages of yaml-cpp and plainer versions of them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kPlainWords = {{
    {"illegal map value", "a ':' that belongs to no key (check indentation, or quote the text)"},
    {"end of map not found", "expected 'KEY: VALUE' here (check the indentation)"},
    {"end of sequence not found", "expected '- ITEM' here (check the indentation)"},
    {"illegal block entry", "a '-' that belongs to no list (check the indentation)"},
    {"illegal flow end", "a closing bracket that was never opened"},
    {"illegal EOF in scalar", "the text ends inside quotes"},
    {"unknown token", "a character that no value can begin with; quote the text"},
    {"the referenced anchor is not defined", kNoAliases},
    {"illegal map key", "a key that is not allowed here (check the indentation)"},
}};

/// Builds the tree from parser events and rejects what the format does not allow.
class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const SourceText& source) : source_(source) {}

  /// The tree, after the end of the text.
  Value take() {
    if (bad_key_) {
      fail(bad_key_->first, "{}", bad_key_->second);
    }
    if (root_) {
      return std::move(*root_);
    }
    Value nothing;
    nothing.location = source_.location(0);
    return nothing;
  }

  /// Translates a parser error.
  [[noreturn]] void explain(const YAML::Exception& error) const {
    const auto level = std::find_if(open_levels_.rbegin(), open_levels_.rend(),
                                    [](const OpenLevel& candidate) { return candidate.bracketed; });
    if (level != open_levels_.rend() && error.msg.ends_with("flow not found")) {
      const char bracket = level->value.is(Value::Kind::map) ? '{' : '[';
      fail(level->value.location, "the '{}' is not closed, or a ',' is missing after it", bracket);
    }
    if (level != open_levels_.rend() && error.msg == "illegal flow end") {
      const bool brace = rest(error.mark).starts_with('}');
      fail(location(error.mark), "a '{}' while a '{}' is still open", brace ? '}' : ']',
           brace ? '[' : '{');
    }
    for (const auto& [theirs, ours] : kPlainWords) {
      if (error.msg == theirs) {
        fail(location(error.mark), "{}", ours);
      }
    }
    fail(location(error.mark), "not valid YAML: {}", text::printable(error.msg));
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (document_ended_) {
      fail(location(mark), "a second document, or text after the end of the first");
    }
  }

  void OnDocumentEnd() override { document_ended_ = true; }

  void OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    Value value;
    value.location = location(mark);
    // For an empty value the mark is that of the next token.
    const std::string_view next = rest(mark);
    const bool written = next.starts_with('~') || next.starts_with('n') || next.starts_with('N');
    if (!written && !open_levels_.empty() && open_levels_.back().entry) {
      value.location = open_levels_.back().entry->location;
    }
    add(std::move(value));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    fail(location(mark), kNoAliases);
  }

  void OnAnchor(const YAML::Mark& mark, const std::string& /*name*/) override {
    fail(location(mark), "anchors ('&') are not part of the format");
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                const std::string& text) override {
    check_tag(mark, tag);
    Value value;
    value.kind = Value::Kind::scalar;
    value.location = location(mark);
    value.text = text;
    value.quoted = tag == "!";
    if (value.quoted) {
      check_closing_quote(mark);
    }
    add(std::move(value));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value style) override {
    check_tag(mark, tag);
    open(Value::Kind::list, mark, style == YAML::EmitterStyle::Flow);
  }

  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value style) override {
    check_tag(mark, tag);
    open(Value::Kind::map, mark, style == YAML::EmitterStyle::Flow);
  }

  void OnMapEnd() override { close(); }

 private:
  /// An unfinished list or map.
  struct OpenLevel {
    Value value;
    bool bracketed = false;
    std::optional<Entry> entry;                            // key read, value to come
    std::unordered_map<std::string, std::size_t> line_of;  // of each key
  };

  std::size_t position(const YAML::Mark& mark) const {
    return std::min(static_cast<std::size_t>(std::max(mark.pos, 0)), source_.text().size());
  }
  TextLocation location(const YAML::Mark& mark) const { return source_.location(position(mark)); }
  /// The text from `mark` on.
  std::string_view rest(const YAML::Mark& mark) const {
    return source_.text().substr(position(mark));
  }
  bool awaits_key() const {
    return !open_levels_.empty() && open_levels_.back().value.is(Value::Kind::map) &&
           !open_levels_.back().entry;
  }

  /// "?" stands for no tag and "!" for quotes, but also for a bare '!' in the text.
  void check_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (rest(mark).starts_with('!') || (!tag.empty() && tag != "?" && tag != "!")) {
      fail(location(mark), "tags ('!') are not part of the format");
    }
  }

  /// yaml-cpp accepts an unclosed quote at the end of the text.
  void check_closing_quote(const YAML::Mark& mark) const {
    const std::string_view text = rest(mark);
    const char quote = text.empty() ? '\0' : text.front();
    if (quote != '"' && quote != '\'') {
      return;  // a block of lines after '|' or '>'
    }
    if (source_.end_of_quote(position(mark)) == source_.text().size()) {
      fail(location(mark), "the quote that opens here is not closed");
    }
  }

  void open(Value::Kind kind, const YAML::Mark& mark, bool bracketed) {
    if (open_levels_.size() >= kMaxDepth) {
      fail(location(mark), "nested deeper than {} levels", kMaxDepth);
    }
    OpenLevel level;
    level.value.kind = kind;
    level.value.location = location(mark);
    level.bracketed = bracketed;
    open_levels_.push_back(std::move(level));
  }

  void close() {
    Value value = std::move(open_levels_.back().value);
    open_levels_.pop_back();
    add(std::move(value));
  }

  void add(Value value) {
    if (open_levels_.empty()) {
      root_ = std::move(value);
    } else if (awaits_key()) {
      begin_entry(std::move(value));
    } else if (OpenLevel& level = open_levels_.back(); level.value.is(Value::Kind::list)) {
      level.value.items.push_back(std::move(value));
    } else {
      level.entry->value = std::move(value);
      level.value.entries.push_back(std::move(*level.entry));
      level.entry.reset();
    }
  }

  void begin_entry(Value key) {
    OpenLevel& level = open_levels_.back();
    if (!key.is(Value::Kind::scalar)) {
      if (!bad_key_) {
        bad_key_ = {key.location, fmt::format("a key is text, found {}", found(key))};
      }
    } else if (key.text == "<<" && !key.quoted) {
      fail(key.location, "merge keys ('<<') are not part of the format");
    } else if (const auto [first, added] = level.line_of.emplace(key.text, key.location.line);
               !added) {
      const bool lines = key.location.origin->has_lines;
      fail(key.location, "duplicate key {}{}", text::quoted(key.text),
           lines ? fmt::format(" (first on line {})", first->second) : "");
    }
    if (level.line_of.size() > kMaxKeys) {
      fail(key.location, "more than {} keys in a map", kMaxKeys);
    }
    level.entry = Entry{std::move(key.text), std::move(key.location), {}};
  }

  const SourceText& source_;
  std::vector<OpenLevel> open_levels_;
  std::optional<Value> root_;
  // A key that is not text. Reported at the end, as an unclosed bracket also looks like one.
  std::optional<std::pair<TextLocation, std::string>> bad_key_;
  bool document_ended_ = false;
};

}  // namespace

void check_text(std::string_view text, std::shared_ptr<const Origin> origin) {
  const SourceText checked(text, std::move(origin));
}

Value read_document(std::string_view text, std::shared_ptr<const Origin> origin) {
  const SourceText source(text, std::move(origin));
  std::istringstream stream{std::string(text)};
  TreeBuilder builder(source);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    builder.explain(error);
  }
  return builder.take();
}

}  // namespace clca::document
