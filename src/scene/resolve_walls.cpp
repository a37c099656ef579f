// Walls and their motions as the text of a scene.

#include <fmt/format.h>

#include "scene/names.hpp"
#include "scene/resolve_text.hpp"

namespace clca::scene {

namespace {

std::string text(const lattice::Rectangle& box) {
  return fmt::format("box: {}", rectangle(box));
}
std::string text(const lattice::Segment& line) {
  return fmt::format("line: {{from: {}, to: {}, thickness: {}}}", point(line.from), point(line.to),
                     line.thickness);
}
std::string text(const lattice::Disc& disc) {
  return fmt::format("disc: {{centre: {}, radius: {}}}", point(disc.centre), disc.radius);
}
std::string text(const lattice::Ring& ring) {
  return fmt::format("ring: {{centre: {}, radius: {}, thickness: {}}}", point(ring.centre),
                     ring.radius, ring.thickness);
}
std::string text(const lattice::Arc& arc) {
  return fmt::format("arc: {{centre: {}, radius: {}, thickness: {}, from: {}, to: {}}}",
                     point(arc.ring.centre), arc.ring.radius, arc.ring.thickness, arc.from, arc.to);
}

std::string part_text(const WallPart& part) {
  return std::visit([](const auto& form) { return text(form); }, part);
}

std::string parts_text(const std::vector<WallPart>& parts) {
  const auto item = [](const WallPart& part) { return fmt::format("{{{}}}", part_text(part)); };
  return parts.size() == 1 ? part_text(parts.front()) : fmt::format("parts: {}", list(parts, item));
}

std::string program(const grains::Drive& drive) {
  return fmt::format("period: {}, distance: {}", drive.period, drive.distance);
}
std::string program(const grains::Wave& wave) {
  return fmt::format("wave: {{form: {}, amplitude: {}, period: {}}}",
                     name_of(kWaveformNames, wave.form), wave.amplitude, wave.period);
}
std::string program(const grains::Shake& shake) {
  return fmt::format("shake: {{amplitude: {}, wait: {}{}}}", shake.amplitude,
                     shake.wait ? std::to_string(*shake.wait) : "settled",
                     shake.period ? fmt::format(", period: {}", *shake.period) : "");
}
std::string program(const grains::Path& path) {
  return fmt::format("path: {}", list(path.points, [](const grains::Path::Point& point) {
                       return fmt::format("[{}, {}]", point.step, point.offset);
                     }));
}

}  // namespace

std::string wall_line(const Wall& wall) {
  std::string line = fmt::format("  {}: {{{}", name(wall.name), parts_text(wall.parts));
  if (wall.motion) {
    line +=
        fmt::format(", motion: {{direction: {}, {}}}, passive: {}",
                    name_of(kDirectionNames, wall.motion->direction),
                    std::visit([](const auto& one) { return program(one); }, wall.motion->program),
                    name_of(kPassiveNames, wall.passive));
  }
  if (wall.friction) {
    line += fmt::format(", friction: {}", *wall.friction);
  }
  return line + "}\n";
}

}  // namespace clca::scene
