#include "unit/report/markup.hpp"

#include <regex>
#include <set>
#include <vector>

namespace clca::testing {

namespace {

const std::set<std::string> kVoid = {"!DOCTYPE", "meta", "img", "input", "br", "wbr"};

/// Position after the end of the element, for those that hold no markup.
std::size_t after_raw(std::string_view html, std::size_t from, const std::string& name) {
  const std::size_t end = html.find("</" + name + ">", from);
  return end == std::string_view::npos ? html.size() : end;
}

/// The tag with its attributes' values cut to their first characters: pictures in base64 and long
/// paths are too long for a regular expression, and no markup.
std::string with_short_values(std::string_view tag) {
  constexpr std::size_t kMost = 60;
  std::string shown;
  bool in_value = false;
  std::size_t length = 0;
  for (const char c : tag) {
    in_value = c == '"' ? !in_value : in_value;
    length = in_value ? length + 1 : 0;
    if (length <= kMost) {
      shown += c;
    }
  }
  return shown;
}

}  // namespace

std::string markup_error(std::string_view html) {
  static const std::regex tag(
      R"re(^<(/?)([!A-Za-z][A-Za-z0-9]*)((?:\s+[-a-zA-Z:]+(?:="[^"<>]*")?)*)\s*(/?)>)re");
  static const std::regex id(R"re(\sid="([^"]*)")re");
  std::vector<std::string> open;
  std::set<std::string> ids;
  for (std::size_t at = html.find('<'); at != std::string_view::npos; at = html.find('<', at)) {
    const std::size_t close = html.find('>', at);
    const std::string text(html.substr(at, close - at + 1));
    const std::string shown =
        text.starts_with("<!DOCTYPE") ? "<!DOCTYPE>" : with_short_values(text);
    std::smatch parts;
    if (!std::regex_search(shown, parts, tag)) {
      return "no tag: " + shown;
    }
    const std::string name = parts[2];
    const std::string attributes = parts[3];
    std::smatch found;
    if (std::regex_search(attributes, found, id) && !ids.insert(found[1]).second) {
      return "an id comes twice: " + shown;
    }
    at = close + 1;
    if (parts[1] == "/") {
      if (open.empty() || open.back() != name) {
        return "closes what is not open: " + shown;
      }
      open.pop_back();
    } else if (!kVoid.contains(name) && parts[4] != "/") {
      open.push_back(name);
      at = name == "script" || name == "style" ? after_raw(html, at, name) : at;
    }
  }
  return open.empty() ? "" : "not closed: " + open.back();
}

}  // namespace clca::testing
