// Pictures and movies of run folders.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <stdexcept>

#include "clca/drawing/redraw.hpp"
#include "clca/image/png.hpp"
#include "clca/run/setup.hpp"
#include "python/binding.hpp"
#include "python/interpreter.hpp"

namespace clca::python {

namespace {

namespace fs = std::filesystem;
using Overrides = std::vector<scene::Override>;

drawing::RunToDraw run_to_draw(const fs::path& folder, const Overrides& overrides) {
  drawing::RunToDraw drawn = {.scene = drawing::drawn_scene(folder, overrides), .folder = folder};
  run::check_memory(drawn.scene, run::default_memory_limit());
  return drawn;
}

py::array picture(const fs::path& folder, std::uint64_t step, const Overrides& overrides) {
  image::Image image;
  {
    const Released free;
    image = drawing::picture(run_to_draw(folder, overrides), step, run::default_memory_limit());
  }
  return pixels(image);
}

void movie(const fs::path& folder, const fs::path& file, int frames_per_second,
           std::optional<double> duration, const std::optional<std::string>& stage,
           const Overrides& overrides) {
  Interrupt interrupt;
  interrupt.during([&] {
    drawing::Redraw redraw({run_to_draw(folder, overrides)},
                           {.movie = file,
                            .frames_per_second = frames_per_second,
                            .duration = duration,
                            .stage = stage,
                            .max_bytes = run::default_memory_limit(),
                            .stop = interrupt.stop()});
    drawing::RedrawEvents events;
    events.progress = [&](const drawing::RedrawProgress& /*progress*/) { interrupt.look(); };
    redraw.draw(events);
  });
}

py::bytes png(const py::array_t<std::uint8_t, py::array::c_style>& pixels) {
  if (pixels.ndim() != 3 || pixels.shape(2) != 3) {
    throw std::invalid_argument("expected rows x columns x 3");
  }
  image::Image image(static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)), {});
  if (image.pixels.empty()) {
    throw std::invalid_argument("a picture without pixels is no PNG");
  }
  std::copy_n(pixels.data(), pixels.size(), &image.pixels.data()->red);
  const std::vector<std::uint8_t> bytes = image::encode_png(image, {});
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void add_pictures(py::module_& module) {
  module.def("picture", picture);
  module.def("movie", movie);
  module.def("png", png);
}

}  // namespace clca::python
