#include "sweep/overview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "clca/render/contact_sheet.hpp"
#include "clca/render/png.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"

namespace clca::sweep {

namespace {

constexpr std::size_t kMaxColumns = 8;
constexpr std::size_t kMaxPictures = 64;

int cell_width(int columns) {
  constexpr int kSheet = 1920;  // pixels, about
  return std::clamp(kSheet / columns, 240, 640);
}

/// Half as wide and high, each pixel the mean of four.
render::Image halved(const render::Image& image) {
  render::Image half(image.width / 2, image.height / 2, {});
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const auto mean = [&](std::uint8_t render::Rgb::*channel) {
        const int sum = image.at(2 * x, 2 * y).*channel + image.at(2 * x + 1, 2 * y).*channel +
                        image.at(2 * x, 2 * y + 1).*channel +
                        image.at(2 * x + 1, 2 * y + 1).*channel;
        return static_cast<std::uint8_t>((sum + 2) / 4);
      };
      half.at(x, y) = {mean(&render::Rgb::red), mean(&render::Rgb::green),
                       mean(&render::Rgb::blue)};
    }
  }
  return half;
}

/// The final picture, not much larger than it will be shown, so that all fit into memory; empty
/// when it cannot be read.
render::Image final_picture(const std::filesystem::path& folder, const scene::Scene& scene,
                            std::uint64_t step, int width) {
  try {
    render::Image image =
        render::decode_png(
            store::read_whole(store::frame_path(folder, scene.name, step), store::kMaxPictureBytes))
            .image;
    while (image.width >= 4 * width && image.height > 1) {
      image = halved(image);
    }
    return image;
  } catch (const std::runtime_error&) {
    return {};
  }
}

std::string label(const Plan& plan, std::size_t run, Status status) {
  std::string text;
  for (std::size_t i = 0; i < plan.request.variations.size(); ++i) {
    text += fmt::format("{}={}, ", plan.request.variations[i].key, plan.variant(run).values[i]);
  }
  text += fmt::format("seed {}", plan.seed(run));
  if (status == Status::done) {
    return text;
  }
  return text + (status == Status::failed ? ": failed" : ": not done");
}

}  // namespace

Selection selection(const Plan& plan) {
  const std::size_t seeds = plan.request.seeds.size();
  const std::size_t columns = std::min(seeds, kMaxColumns);
  const bool one_variant = plan.variants.size() == 1;
  const std::size_t shown_seeds = one_variant ? std::min(seeds, kMaxPictures) : columns;
  const std::size_t shown_variants = std::min(plan.variants.size(), kMaxPictures / shown_seeds);
  Selection result = {{}, static_cast<int>(columns)};
  for (std::size_t variant = 0; variant < shown_variants; ++variant) {
    for (std::size_t seed = 0; seed < shown_seeds; ++seed) {
      result.runs.push_back(variant * seeds + seed);
    }
  }
  return result;
}

std::optional<render::Image> overview(const Plan& plan, const std::vector<Result>& results,
                                      const Folder& folder) {
  const Selection shown = selection(plan);
  const bool any = std::any_of(shown.runs.begin(), shown.runs.end(), [&](std::size_t run) {
    return plan.variant(run).scene.output.frames.has_value();
  });
  if (!any) {
    return std::nullopt;
  }
  const int width = cell_width(shown.columns);
  std::vector<render::LabelledImage> images;
  for (const std::size_t run : shown.runs) {
    const Result& result = results[run];
    const scene::Scene& scene = plan.variant(run).scene;
    const bool drawn = result.status == Status::done && scene.output.frames;
    images.push_back(
        {drawn ? final_picture(folder.run(plan.name(run)), scene, result.summary.steps, width)
               : render::Image(),
         label(plan, run, result.status)});
  }
  return render::contact_sheet(images, shown.columns, width, plan.variants.front().scene.title);
}

}  // namespace clca::sweep
