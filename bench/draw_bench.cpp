// Frames and PNG files: what they cost the thread that simulates, and what the thread that draws.

#include <benchmark/benchmark.h>

#include <cmath>

#include "clca/automaton/automaton.hpp"
#include "clca/image/png.hpp"
#include "clca/render/coloring.hpp"
#include "clca/render/painter.hpp"

namespace {

namespace automaton = clca::automaton;
namespace grains = clca::grains;
namespace image = clca::image;
namespace lattice = clca::lattice;
namespace render = clca::render;

/// Small and large hexagons, 1:1, at random over the lower `share` of a box of 16:9, half of whose
/// sites they take there; after some steps of their fall.
automaton::Automaton crowd(std::size_t particles, double share) {
  const double sites = 26.0 * static_cast<double>(particles) / share;
  const double height = std::sqrt(sites * lattice::kColumnPitch * 9 / 16);
  grains::State state{.lattice = lattice::Lattice::covering(height * 16 / 9, height, false),
                      .seed = 2001};
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  automaton::Automaton result(std::move(state));
  const std::vector<std::size_t> counts = {particles / 2, particles / 2};
  result.fill({0, 0, height * 16 / 9, height * share}, counts);
  for (int step = 0; step < 5; ++step) {
    result.step();
  }
  return result;
}

/// Draws it at 16:9, 2 x 2 samples a pixel, without a caption.
struct Subject {
  automaton::Automaton subject;
  render::Painter painter;

  Subject(std::size_t particles, int width, int threads, render::DrawingMethod drawing,
          double share = 1)
      : subject(crowd(particles, share)),
        painter({.width = width,
                 .height = width * 9 / 16,
                 .drawing = drawing,
                 .view = {},
                 .annotations = render::Annotations::none,
                 .threads = threads},
                subject.state().lattice, subject.state().kinds) {}

  render::Capture capture(const render::Coloring& coloring) {
    return painter.capture(subject.state(), subject.occupancy(), coloring);
  }
};

/// Range 0: particles, 1: picture width, 2: threads that share what the simulation waits for.
Subject subject_of(const benchmark::State& bench, render::DrawingMethod drawing) {
  return {static_cast<std::size_t>(bench.range(0)), static_cast<int>(bench.range(1)),
          static_cast<int>(bench.range(2)), drawing};
}

/// The time includes that of the colours.
template <class ColoringOf>
void capture(benchmark::State& bench, render::DrawingMethod drawing, ColoringOf coloring_of) {
  Subject subject = subject_of(bench, drawing);
  for (auto _ : bench) {
    benchmark::DoNotOptimize(subject.capture(coloring_of(subject.subject.state())));
  }
}

void rasterize(benchmark::State& bench, render::DrawingMethod drawing) {
  Subject subject = subject_of(bench, drawing);
  const render::Capture exposure = subject.capture(render::color_by_id(subject.subject.state()));
  subject.painter.rasterize(exposure, {});  // compiles the shaders
  for (auto _ : bench) {
    benchmark::DoNotOptimize(subject.painter.rasterize(exposure, {}));
  }
}

void expose_polygons(benchmark::State& bench) {
  capture(bench, render::DrawingMethod::polygons, render::color_by_id);
}
void expose_lookup(benchmark::State& bench) {
  capture(bench, render::DrawingMethod::lookup, render::color_by_id);
}
/// A picture of which four fifths are empty, as of a bed with room to flow.
void expose_bed(benchmark::State& bench) {
  Subject subject(static_cast<std::size_t>(bench.range(0)), static_cast<int>(bench.range(1)),
                  static_cast<int>(bench.range(2)), render::DrawingMethod::lookup, 0.2);
  for (auto _ : bench) {
    benchmark::DoNotOptimize(subject.capture(render::color_by_id(subject.subject.state())));
  }
}
void expose_displacement(benchmark::State& bench) {
  capture(bench, render::DrawingMethod::lookup, [](const grains::State& state) {
    return render::color_by_displacement(state, {0, 100});
  });
}
void expose_layers(benchmark::State& bench) {
  capture(bench, render::DrawingMethod::lookup, [](const grains::State& state) {
    return render::color_by_layer(state, 8, {0, 2000});
  });
}
void develop_polygons(benchmark::State& bench) {
  rasterize(bench, render::DrawingMethod::polygons);
}
void develop_lookup(benchmark::State& bench) {
  rasterize(bench, render::DrawingMethod::lookup);
}

void png(benchmark::State& bench) {
  Subject subject = subject_of(bench, render::DrawingMethod::lookup);
  const image::Image image =
      subject.painter.rasterize(subject.capture(render::color_by_id(subject.subject.state())), {});
  std::size_t bytes = 0;
  for (auto _ : bench) {
    bytes = image::encode_png(image, {}).size();
  }
  bench.counters["bytes"] = static_cast<double>(bytes);
}

void few_and_many(benchmark::internal::Benchmark* benchmark) {
  for (const int particles : {540, 10'000, 100'000}) {
    benchmark->Args({particles, 1280, 1});
  }
  benchmark->Args({100'000, 3840, 1})->Unit(benchmark::kMillisecond)->UseRealTime();
}

void any_number(benchmark::internal::Benchmark* benchmark) {
  few_and_many(benchmark);
  benchmark->Args({1'000'000, 1280, 1})->Args({1'000'000, 1280, 2});
}

BENCHMARK(expose_lookup)->Apply(any_number);
BENCHMARK(expose_bed)->Apply(any_number);
BENCHMARK(expose_displacement)->Apply(any_number);
BENCHMARK(expose_layers)->Apply(any_number);
BENCHMARK(expose_polygons)->Apply(few_and_many);
BENCHMARK(develop_lookup)->Apply(any_number);
BENCHMARK(develop_polygons)->Apply(few_and_many);
BENCHMARK(png)->Apply(any_number);

}  // namespace
