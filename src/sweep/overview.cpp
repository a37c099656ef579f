// overview.png: the final pictures of a sweep.

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "clca/image/png.hpp"
#include "clca/render/contact_sheet.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "sweep/results.hpp"

namespace clca::sweep {

namespace {

constexpr std::size_t kMaxColumns = 8;
constexpr std::size_t kMaxPictures = 64;

/// What the run has noted of its picture; all of it where it has not.
render::PictureView picture_view(const image::DecodedPng& png) {
  const auto [width, height] = std::pair(png.image.width, png.image.height);
  const auto text = [&](const char* name) {
    const auto found = png.text.find(name);
    return std::istringstream(found == png.text.end() ? "" : found->second);
  };
  render::PixelBox box;
  text("View") >> box.x >> box.y >> box.width >> box.height;
  const auto inside = [](int first, int length, int all) {
    return first >= 0 && length > 0 && length <= all && first <= all - length;
  };
  double scale = 1;
  text("Scale") >> scale;
  return {inside(box.x, box.width, width) && inside(box.y, box.height, height)
              ? box
              : render::PixelBox{0, 0, width, height},
          scale};
}

/// The final picture, as large as it will be shown; empty when it cannot be read.
render::Tile final_picture(const std::filesystem::path& folder, const scene::Scene& scene,
                           std::uint64_t step, int width) {
  try {
    const image::DecodedPng png = image::decode_png(store::read_whole_file(
        store::frame_path(folder, scene.name, step, scene::step_digits(scene)),
        store::kMaxPictureBytes));
    render::Tile tile = render::tile(png.image, picture_view(png), width);
    if (const auto legend = png.text.find("Legend"); legend != png.text.end()) {
      tile.legend = render::parse_legend(legend->second);
    }
    return tile;
  } catch (const std::runtime_error&) {
    return {};
  }
}

/// The last part of a key: `inertia` of `rules.inertia`; all of it where another has the same.
std::string short_key(const std::vector<std::string>& keys, const std::string& key) {
  const auto last_part = [](const std::string& path) {
    return path.substr(path.rfind('.') + 1);  // npos + 1 is 0
  };
  const auto same = std::ranges::count_if(
      keys, [&](const std::string& other) { return last_part(other) == last_part(key); });
  return same == 1 ? last_part(key) : key;
}

std::string tile_label(const Plan& plan, std::size_t run, Status status) {
  const std::vector<std::string> keys = plan.varied_keys();
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    text += fmt::format("{}={}, ", short_key(keys, keys[i]), plan.variant(run).values[i]);
  }
  const char* ending = status == Status::done     ? ""
                       : status == Status::failed ? ": failed"
                                                  : ": not done";
  return fmt::format("{}seed {}{}", text, plan.seed(run), ending);
}

}  // namespace

OverviewRuns overview_runs(const Plan& plan) {
  const std::size_t seeds = plan.request.seeds.size();
  const std::size_t columns = std::min(seeds == 1 ? plan.variants.size() : seeds, kMaxColumns);
  const std::size_t shown_seeds =
      std::min(seeds, plan.variants.size() == 1 ? kMaxPictures : kMaxColumns);
  const std::size_t shown_variants = std::min(plan.variants.size(), kMaxPictures / shown_seeds);
  OverviewRuns result = {{}, static_cast<int>(columns)};
  for (std::size_t variant = 0; variant < shown_variants; ++variant) {
    for (std::size_t seed = 0; seed < shown_seeds; ++seed) {
      result.runs.push_back(variant * seeds + seed);
    }
  }
  return result;
}

std::optional<render::Image> overview_image(const Plan& plan, const std::vector<RunResult>& results,
                                            const std::filesystem::path& folder) {
  const OverviewRuns shown = overview_runs(plan);
  const bool any = std::ranges::any_of(shown.runs, [&](std::size_t run) {
    return plan.variant(run).scene.output.frames.has_value();
  });
  if (!any) {
    return std::nullopt;
  }
  const int width = render::cell_width(shown.columns);
  std::vector<render::Tile> tiles;
  for (const std::size_t run : shown.runs) {
    const RunResult& result = results[run];
    const scene::Scene& scene = plan.variant(run).scene;
    const bool drawn = result.status == Status::done && scene.output.frames;
    tiles.push_back(drawn ? final_picture(run_folder(folder, plan.run_name(run)), scene,
                                          result.summary.steps, width)
                          : render::Tile());
    tiles.back().label = tile_label(plan, run, result.status);
  }
  return render::contact_sheet(tiles, shown.columns, width, plan.title());
}

}  // namespace clca::sweep
