// A scene, with an override or without: refused in one line, or the same once written and parsed
// again.

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "clca/run/setup.hpp"
#include "clca/scene/parse.hpp"
#include "support/any_text.hpp"
#include "target.hpp"

namespace {

namespace fuzz = clca::fuzz;
namespace scene = clca::scene;
namespace testing = clca::testing;

bool is_amount(double bytes) {
  return std::isfinite(bytes) && bytes >= 0;
}

void require_sizes(std::string_view text) {
  try {
    const scene::AnyScene any = scene::parse_any(text, "scene.yaml");
    const auto* gas = std::get_if<scene::BoltzmannScene>(&any);
    fuzz::require(
        is_amount(gas != nullptr ? scene::gas_run_bytes(*gas, 64)
                                 : clca::run::estimated_run_bytes(std::get<scene::Scene>(any))),
        "no amount of memory");
  } catch (const scene::SceneError&) {
    return;
  }
}

/// A text may begin with a line `--set KEY=VALUE`.
std::vector<scene::Override> take_override(std::string_view& text) {
  constexpr std::string_view kOption = "--set ";
  if (!text.starts_with(kOption)) {
    return {};
  }
  const std::size_t end = std::min(text.find('\n'), text.size());
  const scene::Override override(std::string(text.substr(kOption.size(), end - kOption.size())));
  text.remove_prefix(end);
  return {override};
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::vector<scene::Override> overrides = take_override(text);
  const std::string trouble = testing::trouble_with_text(text, overrides);
  fuzz::require(trouble.empty(), trouble);
  require_sizes(text);
  return 0;
}
