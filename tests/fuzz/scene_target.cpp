// A scene: refused in one line, or the same once written and parsed again.

#include <cmath>
#include <string_view>

#include "clca/scene/parse.hpp"
#include "clca/scene/resolve.hpp"
#include "support/any_text.hpp"
#include "target.hpp"

namespace {

using namespace clca;

constexpr double kMostBytes = 1e6;

bool is_amount(double bytes) {
  return std::isfinite(bytes) && bytes >= 0;
}

void require_sizes(std::string_view text) {
  try {
    const scene::AnyScene any = scene::parse_any(text, "scene.yaml");
    const auto* gas = std::get_if<scene::BoltzmannScene>(&any);
    fuzz::require(is_amount(gas != nullptr ? scene::bytes_of(*gas, 64)
                                           : scene::size_of(std::get<scene::Scene>(any)).bytes),
                  "no amount of memory");
  } catch (const scene::SceneError&) {
    return;
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::string trouble = testing::trouble_with_text(text, kMostBytes);
  fuzz::require(trouble.empty(), trouble);
  require_sizes(text);
  return 0;
}
