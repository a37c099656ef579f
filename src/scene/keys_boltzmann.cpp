// The block of a scene of the Boltzmann equation.

#include <algorithm>

#include "clca/boltzmann/law.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

void read_restitutions(const KeyedMap& fields, BoltzmannScene& scene, const Scene& /*scene*/) {
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

Key<BoltzmannScene> restitution_key() {
  const Schema restitution = number_schema(0, 1);
  return own_key<BoltzmannScene>(
      {.name = "restitution",
       .about = "ε, normal restitution; of a list, one run for each, in that order",
       .allowed = fmt::format("0 to 1, or a list of 1 to {} different ones", kMaxRestitutions),
       .required = true,
       .schema = any_of({restitution, unique(array_schema(restitution, 1, kMaxRestitutions))})},
      read_restitutions, [](const BoltzmannScene& scene, const Scene& /*scene*/) {
        const Yaml list = numbers_text(scene.restitutions);
        return std::optional(scene.lists_restitutions ? list : list.items.front());
      });
}

/// Without it nothing slides; see boltzmann::Law.
Key<BoltzmannScene> friction_key() {
  return key("friction", &BoltzmannScene::friction, number(0, kMaxFriction),
             "η of Coulomb, of rough spheres")
      .defaults_to("nothing slides")
      .written_as([](const BoltzmannScene& scene, const Scene& /*scene*/) {
        return scene.friction != boltzmann::kNoSlidingLimit
                   ? std::optional(Yaml::number(scene.friction))
                   : std::nullopt;
      });
}

bool is_majorant(const BoltzmannScene& scene) {
  return std::holds_alternative<boltzmann::Majorant>(scene.scheme);
}

/// Refuses a key that only the other scheme has.
void refuse_key(const KeyedMap& fields, const std::string& key, const BoltzmannScene& scene) {
  if (const Value* value = fields.find(key)) {
    fail(value->location,
         fmt::format("{}: only scheme: {} has it; leave it out, or change the scheme",
                     fields.path(key), name_of(kSchemeNames, 1 - scene.scheme.index())));
  }
}

void read_scheme(const KeyedMap& fields, BoltzmannScene& scene, const Scene& /*scene*/) {
  const Value* value = fields.find("scheme");
  if (value != nullptr && read_choice(*value, fields.path("scheme"), kSchemeNames) > 0) {
    scene.scheme = boltzmann::OgawaKato{.quasi = scene.quasi};
  } else {
    refuse_key(fields, "time_step", scene);
    refuse_key(fields, "partners", scene);
  }
}

/// The scheme by its index.
Key<BoltzmannScene> scheme_key() {
  const auto scheme_text = [](const BoltzmannScene& scene, const Scene& /*scene*/) {
    return std::optional(Yaml::scalar(std::string(name_of(kSchemeNames, scene.scheme.index()))));
  };
  KeyDescription description =
      described("scheme", choice(kSchemeNames),
                "pairs in continuous time; or the time steps of the paper, which are biased");
  description.default_value = scheme_text({}, {});
  description.otherwise = fmt::format("`{}`", flow_text(*description.default_value));
  return own_key<BoltzmannScene>(description, read_scheme, scheme_text);
}

/// A member of OgawaKato.
template <class T>
Key<BoltzmannScene> ogawa_kato_key(std::string_view name, T boltzmann::OgawaKato::*member,
                                   const Type<T>& type, std::string_view about) {
  return inlined_alternative(&BoltzmannScene::scheme, key(name, member, type, about));
}

Key<BoltzmannScene> shear_rate_key() {
  return key("shear_rate", &BoltzmannScene::shear_rate, number(0, kMaxShearRate),
             "of `majorant` only: velocity gradient of uniform shear flow, per unit of time")
      .after([](const KeyedMap& fields, BoltzmannScene& scene, const Scene& /*scene*/) {
        if (!is_majorant(scene)) {
          refuse_key(fields, "shear_rate", scene);
        }
      })
      .written_as([](const BoltzmannScene& scene, const Scene& /*scene*/) {
        return is_majorant(scene) ? std::optional(Yaml::number(scene.shear_rate)) : std::nullopt;
      });
}

void check_block(const KeyedMap& fields, BoltzmannScene& scene, const Scene& /*scene*/) {
  if (fields.find("friction") == nullptr) {
    if (fields.find("roughness") == nullptr) {
      fail(fields.location(), "boltzmann: expected friction, roughness or both, found none");
    }
    scene.friction = boltzmann::kNoSlidingLimit;
  }
  scene.histograms = {0, scene.until};
}

}  // namespace

Key<BoltzmannScene> boltzmann_block() {
  using B = BoltzmannScene;
  Map<B> map = {
      .keys =
          {key("particles", &B::particles, count(kMinGasParticles, kMaxGasParticles),
               "size of the sample"),
           key("initial", &B::initial, choice(kInitialNames),
               "velocities and spins normal and independent, or the same speed and the same spin "
               "for all, directions isotropic"),
           key("exact_moments", &B::exact_moments, yes_or_no(),
               "shifts and scales the sample so that both means are zero and both mean squares "
               "exact"),
           key("sampling", &B::quasi, choice(kSamplingNames),
               "draws of the beginning, and all draws of `ogawa-kato`: independent, or from a "
               "randomly shifted lattice"),
           restitution_key(), friction_key(),
           key("roughness", &B::roughness, number(-1, 1),
               "β, tangential restitution where nothing slides: -1 smooth, 1 reversed"),
           key("energy_ratio", &B::energy_ratio, number(0, kMaxEnergyRatio),
               "C_e = I⟨ω²⟩/(m⟨v²⟩) at time 0"),
           scheme_key(),
           ogawa_kato_key("time_step", &boltzmann::OgawaKato::time_step, above_zero(kMaxTimeStep),
                          "of `ogawa-kato` only"),
           ogawa_kato_key("partners", &boltzmann::OgawaKato::partners, integer(1, kMaxPartners),
                          "of `ogawa-kato` only: how many each particle draws in a step"),
           shear_rate_key(), key("until", &B::until, above_zero(kMaxTime), "time at the end"),
           key("ensemble", &B::ensemble, count(1, kMaxEnsemble),
               "runs with seeds derived from `seed`, for means and their errors")},
      .check = check_block,
      .conditions = R"({
        "anyOf": [{"required": ["friction"]}, {"required": ["roughness"]}],
        "dependencies": {
          "time_step": {"required": ["scheme"], "properties": {"scheme": {"const": "ogawa-kato"}}},
          "partners": {"required": ["scheme"], "properties": {"scheme": {"const": "ogawa-kato"}}},
          "shear_rate": {"not": {"required": ["scheme"],
                                 "properties": {"scheme": {"const": "ogawa-kato"}}}}}})"};
  auto block = section("boltzmann", map,
                       "the gas, what a collision does, and for how long: [boltzmann](#boltzmann)");
  block.required = true;
  return block;
}

}  // namespace clca::scene
