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

#include "clca/text/message.hpp"
#include "document/internal/source_text.hpp"

namespace clca::document {

namespace {

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
  Value take();
  /// Translates a parser error.
  [[noreturn]] void explain(const YAML::Exception& error) const;

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override { ended_ = true; }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAnchor(const YAML::Mark& mark, const std::string& name) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override { close(); }

 private:
  /// An unfinished list or map.
  struct Open {
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
    return !open_.empty() && open_.back().value.is(Value::Kind::map) && !open_.back().entry;
  }
  void check_tag(const YAML::Mark& mark, const std::string& tag) const;
  void check_closing_quote(const YAML::Mark& mark) const;
  void open(Value::Kind kind, const YAML::Mark& mark, bool bracketed);
  void close();
  void add(Value value);
  void begin_entry(Value key);

  const SourceText& source_;
  std::vector<Open> open_;
  std::optional<Value> root_;
  // A key that is not text. Reported at the end, as an unclosed bracket also looks like one.
  std::optional<std::pair<TextLocation, std::string>> bad_key_;
  bool ended_ = false;
};

Value TreeBuilder::take() {
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

void TreeBuilder::explain(const YAML::Exception& error) const {
  const auto level = std::find_if(open_.rbegin(), open_.rend(),
                                  [](const Open& candidate) { return candidate.bracketed; });
  if (level != open_.rend() && error.msg.ends_with("flow not found")) {
    const char bracket = level->value.is(Value::Kind::map) ? '{' : '[';
    fail(level->value.location, "the '{}' is not closed, or a ',' is missing after it", bracket);
  }
  if (level != open_.rend() && error.msg == "illegal flow end") {
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

void TreeBuilder::OnDocumentStart(const YAML::Mark& mark) {
  if (ended_) {
    fail(location(mark), "a second document, or text after the end of the first");
  }
}

void TreeBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) {
  Value value;
  value.location = location(mark);
  // For an empty value the mark is that of the next token.
  const std::string_view next = rest(mark);
  const bool written = next.starts_with('~') || next.starts_with('n') || next.starts_with('N');
  if (!written && !open_.empty() && open_.back().entry) {
    value.location = open_.back().entry->location;
  }
  add(std::move(value));
}

void TreeBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) {
  fail(location(mark), kNoAliases);
}

void TreeBuilder::OnAnchor(const YAML::Mark& mark, const std::string& /*name*/) {
  fail(location(mark), "anchors ('&') are not part of the format");
}

void TreeBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag,
                           YAML::anchor_t /*anchor*/, const std::string& text) {
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

void TreeBuilder::OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                                  YAML::anchor_t /*anchor*/, YAML::EmitterStyle::value style) {
  check_tag(mark, tag);
  open(Value::Kind::list, mark, style == YAML::EmitterStyle::Flow);
}

void TreeBuilder::OnMapStart(const YAML::Mark& mark, const std::string& tag,
                             YAML::anchor_t /*anchor*/, YAML::EmitterStyle::value style) {
  check_tag(mark, tag);
  open(Value::Kind::map, mark, style == YAML::EmitterStyle::Flow);
}

/// "?" stands for no tag and "!" for quotes, but also for a bare '!' in the text.
void TreeBuilder::check_tag(const YAML::Mark& mark, const std::string& tag) const {
  if (rest(mark).starts_with('!') || (!tag.empty() && tag != "?" && tag != "!")) {
    fail(location(mark), "tags ('!') are not part of the format");
  }
}

/// yaml-cpp accepts an unclosed quote at the end of the text.
void TreeBuilder::check_closing_quote(const YAML::Mark& mark) const {
  const std::string_view text = rest(mark);
  const char quote = text.empty() ? '\0' : text.front();
  if (quote != '"' && quote != '\'') {
    return;  // a block of lines after '|' or '>'
  }
  if (source_.end_of_quote(position(mark)) == source_.text().size()) {
    fail(location(mark), "the quote that opens here is not closed");
  }
}

void TreeBuilder::open(Value::Kind kind, const YAML::Mark& mark, bool bracketed) {
  if (open_.size() >= kMaxDepth) {
    fail(location(mark), "nested deeper than {} levels", kMaxDepth);
  }
  Open level;
  level.value.kind = kind;
  level.value.location = location(mark);
  level.bracketed = bracketed;
  open_.push_back(std::move(level));
}

void TreeBuilder::close() {
  Value value = std::move(open_.back().value);
  open_.pop_back();
  add(std::move(value));
}

void TreeBuilder::add(Value value) {
  if (open_.empty()) {
    root_ = std::move(value);
  } else if (awaits_key()) {
    begin_entry(std::move(value));
  } else if (Open& level = open_.back(); level.value.is(Value::Kind::list)) {
    level.value.items.push_back(std::move(value));
  } else {
    level.entry->value = std::move(value);
    level.value.entries.push_back(std::move(*level.entry));
    level.entry.reset();
  }
}

void TreeBuilder::begin_entry(Value key) {
  Open& level = open_.back();
  if (!key.is(Value::Kind::scalar)) {
    if (!bad_key_) {
      bad_key_ = {key.location, fmt::format("a key is text, found {}", found(key))};
    }
  } else if (key.text == "<<" && !key.quoted) {
    fail(key.location, "merge keys ('<<') are not part of the format");
  } else if (const auto [first, added] = level.line_of.emplace(key.text, key.location.line);
             !added) {
    const bool lines = key.location.origin->has_lines;
    fail(key.location, "duplicate key {}{}", text::shown(key.text),
         lines ? fmt::format(" (first on line {})", first->second) : "");
  }
  if (level.line_of.size() > kMaxKeys) {
    fail(key.location, "more than {} keys in a map", kMaxKeys);
  }
  level.entry = Entry{std::move(key.text), std::move(key.location), {}};
}

}  // namespace

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
