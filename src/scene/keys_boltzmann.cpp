// The block of a scene of the Boltzmann equation.

#include <algorithm>

#include "clca/boltzmann/law.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

void read_restitutions(const Value& value, const std::string& path, BoltzmannScene& scene) {
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
  const Type<double> one = number(0, 1);
  Key<BoltzmannScene> key;
  key.name = "restitution";
  key.about = "ε, normal restitution; of a list, one run for each, in that order";
  key.allowed = fmt::format("0 to 1, or a list of 1 to {} different ones", kMaxRestitutions);
  key.required = true;
  key.schema = [=] {
    return Json{{"anyOf",
                 {one.schema(),
                  {{"type", "array"},
                   {"items", one.schema()},
                   {"minItems", 1},
                   {"maxItems", kMaxRestitutions},
                   {"uniqueItems", true}}}}};
  };
  key.read = [](const KeyedMap& fields, BoltzmannScene& scene, const Scene& /*scene*/) {
    read_restitutions(fields.at("restitution"), fields.path("restitution"), scene);
  };
  key.text = [](const BoltzmannScene& scene, const Scene& /*scene*/) {
    Yaml list = Yaml::list({});
    for (const double restitution : scene.restitutions) {
      list.items.push_back(Yaml::number(restitution));
    }
    return std::optional(scene.lists_restitutions ? list : list.items.front());
  };
  return key;
}

/// Without it nothing slides; see boltzmann::Law.
Key<BoltzmannScene> friction_key() {
  auto result = key("friction", &BoltzmannScene::friction, number(0, kMaxFriction),
                    "η of Coulomb; without it, but with a roughness, nothing slides")
                    .defaults_to("see below");
  result.text = [text = result.text](const BoltzmannScene& scene, const Scene& grains) {
    return scene.friction != boltzmann::kNoSlidingLimit ? text(scene, grains) : std::nullopt;
  };
  return result;
}

/// The scheme by its index.
Key<BoltzmannScene> scheme_key() {
  auto key = described<BoltzmannScene>(
      "scheme", choice(kSchemeNames),
      "pairs in continuous time; or the time steps of the paper, which are biased");
  const std::string otherwise(name_of(kSchemeNames, BoltzmannScene().scheme.index()));
  key.otherwise = fmt::format("`{}`", otherwise);
  key.default_value = Yaml::scalar(otherwise);
  key.read = [](const KeyedMap& fields, BoltzmannScene& scene, const Scene& /*scene*/) {
    const Value* value = fields.find("scheme");
    if (value != nullptr && read_choice(*value, fields.path("scheme"), kSchemeNames) > 0) {
      scene.scheme = boltzmann::OgawaKato{.quasi = scene.quasi};
    }
  };
  key.text = [](const BoltzmannScene& scene, const Scene& /*scene*/) {
    return std::optional(Yaml::scalar(std::string(name_of(kSchemeNames, scene.scheme.index()))));
  };
  return key;
}

/// Refuses a key that only the other scheme has.
void refuse_key(const KeyedMap& fields, const std::string& key, const BoltzmannScene& scene) {
  if (const Value* value = fields.find(key)) {
    fail(value->location,
         fmt::format("{}: only scheme: {} has it; leave it out, or change the scheme",
                     fields.path(key), name_of(kSchemeNames, 1 - scene.scheme.index())));
  }
}

/// A member of OgawaKato.
template <class T>
Key<BoltzmannScene> ogawa_kato_key(const std::string& name, T boltzmann::OgawaKato::*member,
                                   const Type<T>& type, const std::string& about) {
  const auto part = key(name, member, type, about);
  Key<BoltzmannScene> result;
  result.describe_as(part);
  result.read = [=](const KeyedMap& fields, BoltzmannScene& scene, const Scene& grains) {
    if (auto* scheme = std::get_if<boltzmann::OgawaKato>(&scene.scheme)) {
      part.read(fields, *scheme, grains);
    } else {
      refuse_key(fields, name, scene);
    }
  };
  result.text = [=](const BoltzmannScene& scene, const Scene& grains) {
    const auto* scheme = std::get_if<boltzmann::OgawaKato>(&scene.scheme);
    return scheme != nullptr ? part.text(*scheme, grains) : std::nullopt;
  };
  return result;
}

Key<BoltzmannScene> shear_rate_key() {
  auto result =
      key("shear_rate", &BoltzmannScene::shear_rate, number(0, kMaxShearRate),
          "of `majorant` only: velocity gradient of uniform shear flow, per unit of time");
  const auto has_it = [](const BoltzmannScene& scene) {
    return std::holds_alternative<boltzmann::Majorant>(scene.scheme);
  };
  result.read = [=, read = result.read](const KeyedMap& fields, BoltzmannScene& scene,
                                        const Scene& grains) {
    if (has_it(scene)) {
      read(fields, scene, grains);
    } else {
      refuse_key(fields, "shear_rate", scene);
    }
  };
  result.text = [=, text = result.text](const BoltzmannScene& scene, const Scene& grains) {
    return has_it(scene) ? text(scene, grains) : std::nullopt;
  };
  return result;
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
  const Json in_steps = {{"required", {"scheme"}},
                         {"properties", {{"scheme", {{"const", "ogawa-kato"}}}}}};
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
      .conditions = [=] {
        return Json{{"anyOf", {{{"required", {"friction"}}}, {{"required", {"roughness"}}}}},
                    {"dependencies",
                     {{"time_step", in_steps},
                      {"partners", in_steps},
                      {"shear_rate", {{"not", in_steps}}}}}};
      }};
  auto block = section("boltzmann", map,
                       "the gas, what a collision does, and for how long: [boltzmann](#boltzmann)");
  block.required = true;
  return block;
}

}  // namespace clca::scene
