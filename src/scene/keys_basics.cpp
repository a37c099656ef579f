// Title, box, and the state of another run that a run begins with.

#include "clca/text/message.hpp"
#include "clca/text/number.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

std::string read_title(const Place& place) {
  const std::string& title = read_text(place);
  const std::optional<std::size_t> characters = line_length(title);
  if (!characters) {
    fail(place, "expected one line of text, found {}", text::shown(title));
  }
  if (*characters == 0 || *characters > kMaxTitleLength) {
    fail(place, "expected 1 to {} characters, found {}", kMaxTitleLength, *characters);
  }
  return title;
}

constexpr std::size_t kHashDigits = 16;

std::uint64_t read_hash(const Place& place) {
  constexpr int kHexadecimal = 16;
  const std::string& digits = read_text(place);
  const auto hash = text::number<std::uint64_t>(digits, kHexadecimal);
  if (digits.size() != kHashDigits || !hash) {
    fail(place, "expected {} hexadecimal digits, found {}", kHashDigits, found(place));
  }
  return *hash;
}

Type<std::uint64_t> hash_type() {
  return own_type<std::uint64_t>(
      fmt::format("{} hexadecimal digits, in quotes", kHashDigits),
      text_schema("^[0-9A-Fa-f]{16}$"), read_hash,
      [](std::uint64_t hash) { return Value::quoted_text(fmt::format("{:016x}", hash)); });
}

}  // namespace

Type<std::string> title_type() {
  return own_type<std::string>(
      fmt::format("1 to {} characters", kMaxTitleLength),
      fmt::format(R"({{"type": ["string", "number", "boolean"], "minLength": 1, "maxLength": {}}})",
                  kMaxTitleLength),
      read_title, [](const std::string& title) { return Value::quoted_text(title); });
}

Type<Box> box_type() {
  return type_of<Box>(
      {.keys =
           {required("width", &Box::width, length(number(1, kMaxBoxWidth)),
                     "width; columns stand 0.866 apart"),
            required("height", &Box::height, length(number(1, kMaxBoxHeight)), "height"),
            key("periodic", &Box::periodic, yes_or_no(),
                "what leaves on the right comes back on the left; the number of columns is made "
                "even")},
       .check = [](const KeyedMap& fields, Box& box) { box.location = reference(fields); }});
}

Type<Begin> begin_type() {
  return type_of<Begin>(
      {.keys = {required("run", &Begin::run, file_path_type(),
                         "folder of the run; a relative one begins at the folder of the scene"),
                key("step", &Begin::step,
                    word_or_value("last", count(0, kMaxSteps),
                                  fmt::format("a whole number from 0 to {}", kMaxSteps)),
                    "its end, or a step of its trajectory"),
                key("state", &Begin::state, hash_type(),
                    "hash of the state there: another one is refused. Runs note it in their "
                    "`scene.yaml`")
                    .defaults_to("any state")},
       .check = [](const KeyedMap& fields, Begin& begin) { begin.location = reference(fields); }});
}

}  // namespace clca::scene
