#include "clca/scene/resolve.hpp"

#include <fmt/format.h>

#include "scene/names.hpp"
#include "scene/resolve_text.hpp"

namespace clca::scene {

namespace {

std::string sites(const std::vector<lattice::Axial>& all) {
  return list(all, [](lattice::Axial site) { return fmt::format("[{}, {}]", site.x, site.q); });
}

std::string shape(const HexagonSpec& spec) {
  return fmt::format("{{hexagon: {}}}", spec.radius);
}
std::string shape(const SitesSpec& spec) {
  return fmt::format("{{sites: {}}}", sites(spec.sites));
}
std::string shape(const PolygonSpec& spec) {
  return fmt::format("{{polygon: {}}}", sites(spec.corners));
}
std::string shape(const RodSpec& spec) {
  return fmt::format("{{rod: {{radius: {}, length: {}}}}}", spec.radius, spec.length);
}

std::string species_line(const Species& species) {
  const bool any = species.orientations == std::vector<int>{0, 60, 120, 180, 240, 300};
  const auto degrees = [](int angle) { return std::to_string(angle); };
  std::string line =
      fmt::format("  {}: {{shape: {}, orientations: {}", name(species.name),
                  std::visit([](const auto& spec) { return shape(spec); }, species.shape_spec),
                  any ? "any" : list(species.orientations, degrees));
  if (species.color) {
    line += fmt::format(", color: \"#{:02x}{:02x}{:02x}\"", species.color->red,
                        species.color->green, species.color->blue);
  }
  return line + "}\n";
}

std::string rules_block(const automaton::Rules& rules) {
  const auto text = [](automaton::UpdateClass one) { return name_of(kUpdateClassNames, one); };
  return fmt::format(
      "\nrules:\n  inertia: {}\n  scatter: {}\n  candidates: {}\n  gravity: {}\n"
      "  update_priority: {}\n  ties: {}\n",
      rules.inertia, rules.scatter, name_of(kCandidateNames, rules.candidates),
      name_of(kDirectionNames, rules.gravity), list(rules.update_priority, text),
      name_of(kTiesNames, rules.ties));
}

/// `{small: 3, large: 1}` without the species that are 0.
template <class Number>
std::string per_species(const std::vector<Number>& numbers, const Scene& scene) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] != 0) {
      parts.push_back(fmt::format("{}: {}", name(scene.species[i].name), numbers[i]));
    }
  }
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

std::string source_line(const Source& source, const Scene& scene) {
  const auto* at = std::get_if<Eigen::Vector2d>(&source.place);
  std::string line = fmt::format(
      "  {}: {{{}, species: {}, rate: {}", name(source.name),
      at != nullptr
          ? fmt::format("at: {}", point(*at))
          : fmt::format("region: {}", rectangle(std::get<lattice::Rectangle>(source.place))),
      per_species(source.weights, scene), source.rate);
  if (source.count) {
    line += fmt::format(", count: {}", *source.count);
  }
  return line + "}\n";
}

std::string outlet_line(const Outlet& outlet) {
  return fmt::format("  {}: {{region: {}}}\n", name(outlet.name), rectangle(outlet.region));
}

std::string until(const UntilSettled& /*end*/) {
  return "settled";
}
std::string until(const UntilSteps& end) {
  return fmt::format("{{steps: {}}}", end.steps);
}
std::string until(const UntilDischarged& end) {
  return fmt::format("{{discharged: {}}}", end.share);
}
std::string until(const UntilCycles& end) {
  return fmt::format("{{cycles: {}}}", end.cycles);
}
std::string until(const UntilTime& end) {
  return fmt::format("{{time: {}}}", end.time);
}

template <class Item>
std::string references(std::string_view key, const std::vector<std::size_t>& places,
                       const std::vector<Item>& things) {
  const auto text = [&](std::size_t index) { return name(things[index].name); };
  return places.empty() ? "" : fmt::format("    {}: {}\n", key, list(places, text));
}

std::string vessel(const Tilt& tilt) {
  return tilt.rate ? fmt::format("{{tilt: {{to: {}, rate: {}}}}}", tilt.to, *tilt.rate)
                   : fmt::format("{{tilt: {}}}", tilt.to);
}
std::string vessel(const Rotate& rotate) {
  return rotate.centre ? fmt::format("{{rotate: {{rate: {}, centre: {}}}}}", rotate.rate,
                                     point(*rotate.centre))
                       : fmt::format("{{rotate: {{rate: {}}}}}", rotate.rate);
}
std::string vessel(const VesselShake& shake) {
  return fmt::format("{{shake: {{gamma: {}, amplitude: {}, direction: {}}}}}", shake.gamma,
                     shake.amplitude, name_of(kShakeDirectionNames, shake.sideways));
}

std::string stage_block(const Stage& stage, const Scene& scene) {
  std::string block = fmt::format("  - name: {}\n", name(stage.name));
  if (stage.fill) {
    block += fmt::format("    fill: {{method: {}, region: {}, counts: {}}}\n",
                         name_of(kFillMethodNames, stage.fill->method),
                         rectangle(stage.fill->region), per_species(stage.fill->counts, scene));
  }
  block += references("remove", stage.remove, scene.walls);
  block += references("insert", stage.insert, scene.walls);
  block += references("move", stage.move, scene.walls);
  block += references("sources", stage.sources, scene.sources);
  if (stage.vessel) {
    block +=
        fmt::format("    vessel: {}\n",
                    std::visit([](const auto& motion) { return vessel(motion); }, *stage.vessel));
  }
  return block + fmt::format("    until: {}\n    max_steps: {}\n",
                             std::visit([](const auto& end) { return until(end); }, stage.until),
                             stage.max_steps);
}

std::string frames_block(const Frames& frames, Model model) {
  std::string block = fmt::format(
      "  frames:\n    every: {}\n    width: {}\n    height: {}\n    color_by: {}\n    layers: {}\n",
      frames.every, frames.width, frames.height, name_of(kColorByNames, frames.color_by),
      frames.layers);
  if (frames.view) {
    block += fmt::format("    view: {}\n", rectangle(*frames.view));
  }
  block += model == Model::contact ? fmt::format("    upright: {}\n", frames.upright) : "";
  if (frames.force_scale) {
    block += fmt::format("    force_scale: {}\n", *frames.force_scale);
  }
  return block +
         fmt::format("    drawing: {}\n    supersampling: {}\n    caption: {}\n    overlay: {}\n",
                     name_of(kDrawingNames, frames.drawing), frames.supersampling, frames.caption,
                     name_of(kOverlayNames, frames.overlay));
}

std::string output_block(const Output& output, Model model) {
  const auto every = [](const auto& table) {
    return table ? fmt::format("{{every: {}}}", table->every) : std::string("none");
  };
  const auto& fields = output.fields;
  const std::string contacts = output.contacts && model == Model::contact
                                   ? fmt::format("{{every: {}, window: {}}}",
                                                 output.contacts->every, output.contacts->window)
                                   : every(output.contacts);
  const std::string trajectory =
      output.trajectory && model == Model::contact
          ? fmt::format("{{every: {}, contacts: {}}}", output.trajectory->every,
                        output.trajectory->contacts)
          : every(output.trajectory);
  return fmt::format(
      "output:\n{}  series: {}\n  fields: {}\n  contacts: {}\n  trajectory: {}\n"
      "  checkpoint: {}\n",
      output.frames ? frames_block(*output.frames, model) : "  frames: none\n",
      every(output.series),
      fields ? fmt::format("{{cell: {}, every: {}}}", fields->cell, fields->every) : "none",
      contacts, trajectory, checkpoint_text(output.checkpoint));
}

/// `title:` and a line or block for each thing; nothing when there is none.
template <class Item, class Text>
std::string section(std::string_view title, const std::vector<Item>& things, Text text) {
  std::string result = things.empty() ? "" : fmt::format("\n{}:\n", title);
  for (const Item& thing : things) {
    result += text(thing);
  }
  return result;
}

}  // namespace

std::string to_yaml(const Scene& scene) {
  const auto measure = [](Measure one) { return name_of(kMeasureNames, one); };
  std::string text =
      fmt::format("clca: 1\ntitle: {}\nseed: {}\n", scene::quoted(scene.title), scene.seed);
  const bool contact = scene.model == Model::contact;
  text += contact ? fmt::format("model: {}\n", name_of(kModelNames, scene.model)) : "";
  text += fmt::format("\nbox: {{width: {}, height: {}, periodic: {}}}\n", scene.box.width,
                      scene.box.height, scene.box.periodic);
  text += section("species", scene.species, species_line);
  text += contact ? contact_block(scene.contact) : rules_block(scene.rules);
  text += scene.units ? units_line(*scene.units) : "";
  text += section("walls", scene.walls, wall_line);
  text += section("sources", scene.sources,
                  [&](const Source& source) { return source_line(source, scene); });
  text += section("outlets", scene.outlets, outlet_line);
  text += section("stages", scene.stages,
                  [&](const Stage& stage) { return stage_block(stage, scene); });
  text += fmt::format("\nmeasure: {}\n", list(scene.measures, measure));
  return text + output_block(scene.output, scene.model);
}

}  // namespace clca::scene
