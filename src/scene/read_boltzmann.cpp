// The block of a scene of the Boltzmann equation.

#include <fmt/format.h>

#include <algorithm>

#include "clca/boltzmann/law.hpp"
#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

void read_restitutions(const KeyedMap& fields, BoltzmannScene& scene) {
  const Value& value = fields.at("restitution");
  const std::string path = fields.path("restitution");
  scene.restitutions.clear();
  scene.lists_restitutions = value.is(Value::Kind::list);
  if (!scene.lists_restitutions) {
    scene.restitutions = {read_number(value, path, 0, 1)};
    return;
  }
  for (const Value& item : read_list(value, path, 1, kMaxRestitutions)) {
    const double restitution = read_number(item, path, 0, 1);
    if (std::find(scene.restitutions.begin(), scene.restitutions.end(), restitution) !=
        scene.restitutions.end()) {
      fail(item.location,
           fmt::format("{}: {} is named twice; name each value once", path, found(item)));
    }
    scene.restitutions.push_back(restitution);
  }
}

/// What the contact does to sliding; see boltzmann::Law.
void read_contact(const KeyedMap& fields, BoltzmannScene& scene) {
  if (fields.find("friction") == nullptr && fields.find("roughness") == nullptr) {
    fail(fields.location(), "boltzmann: expected friction, roughness or both, found none");
  }
  scene.friction = fields.number("friction", 0, kMaxFriction, boltzmann::kNoSlidingLimit);
  scene.roughness = fields.number("roughness", -1, 1, 0);
}

/// Refuses a key that only the other scheme has.
void refuse_key(const KeyedMap& fields, std::string_view key, std::string_view scheme) {
  if (const Value* value = fields.find(key)) {
    fail(value->location,
         fmt::format("{}: only scheme: {} has it; leave it out, or change the scheme",
                     fields.path(key), scheme));
  }
}

void read_scheme(const KeyedMap& fields, BoltzmannScene& scene) {
  if (fields.choice("scheme", kSchemeNames, std::size_t{0}) == 0) {
    refuse_key(fields, "time_step", "ogawa-kato");
    refuse_key(fields, "partners", "ogawa-kato");
    scene.scheme = boltzmann::Majorant{};
    scene.shear_rate = fields.number("shear_rate", 0, kMaxShearRate, scene.shear_rate);
    return;
  }
  refuse_key(fields, "shear_rate", "majorant");
  boltzmann::OgawaKato scheme;
  scheme.time_step = fields.positive("time_step", kMaxTimeStep, scheme.time_step);
  scheme.partners = fields.integer("partners", 1, kMaxPartners, scheme.partners);
  scheme.quasi = scene.quasi;
  scene.scheme = scheme;
}

}  // namespace

void read_boltzmann(const Value& value, BoltzmannScene& scene) {
  const KeyedMap fields(value, "boltzmann", kBoltzmannKeys);
  scene.particles = fields.count("particles", kMinGasParticles, kMaxGasParticles, scene.particles);
  scene.initial = fields.choice("initial", kInitialNames, scene.initial);
  scene.exact_moments = fields.boolean("exact_moments", scene.exact_moments);
  scene.quasi = fields.choice("sampling", kSamplingNames, scene.quasi);
  read_restitutions(fields, scene);
  read_contact(fields, scene);
  scene.energy_ratio = fields.number("energy_ratio", 0, kMaxEnergyRatio, scene.energy_ratio);
  read_scheme(fields, scene);
  scene.until = fields.positive("until", kMaxTime, scene.until);
  scene.ensemble = fields.count("ensemble", 1, kMaxEnsemble, scene.ensemble);
}

}  // namespace clca::scene
