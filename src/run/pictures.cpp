#include "run/pictures.hpp"

#include <utility>

namespace clca::run {

Pictures::Pictures(const scene::Scene& scene, const grains::State& state, int threads)
    : scene_(scene), painter_(scene, state, threads) {}

void Pictures::begin_stage(const scene::Stage& stage, const grains::State& state) {
  run::begin_stage(history_, scene_, stage, state);
}

void Pictures::draw(const Model& model, const Records& records, const store::RunFolder& folder) {
  const grains::State& state = model.state();
  if (history_.last_step == state.step) {
    return;
  }
  history_.last_step = state.step;
  std::optional<std::vector<contact::Force>> forces;
  if (pictures_show_forces(scene_)) {
    forces = records.contacts()->of_picture(model);
  }
  CapturedFrame frame = painter_.capture({.state = state,
                                          .occupancy = model.grains().occupancy(),
                                          .cycles = &records.cycles(),
                                          .forces = forces ? &*forces : nullptr,
                                          .angle = model.vessel().angle},
                                         history_);
  begin_window(history_, scene_, state);
  writer_.write(folder.files().subfolder(store::kFramesFolder),
                store::frame_name(scene_.name, state.step, scene::step_digits(scene_)),
                [this, frame = std::move(frame)] {
                  const Picture picture = painter_.rasterize(frame);
                  return image::encode_png(picture.image, picture.text);
                });
}

}  // namespace clca::run
