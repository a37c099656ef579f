// Wrong in the output of a scene of the Boltzmann equation.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kBadGasOutputs = std::to_array<BadScene>({
    {"pictures of a gas", "output: {frames: {}}",
     "scene.yaml:5:10: error: unknown key 'frames' in output (allowed: series, histograms, bins, "
     "checkpoint)"},
    {"a checkpoint every so many steps", "output: {checkpoint: {every: 5}}",
     "scene.yaml:5:23: error: unknown key 'every' in output.checkpoint (allowed: seconds)"},
    {"checkpoints without a pause", "output: {checkpoint: {seconds: 0}}",
     "scene.yaml:5:32: error: output.checkpoint.seconds: expected a number above 0 and up to "
     "1000000000, found '0'"},
    {"no series", "output: {series: none}",
     "scene.yaml:5:18: error: output.series: expected a map (allowed: every), found 'none'"},
    {"a row at every 0", "output: {series: {every: 0}}",
     "scene.yaml:5:26: error: output.series.every: expected a number above 0 and up to 1000000000, "
     "found '0'"},
    {"more than a million rows", "output: {series: {every: 1e-5}}",
     "scene.yaml:5:26: error: output.series.every: expected at least 1.5e-05, as a series has at "
     "most 1000000 rows until 15, found '1e-5'",
     Judge::parser},
    {"a histogram beyond the end", "output: {histograms: [0, 15, 15.5]}",
     "scene.yaml:5:30: error: output.histograms: expected a number from 0 to 15, found '15.5'",
     Judge::parser},
    {"a histogram before the beginning", "output: {histograms: [-1, 15]}",
     "scene.yaml:5:23: error: output.histograms: expected a number from 0 to 15, found '-1'"},
    {"histograms that go back", "output: {histograms: [0, 9, 5]}",
     "scene.yaml:5:29: error: output.histograms: expected times that ascend by more than "
     "5e-10, found 5 after 9",
     Judge::parser},
    {"a histogram twice", "output: {histograms: [0, 5, 5]}",
     "scene.yaml:5:29: error: output.histograms: expected times that ascend by more than "
     "5e-10, found 5 after 5"},
    {"histograms that are taken for one", "output: {histograms: [0, 5, 5.0000000001]}",
     "scene.yaml:5:29: error: output.histograms: expected times that ascend by more than "
     "5e-10, found 5.0000000001 after 5",
     Judge::parser},
    {"a histogram at no number", "output: {histograms: [0, .nan]}",
     "scene.yaml:5:26: error: output.histograms: expected a number from 0 to 15, found '.nan'"},
    {"a time outside a list", "output: {histograms: 5}",
     "scene.yaml:5:22: error: output.histograms: expected a list, found '5'; write [5]"},
    {"what is no time outside a list", "output: {histograms: none}",
     "scene.yaml:5:22: error: output.histograms: expected a list, found 'none'"},
    {"one bin", "output: {bins: q1}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "'q1'"},
    {"no bin", "output: {bins: q0}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "'q0'"},
    {"more bins than 1000", "output: {bins: q1001}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "'q1001'"},
    {"bins in words", "output: {bins: qx}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "'qx'"},
    {"bins in parts", "output: {bins: q20.5}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "'q20.5'"},
    {"a zero before the bins", "output: {bins: q020}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "'q020'"},
    {"a sign before the bins", "output: {bins: q-20}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "'q-20'"},
    {"bins without number", "output: {bins: q}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "'q'"},
    {"a number of bins without q", "output: {bins: 20}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "'20'"},
    {"a list of bins", "output: {bins: [0, 1]}",
     "scene.yaml:5:16: error: output.bins: expected q2 to q1000 or {width: WIDTH, end: END}, found "
     "a list"},
    {"bins without width", "output: {bins: {width: 0, end: 15}}",
     "scene.yaml:5:24: error: output.bins.width: expected a number above 0 and up to 1000000, "
     "found '0'"},
    {"bins wider than all", "output: {bins: {width: 20, end: 15}}",
     "scene.yaml:5:24: error: output.bins.width: expected a number from 0.0015 to 15 for at most "
     "10000 bins up to 15, found '20'",
     Judge::parser},
    {"more narrow bins than 10000", "output: {bins: {width: 0.001, end: 15}}",
     "scene.yaml:5:24: error: output.bins.width: expected a number from 0.0015 to 15 for at most "
     "10000 bins up to 15, found '0.001'",
     Judge::parser},
    {"bins without end", "output: {bins: {width: 0.5}}",
     "scene.yaml:5:16: error: output.bins: key 'end' is missing"},
    {"bins with a number", "output: {bins: {width: 0.5, end: 15, count: 30}}",
     "scene.yaml:5:38: error: unknown key 'count' in output.bins (allowed: width, end)"},
});

}  // namespace

std::span<const BadScene> bad_gas_outputs() {
  return kBadGasOutputs;
}

}  // namespace clca::scene::testing
