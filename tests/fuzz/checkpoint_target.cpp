// Any bytes behind a right checksum header, read as a checkpoint: refused, or the same once written
// and read again, and within the limit of memory. The same bytes also say which numbers of a right
// checkpoint are changed: it is refused, or a run goes on with it.

#include <iterator>
#include <optional>
#include <stdexcept>

#include "choices.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/checkpoint.hpp"
#include "memory_meter.hpp"
#include "run/stage.hpp"
#include "store/checksum_header.hpp"
#include "target.hpp"

namespace {

namespace fuzz = clca::fuzz;
namespace reflection = clca::reflection;
namespace model = clca::model;
namespace run = clca::run;
namespace scene = clca::scene;
namespace store = clca::store;

constexpr store::FileKind kKind = {"checkpoint", 4};
constexpr double kLimit = 1e6;
constexpr double kBeside = 1e5;  // zlib, a block of bytes

std::optional<store::Checkpoint> read(const std::vector<std::uint8_t>& file, double limit) {
  const fuzz::MemoryMeter meter;
  try {
    store::Checkpoint checkpoint = store::parse_checkpoint(file, limit);
    fuzz::require(fuzz::MemoryMeter::max_bytes() <= limit + kBeside, "more memory than the limit");
    return checkpoint;
  } catch (const std::runtime_error&) {
    fuzz::require(fuzz::MemoryMeter::max_bytes() <= limit + kBeside, "more memory than the limit");
    return std::nullopt;
  }
}

const scene::Scene& contact_scene() {
  static const scene::Scene kScene = scene::parse(R"(clca: 1
model: contact
box: {width: 16, height: 20}
species: {grain: {shape: {hexagon: 1}}, large: {shape: {hexagon: 2}}}
walls: {post: {box: [6, 0, 7, 4]}}
outlets: {below: {region: [10, 0, 16, 4]}}
sources: {spout: {region: [2, 15, 12, 18], species: {grain: 1}, rate: 0.05, count: 3}}
contact: {fall_height: 10}
stages:
  - {name: fall, fill: {region: [0, 0, 12, 14], counts: {grain: 9, large: 2}}, sources: [spout], until: {steps: 400}}
)",
                                                  "small.yaml");
  return kScene;
}

reflection::Columns saved_columns() {
  const scene::Scene& scene = contact_scene();
  model::SceneModel model(scene, run::state_at_start(scene), {});
  run::prepare_stage(model, scene, 0);
  for (std::uint64_t step = 0; step < *scene::fixed_steps(scene.stages.front().until); ++step) {
    model.grains().step();
  }
  reflection::Columns columns;
  model.save(columns);
  return columns;
}

void change(reflection::Columns& columns, fuzz::Choices& choices) {
  constexpr std::uint32_t kMaxLength = 200;
  for (std::size_t changes = choices.up_to(6); changes > 0; --changes) {
    const auto which = choices.up_to(static_cast<std::uint32_t>(columns.size() - 1));
    const auto column = std::next(columns.begin(), static_cast<std::ptrdiff_t>(which));
    std::visit(
        [&]<class T>(std::vector<T>& values) {
          const std::size_t how = choices.up_to(3);
          if (how == 0) {
            values.resize(choices.up_to(kMaxLength));
          } else if (!values.empty()) {
            T& value = values[choices.up_to(0xFF) % values.size()];
            value = how == 1   ? values[choices.up_to(0xFF) % values.size()]
                    : how == 2 ? static_cast<T>(choices.up_to(0xFF))
                               : choices.any<T>();
          }
        },
        column->second);
  }
}

void go_on(std::span<const std::uint8_t> bytes) {
  static const reflection::Columns kSaved = saved_columns();
  fuzz::Choices choices(bytes);
  const scene::Scene& scene = contact_scene();
  reflection::Columns columns = kSaved;
  change(columns, choices);
  try {
    model::SceneModel(scene, model::state_from_checkpoint(scene, columns, kLimit), {})
        .grains()
        .step();
  } catch (const std::invalid_argument&) {
    fuzz::require(!bytes.empty(), "a run does not go on");
  } catch (const reflection::ColumnMismatch&) {
    fuzz::require(!bytes.empty(), "a run does not go on");
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = store::with_header(kKind, {data, size});
  const auto checkpoint = read(file, kLimit);
  if (checkpoint) {
    const auto again = store::checkpoint_bytes(*checkpoint);
    const auto read_again = read(again, 10 * kLimit);
    fuzz::require(read_again && store::checkpoint_bytes(*read_again) == again,
                  "read again as something else");
  }
  go_on({data, size});
  return 0;
}
