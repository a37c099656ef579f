#include "clca/scene/scene.hpp"

#include <tuple>

namespace clca::scene {

namespace {

// What counts when two are compared: everything but names of files and places in them.

auto content(const Box& box) {
  return std::tie(box.width, box.height, box.periodic);
}

auto content(const Fill& fill) {
  return std::tie(fill.method, fill.region, fill.counts);
}

auto content(const Wall& wall) {
  return std::tie(wall.name, wall.parts, wall.motion, wall.passive, wall.friction);
}

auto content(const Stage& stage) {
  return std::tie(stage.name, stage.fill, stage.remove, stage.insert, stage.move, stage.sources,
                  stage.vessel, stage.until, stage.max_steps);
}

auto content(const Outlet& outlet) {
  return std::tie(outlet.name, outlet.region);
}

auto content(const Frames& frames) {
  return std::tie(frames.every, frames.width, frames.height, frames.color_by, frames.layers,
                  frames.view, frames.drawing, frames.supersampling, frames.caption, frames.upright,
                  frames.force_scale, frames.overlay);
}

auto content(const Scene& scene) {
  return std::tie(scene.title, scene.seed, scene.model, scene.box, scene.species, scene.rules,
                  scene.contact, scene.units, scene.walls, scene.sources, scene.outlets,
                  scene.stages, scene.measures, scene.output);
}

}  // namespace

std::optional<std::uint64_t> steps_of(const Until& until) {
  if (const auto* time = std::get_if<UntilTime>(&until)) {
    return time->steps;
  }
  const auto* steps = std::get_if<UntilSteps>(&until);
  return steps != nullptr ? std::optional(steps->steps) : std::nullopt;
}

bool Box::operator==(const Box& other) const {
  return content(*this) == content(other);
}

bool Fill::operator==(const Fill& other) const {
  return content(*this) == content(other);
}

bool Outlet::operator==(const Outlet& other) const {
  return content(*this) == content(other);
}

bool Frames::operator==(const Frames& other) const {
  return content(*this) == content(other);
}

bool Scene::operator==(const Scene& other) const {
  return content(*this) == content(other);
}

bool Stage::operator==(const Stage& other) const {
  return content(*this) == content(other);
}

bool vessel_has_cycles(const Stage& stage) {
  return stage.vessel && !std::holds_alternative<Tilt>(*stage.vessel);
}

bool Wall::operator==(const Wall& other) const {
  return content(*this) == content(other);
}

}  // namespace clca::scene
