#include "sweep/folder.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "clca/run/run.hpp"
#include "clca/store/file.hpp"

namespace clca::sweep {

namespace {

namespace fs = std::filesystem;

std::string to_json(const Plan& plan) {
  using Json = nlohmann::ordered_json;
  Json variations = Json::array();
  for (const Variation& variation : plan.request.variations) {
    variations.push_back({{"key", variation.key}, {"values", variation.values}});
  }
  const Json object = {{"clca", run::version()},
                       {"scene", plan.request.scene.string()},
                       {"set", plan.request.overrides},
                       {"vary", std::move(variations)},
                       {"seeds", to_text(plan.request.seeds)},
                       {"runs", plan.run_count()}};
  constexpr int kIndent = 2;
  // Names of files need not be UTF-8.
  return object.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

Folder::Folder(fs::path path, const Plan& plan) : path_(std::move(path)) {
  const fs::path runs = path_ / "runs";
  const fs::path request = path_ / "sweep.json";
  std::error_code error;
  fs::create_directories(runs, error);
  if (error) {
    throw store::StoreError(
        fmt::format("cannot make the folder {}: {}", runs.string(), error.message()));
  }
  if (fs::exists(request, error)) {
    fs::remove(overview(), error);  // what cannot be removed cannot be replaced: told then
  }
  store::write_whole(request, to_json(plan));
}

}  // namespace clca::sweep
