#include "clca/run/setup.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>
#include <thread>
#include <utility>

#include "clca/lattice/shape.hpp"
#include "clca/process/data_folder.hpp"
#include "clca/run/run.hpp"
#include "clca/scene/resolve.hpp"
#include "clca/scene/walls.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/text/message.hpp"
#include "run/observer.hpp"

namespace clca::run {

namespace {

constexpr double kShareOfMemory = 0.8;

/// Available memory without swapping; file caches count as free.
double available_bytes() {
  std::ifstream meminfo("/proc/meminfo");
  std::string key;
  for (double kibibytes = 0; meminfo >> key >> kibibytes;) {
    if (key == "MemAvailable:") {
      return 1024 * kibibytes;
    }
    meminfo.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  const auto pages = static_cast<double>(::sysconf(_SC_AVPHYS_PAGES));
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

std::string scene_file(const std::string& name) {
  std::error_code error;
  const std::filesystem::path path(name);
  const bool is_as_in_documents = path == "scenes" / path.stem().replace_extension(".yaml");
  if ((name.find_first_of("/.") != std::string::npos && !is_as_in_documents) ||
      std::filesystem::exists(path, error)) {
    return name;
  }
  const auto scenes = process::data_files("scenes", ".yaml");
  if (const auto scene = scenes.find(is_as_in_documents ? path.stem().string() : name);
      scene != scenes.end()) {
    return scene->second.string();
  }
  std::vector<std::string_view> names;
  for (const auto& scene : scenes) {
    names.push_back(scene.first);
  }
  if (text::nearest(name, names)) {
    throw scene::SceneError(
        fmt::format("{}:1:1: error: cannot read the file: No such file or directory{}",
                    text::printable(name), text::suggestion(name, names)));
  }
  return name;
}

int machine_threads() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

double default_memory_limit() {
  return kShareOfMemory * available_bytes();
}

double memory_of(const scene::Scene& scene) {
  const scene::Size size = scene::size_of(scene);
  const auto particles = static_cast<double>(size.particles);
  double bytes = size.bytes + checkpoint_bytes(scene, particles);
  for (const ObserverKind& kind : observer_kinds()) {
    bytes += kind.bytes ? kind.bytes(scene, particles) : 0;
  }
  return bytes;
}

void check_memory(const scene::Scene& scene, double limit) {
  if (const double bytes = memory_of(scene); bytes > limit) {
    const scene::Size size = scene::size_of(scene);
    throw scene::SceneError(fmt::format(
        "{}: error: the scene needs about {:.0f} MiB of memory for {} x {} sites and {} particles, "
        "more than the limit of {:.0f} MiB; make the box smaller or raise --memory-limit",
        scene.box.location, bytes / kMebibyte, size.columns, size.rows, size.particles,
        limit / kMebibyte));
  }
}

void check_memory(const scene::BoltzmannScene& scene, double limit, int threads) {
  const double bytes = scene::bytes_of(scene, threads);
  if (bytes > limit) {
    throw scene::SceneError(fmt::format(
        "{}: error: the scene needs about {:.0f} MiB of memory for {} particles on {} threads, "
        "more than the limit of {:.0f} MiB; take fewer particles or threads, write fewer rows and "
        "bins, or raise --memory-limit",
        scene.location, bytes / kMebibyte, scene.particles, threads, limit / kMebibyte));
  }
}

void check_memory(const scene::AnyScene& scene, double limit, int threads) {
  if (const auto* grains = std::get_if<scene::Scene>(&scene)) {
    check_memory(*grains, limit);
  } else {
    check_memory(std::get<scene::BoltzmannScene>(scene), limit, threads);
  }
}

void complete(scene::AnyScene& scene, const std::string& file, double limit, int threads) {
  if (auto* grains = std::get_if<scene::Scene>(&scene)) {
    check_derived(*grains);
    find_begin(*grains, limit);
  }
  scene::check_resolved(std::visit([](const auto& held) { return scene::to_yaml(held); }, scene),
                        file);
  check_memory(scene, limit, threads);
}

void check_output(const std::string& file, const std::filesystem::path& folder) {
  std::error_code unknown;
  if (std::filesystem::equivalent(file, folder / store::kSceneFile, unknown)) {
    throw SceneRunError(
        fmt::format("{}: error: the run would replace this file; run in another folder, or with "
                    "--keep",
                    file));
  }
}

namespace {

constexpr int kDegreesPerOrientation = 60;
constexpr double kMaxFraction = 0x1p53;  // of numerator and denominator

std::vector<grains::Kind> kinds_of(const scene::Species& species, std::uint16_t number) {
  std::vector<grains::Kind> kinds;
  for (const int degrees : species.orientations) {
    grains::Kind kind = {lattice::centred(species.shape.rotated(degrees / kDegreesPerOrientation)),
                         number};
    const bool known = std::any_of(kinds.begin(), kinds.end(), [&](const grains::Kind& other) {
      return other.shape.congruent(kind.shape);
    });
    if (!known) {
      kinds.push_back(std::move(kind));
    }
  }
  return kinds;
}

/// Divides the weight of a species among its kinds, in integers.
std::vector<std::uint32_t> kind_weights(const grains::State& state,
                                        const std::vector<std::uint32_t>& species_weights) {
  constexpr std::uint32_t kCommon = 60;  // divisible by 1 to 6
  std::vector<std::uint32_t> count(species_weights.size(), 0);
  for (const grains::Kind& kind : state.kinds) {
    ++count[kind.species];
  }
  std::vector<std::uint32_t> weights;
  for (const grains::Kind& kind : state.kinds) {
    weights.push_back(species_weights[kind.species] * (kCommon / count[kind.species]));
  }
  return weights;
}

/// Sets rate and unit to a fraction: the first convergent of the continued fraction that rounding
/// could have made this number, so that p particles come in exactly q steps at the rate p/q, and
/// the sum over any number of steps is right. Fractions of 2^32 keep that as their unit.
void set_rate(grains::Source& source, double rate) {
  const double rounding = 2 * (std::nextafter(rate, kMaxFraction) - rate);
  double p_before = 0;
  double q_before = 1;
  double p = 1;
  double q = 0;
  double rest = rate;
  do {
    const double whole = std::floor(rest);
    p_before = std::exchange(p, whole * p + p_before);
    q_before = std::exchange(q, whole * q + q_before);
    rest = 1 / (rest - whole);
  } while (std::abs(p / q - rate) > rounding && std::max(p, q) < kMaxFraction);
  const double times = std::fmod(0x1p32, q) == 0 ? 0x1p32 / q : 1;
  source.rate = static_cast<std::uint64_t>(times * p);
  source.unit = static_cast<std::uint64_t>(times * q);
}

grains::Source make_source(const grains::State& state, const scene::Source& source) {
  grains::Source result;
  if (const auto* point = std::get_if<Eigen::Vector2d>(&source.position)) {
    result.sites = {lattice::nearest_site(*point)};
  } else {
    result.sites = lattice::sites_in(state.lattice, std::get<lattice::Rectangle>(source.position));
  }
  result.weights = kind_weights(state, source.weights);
  set_rate(result, source.rate);
  result.count = source.count.value_or(std::numeric_limits<std::uint64_t>::max());
  return result;
}

}  // namespace

grains::State initial_state(const scene::Scene& scene) {
  scene::check_walls(scene);
  grains::State state{
      .lattice = lattice::Lattice::covering(scene.box.width, scene.box.height, scene.box.periodic),
      .seed = scene.seed};
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const auto number = static_cast<std::uint16_t>(i);
    const std::vector<grains::Kind> kinds = scene.model == scene::Model::baxter
                                                ? baxter::kinds_along_axes(number)
                                                : kinds_of(scene.species[i], number);
    state.kinds.insert(state.kinds.end(), kinds.begin(), kinds.end());
  }
  const std::vector<bool> there = scene::walls_present_at_start(scene);
  for (std::size_t number = 0; number < scene.walls.size(); ++number) {
    const scene::Wall& wall = scene.walls[number];
    state.walls.push_back({.sites = scene::wall_sites(state.lattice, wall),
                           .present = there[number],
                           .motion = wall.motion,
                           .passive = wall.passive});
  }
  for (const scene::Source& source : scene.sources) {
    state.sources.push_back(make_source(state, source));
  }
  for (const scene::Outlet& outlet : scene.outlets) {
    state.outlets.push_back({.region = outlet.region});
  }
  return state;
}

}  // namespace clca::run
