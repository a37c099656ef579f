#include "run/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clca/run/run.hpp"
#include "run/overlay.hpp"

namespace clca::run {

namespace {

render::Drawing drawing_of(scene::Drawing drawing) {
  switch (drawing) {
    case scene::Drawing::polygons:
      return render::Drawing::polygons;
    case scene::Drawing::lookup:
      return render::Drawing::lookup;
    case scene::Drawing::automatic:
      break;
  }
  return render::Drawing::automatic;
}

render::Painter make_painter(const scene::Scene& scene, const automaton::State& state) {
  const scene::Frames& frames = *scene.output.frames;
  const render::Style style = {.width = frames.width,
                               .height = frames.height,
                               .supersampling = frames.supersampling,
                               .drawing = drawing_of(frames.drawing),
                               .view = frames.view.value_or(render::whole_box(state.lattice)),
                               .annotations = frames.caption};
  try {
    return {style, state.lattice, state.kinds};
  } catch (const render::RenderError& error) {
    throw ScenePlaceError(fmt::format("{}: error: {}", frames.place, error.what()));
  }
}

std::vector<render::NamedColor> species_colors(const scene::Scene& scene) {
  std::vector<render::NamedColor> colors;
  for (std::size_t number = 0; number < scene.species.size(); ++number) {
    const scene::Species& species = scene.species[number];
    const render::Rgb color =
        species.color ? render::Rgb{species.color->red, species.color->green, species.color->blue}
                      : render::palette_color(number);
    colors.push_back({species.name, color});
  }
  return colors;
}

}  // namespace

Pictures::Pictures(const scene::Scene& scene, const automaton::State& state)
    : scene_(scene), frames_(*scene.output.frames), painter_(make_painter(scene, state)) {}

void Pictures::begin_stage(const std::string& stage, const automaton::State& state) {
  stage_ = stage;
  double highest = 2;
  for (const lattice::Site origin : state.origins) {
    highest = std::max(highest, lattice::position(origin).y());
  }
  displacement_scale_ = highest / 2;
}

void Pictures::draw(const automaton::Automaton& automaton, const Records& records,
                    const store::RunFolder& folder) {
  const automaton::State& state = automaton.state();
  if (last_step_ == state.step) {
    return;
  }
  last_step_ = state.step;
  const render::Caption caption = {.title = scene_.title,
                                   .detail = fmt::format("{}, step {}", stage_, state.step)};
  render::PngText text = {{"Title", scene_.title},
                          {"Software", fmt::format("clca {}", version())},
                          {"Scene", scene_.name},
                          {"Stage", stage_},
                          {"Step", fmt::format("{}", state.step)},
                          {"Seed", fmt::format("{}", scene_.seed)}};
  render::Coloring colors = coloring(automaton);
  const Drawn drawn = overlay_of(frames_.overlay, automaton, records);
  colors.legend.lines = drawn.keys;
  writer_.write(folder.frame(scene_.name, state.step),
                painter_.draw(state, automaton.occupancy(), colors, caption, drawn.overlay),
                std::move(text));
}

render::Coloring Pictures::coloring(const automaton::Automaton& automaton) const {
  const automaton::State& state = automaton.state();
  switch (frames_.color_by) {
    case scene::ColorBy::stage_layer:
      return render::color_by_layer(state, frames_.layers);
    case scene::ColorBy::displacement:
      return render::color_by_displacement(state, displacement_scale_);
    case scene::ColorBy::speed:
      return render::color_by_speed(state);
    case scene::ColorBy::id:
      return render::color_by_id(state);
    case scene::ColorBy::force:
      return color_by_index(automaton);
    case scene::ColorBy::species:
      break;
  }
  return render::color_by_species(state, species_colors(scene_));
}

}  // namespace clca::run
