// The state of another run that a run begins with.

#include "clca/text/number.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

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
