// Frames and PNG files.

#include <benchmark/benchmark.h>

#include "clca/render/coloring.hpp"
#include "clca/render/painter.hpp"
#include "clca/render/png.hpp"
#include "columns.hpp"

namespace {

namespace render = clca::render;

/// A packed column of so many particles and how to draw it.
struct Subject {
  clca::automaton::Automaton automaton;
  render::Painter painter;
  render::Coloring coloring;

  Subject(std::size_t particles, int width, int height, render::Drawing drawing)
      : automaton(settled(particles)),
        painter(style(automaton.state().lattice, width, height, drawing), automaton.state().lattice,
                automaton.state().kinds),
        coloring(render::color_by_id(automaton.state())) {}

  render::Image draw() {
    return painter.draw(automaton.state(), automaton.occupancy(), coloring, {});
  }

 private:
  static clca::automaton::Automaton settled(std::size_t particles) {
    auto automaton = clca::bench::rain(particles, clca::automaton::Ties::particle, 1);
    clca::bench::run_steps(automaton, 1000);
    return automaton;
  }
  static render::Style style(const clca::lattice::Lattice& lattice, int width, int height,
                             render::Drawing drawing) {
    const double right = 0.87 * lattice.columns();
    return {.width = width,
            .height = height,
            .drawing = drawing,
            .view = {.left = 0, .bottom = 0, .right = right, .top = right * 9 / 16},
            .annotations = false};
  }
};

/// Range 0: particles, 1: picture width (16:9).
void frame(benchmark::State& bench, render::Drawing drawing) {
  const int width = static_cast<int>(bench.range(1));
  Subject subject(static_cast<std::size_t>(bench.range(0)), width, width * 9 / 16, drawing);
  subject.draw();  // compiles the shaders
  for (auto _ : bench) {
    benchmark::DoNotOptimize(subject.draw());
  }
}

void frame_polygons(benchmark::State& bench) {
  frame(bench, render::Drawing::polygons);
}
void frame_lookup(benchmark::State& bench) {
  frame(bench, render::Drawing::lookup);
}

void png(benchmark::State& bench) {
  const int width = static_cast<int>(bench.range(1));
  Subject subject(static_cast<std::size_t>(bench.range(0)), width, width * 9 / 16,
                  render::Drawing::automatic);
  const render::Image image = subject.draw();
  std::size_t bytes = 0;
  for (auto _ : bench) {
    bytes = render::encode_png(image, {}).size();
  }
  bench.counters["bytes"] = static_cast<double>(bytes);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int width : {1280, 3840}) {
    for (const int particles : {540, 10'000, 100'000}) {
      benchmark->Args({particles, width});
    }
  }
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(frame_polygons)->Apply(sizes);
BENCHMARK(frame_lookup)->Apply(sizes);
BENCHMARK(png)->Apply(sizes);

}  // namespace
