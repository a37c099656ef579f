#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <string_view>

#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "clca/text/input_error.hpp"
#include "clca/text/message.hpp"
#include "report/sections.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxSceneText = 256 << 10;

/// Null if it is of no run.
const char* kind_text(const store::RunSummary& summary) {
  static const std::map<std::string_view, const char*> kTexts = {
      {"automaton", "Granular cellular automaton"},
      {"contact", "Lattice contact dynamics"},
      {"voids", "Rising voids"},
      {"baxter", "Elongated grains, Baxter & Behringer"},
      {"boltzmann", "Gas of rough spheres, Boltzmann equation"}};
  const auto found = kTexts.find(summary.kind);
  return found != kTexts.end() ? found->second : nullptr;
}

store::RunSummary summary_of(const fs::path& run) {
  try {
    const fs::path file = run / "run.json";
    store::RunSummary summary = store::read_summary(file);
    if (kind_text(summary) == nullptr) {
      throw store::StoreError(fmt::format("cannot read {}: no report of a run of kind '{}'",
                                          file.string(), summary.kind));
    }
    return summary;
  } catch (const store::StoreError& error) {
    throw text::InputError(error.what());
  }
}

/// The text of scene.yaml.
std::string read_scene_text(const fs::path& run, Warnings& warnings) {
  constexpr double kMaxBytes = 1 << 20;
  try {
    const auto text = store::read_whole(run / "scene.yaml", kMaxBytes);
    return {text.begin(), text.end()};
  } catch (const store::StoreError& error) {
    warnings.add(error.what());
    return "";
  }
}

bool is_gas(const store::RunSummary& summary) {
  return summary.kind == "boltzmann";
}

std::vector<std::pair<const char*, std::string>> facts_of(const store::RunSummary& summary) {
  std::vector<std::pair<const char*, std::string>> facts = {
      {"Seed", fmt::format("{}", summary.seed)},
      {"Particles", whole(summary.particles)},
      {"Steps", whole(summary.steps)}};
  if (summary.units) {
    facts.emplace_back("Time", escaped(summary.units->time_text(summary.steps)));
  }
  facts.emplace_back("Time taken", brief(summary.wall_seconds) + " s");
  facts.emplace_back(is_gas(summary) ? "Collisions per second" : "Particle updates per second",
                     brief(summary.rate));
  facts.emplace_back("Threads", whole(static_cast<std::uint64_t>(std::max(summary.threads, 0))));
  if (summary.ranks > 1) {
    facts.emplace_back("Ranks", whole(static_cast<std::uint64_t>(summary.ranks)));
  }
  facts.emplace_back("State hash", fmt::format("<code>{:016x}</code>", summary.state_hash));
  facts.emplace_back("Made by",
                     fmt::format("clca {} <small>{}, {}</small>", escaped(summary.version),
                                 escaped(summary.compiler), escaped(summary.build_type)));
  return facts;
}

/// The scene as a download, needed for the command.
std::string scene_html(const std::string& scene_text, const store::RunSummary& summary) {
  if (scene_text.empty()) {
    return {};
  }
  if (scene_text.size() > kMaxSceneText) {
    return "<p>The scene is too long to be shown here; it is in <code>scene.yaml</code> beside "
           "this page.</p>\n";
  }
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(scene_text.data()),
                        scene_text.size());
  return fmt::format(
      R"(<details><summary>The scene, with every default filled in</summary>
<p><a download="{}.yaml" href="data:text/yaml;base64,{}">Save it as a file</a></p>
<pre class="scene">{}</pre></details>
)",
      escaped(summary.scene), base64(bytes), escaped(scene_text));
}

std::string repeat_html(const std::string& scene_text, const store::RunSummary& summary) {
  const std::string result =
      summary.status == "done"
          ? fmt::format("comes to the state hash <code>{:016x}</code> with any number of threads",
                        summary.state_hash)
          : "goes the same way, with any number of threads, and on from where this run has ended";
  return fmt::format(
      R"(<p>The same scene and seed give the same bits: clca {} on the scene below {}.</p>
<pre>clca run {} --seed {} -o {}</pre>
{})",
      escaped(summary.version), result, escaped(text::shell_word(summary.scene + ".yaml")),
      summary.seed, escaped(text::shell_word(summary.scene)), scene_html(scene_text, summary));
}

}  // namespace

std::string files_html(const fs::path& folder) {
  constexpr std::size_t kMaxItems = 100;
  std::vector<std::string> files = file_names(folder);
  std::erase_if(files, [](const std::string& name) { return !name.ends_with(".csv"); });
  std::string items;
  for (std::size_t i = 0; i < std::min(files.size(), kMaxItems); ++i) {
    items += fmt::format("<li><code>{}</code></li>", escaped(files[i]));
  }
  return items.empty() ? items
                       : fmt::format(
                             R"(<p>The tables that this page is drawn from lie in the folder:</p>
<ul class="files">{}{}</ul>
)",
                             items, files.size() > kMaxItems ? "<li>…</li>" : "");
}

Page run_page(const fs::path& run, std::optional<std::size_t> max_frames, Warnings& warnings) {
  const store::RunSummary summary = summary_of(run);
  const std::string scene = read_scene_text(run, warnings);
  return {.title = summary.title.empty() ? summary.scene : summary.title,
          .kind = kind_text(summary),
          .status = summary.status,
          .scene = summary.scene,
          .facts = facts_of(summary),
          .sections = {{"pictures", "Pictures", frames_html(run, summary, max_frames, warnings)},
                       {"measures", "Measures", measures_html(summary)},
                       {"figures", "Figures", figures_html(run, warnings)},
                       {"walls", "Walls", walls_html(run, summary, warnings)},
                       {"repeat", "How to repeat it", repeat_html(scene, summary)},
                       {"files", "Tables", files_html(run)}}};
}

}  // namespace clca::report
