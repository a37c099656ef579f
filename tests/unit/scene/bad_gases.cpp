// Wrong in the block of a scene of the Boltzmann equation.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kBadGases = std::to_array<BadScene>({
    {"no particles", "boltzmann: {restitution: 0.5, friction: 0.3, particles: 0}",
     "scene.yaml:4:57: error: boltzmann.particles: expected a whole number from 2 to 100000000, "
     "found '0'"},
    {"a lonely particle", "boltzmann: {restitution: 0.5, friction: 0.3, particles: 1}",
     "scene.yaml:4:57: error: boltzmann.particles: expected a whole number from 2 to 100000000, "
     "found '1'"},
    {"too many particles", "boltzmann: {restitution: 0.5, friction: 0.3, particles: 100000001}",
     "scene.yaml:4:57: error: boltzmann.particles: expected a whole number from 2 to 100000000, "
     "found '100000001'"},
    {"half a particle", "boltzmann: {restitution: 0.5, friction: 0.3, particles: 2.5}",
     "scene.yaml:4:57: error: boltzmann.particles: expected a whole number from 2 to 100000000, "
     "found '2.5'"},
    {"an unknown beginning", "boltzmann: {restitution: 0.5, friction: 0.3, initial: gausian}",
     "scene.yaml:4:55: error: boltzmann.initial: expected one of gaussian, equal_energy, found "
     "'gausian'; did you mean 'gaussian'?"},
    {"moments that are neither", "boltzmann: {restitution: 0.5, friction: 0.3, exact_moments: 1}",
     "scene.yaml:4:61: error: boltzmann.exact_moments: expected true or false, found '1'"},
    {"an unknown sampling", "boltzmann: {restitution: 0.5, friction: 0.3, sampling: sobol}",
     "scene.yaml:4:56: error: boltzmann.sampling: expected one of random, quasi, found 'sobol'"},
    {"no restitution", "boltzmann: {friction: 0.3}",
     "scene.yaml:4:12: error: boltzmann: key 'restitution' is missing"},
    {"a restitution above 1", "boltzmann: {restitution: 1.01, friction: 0.3}",
     "scene.yaml:4:26: error: boltzmann.restitution: expected a number from 0 to 1, found '1.01'"},
    {"a restitution below 0", "boltzmann: {restitution: -0.1, friction: 0.3}",
     "scene.yaml:4:26: error: boltzmann.restitution: expected a number from 0 to 1, found '-0.1'"},
    {"a restitution that is no number", "boltzmann: {restitution: .nan, friction: 0.3}",
     "scene.yaml:4:26: error: boltzmann.restitution: expected a number from 0 to 1, found '.nan'"},
    {"a restitution in words", "boltzmann: {restitution: elastic, friction: 0.3}",
     "scene.yaml:4:26: error: boltzmann.restitution: expected a number from 0 to 1, found "
     "'elastic'"},
    {"no restitution in the list", "boltzmann: {restitution: [], friction: 0.3}",
     "scene.yaml:4:26: error: boltzmann.restitution: expected 1 to 64 items, found 0"},
    {"more restitutions than 64",
     "boltzmann: {restitution: [0.101, 0.102, 0.103, 0.104, 0.105, 0.106, 0.107, 0.108, 0.109, "
     "0.110, 0.111, 0.112, 0.113, 0.114, 0.115, 0.116, 0.117, 0.118, 0.119, 0.120, 0.121, 0.122, "
     "0.123, 0.124, 0.125, 0.126, 0.127, 0.128, 0.129, 0.130, 0.131, 0.132, 0.133, 0.134, 0.135, "
     "0.136, 0.137, 0.138, 0.139, 0.140, 0.141, 0.142, 0.143, 0.144, 0.145, 0.146, 0.147, 0.148, "
     "0.149, 0.150, 0.151, 0.152, 0.153, 0.154, 0.155, 0.156, 0.157, 0.158, 0.159, 0.160, 0.161, "
     "0.162, 0.163, 0.164, 0.165], friction: 0}",
     "scene.yaml:4:26: error: boltzmann.restitution: expected 1 to 64 items, found 65"},
    {"a restitution twice", "boltzmann: {restitution: [0.5, 0.7, 0.50], friction: 0.3}",
     "scene.yaml:4:37: error: boltzmann.restitution: '0.50' is named twice; name each value "
     "once"},
    {"a list in the list", "boltzmann: {restitution: [0.5, [0.7]], friction: 0.3}",
     "scene.yaml:4:32: error: boltzmann.restitution: expected a number from 0 to 1, found a list"},
    {"one restitution of the list above 1", "boltzmann: {restitution: [0.5, 5], friction: 0.3}",
     "scene.yaml:4:32: error: boltzmann.restitution: expected a number from 0 to 1, found '5'"},
    {"a map for a restitution", "boltzmann: {restitution: {normal: 1}, friction: 0.3}",
     "scene.yaml:4:26: error: boltzmann.restitution: expected a number from 0 to 1, found a map"},
    {"neither friction nor roughness", "boltzmann: {restitution: 0.5}",
     "scene.yaml:4:12: error: boltzmann: expected friction, roughness or both, found none"},
    {"a negative friction", "boltzmann: {restitution: 0.5, friction: -0.3}",
     "scene.yaml:4:41: error: boltzmann.friction: expected a number from 0 to 1000, found '-0.3'"},
    {"an infinite friction", "boltzmann: {restitution: 0.5, friction: .inf}",
     "scene.yaml:4:41: error: boltzmann.friction: expected a number from 0 to 1000, found '.inf'"},
    {"a friction of the limit without sliding", "boltzmann: {restitution: 0.5, friction: 1e300}",
     "scene.yaml:4:41: error: boltzmann.friction: expected a number from 0 to 1000, found '1e300'"},
    {"a roughness below -1", "boltzmann: {restitution: 0.5, roughness: -1.5}",
     "scene.yaml:4:42: error: boltzmann.roughness: expected a number from -1 to 1, found '-1.5'"},
    {"a roughness above 1", "boltzmann: {restitution: 0.5, friction: 0.3, roughness: 2}",
     "scene.yaml:4:57: error: boltzmann.roughness: expected a number from -1 to 1, found '2'"},
    {"a negative ratio of energies",
     "boltzmann: {restitution: 0.5, friction: 0.3, energy_ratio: -1}",
     "scene.yaml:4:60: error: boltzmann.energy_ratio: expected a number from 0 to 1000000, found "
     "'-1'"},
    {"an unknown scheme", "boltzmann: {restitution: 0.5, friction: 0.3, scheme: ogawa_kato}",
     "scene.yaml:4:54: error: boltzmann.scheme: expected one of majorant, ogawa-kato, found "
     "'ogawa_kato'; did you mean 'ogawa-kato'?"},
    {"a time step without steps", "boltzmann: {restitution: 0.5, friction: 0.3, time_step: 0.025}",
     "scene.yaml:4:57: error: boltzmann.time_step: only scheme: ogawa-kato has it; leave it out, "
     "or change the scheme"},
    {"partners without steps",
     "boltzmann: {restitution: 0.5, friction: 0.3, scheme: majorant, partners: 10}",
     "scene.yaml:4:74: error: boltzmann.partners: only scheme: ogawa-kato has it; leave it out, or "
     "change the scheme"},
    {"a time step of 0",
     "boltzmann: {restitution: 0.5, friction: 0.3, scheme: ogawa-kato, time_step: 0}",
     "scene.yaml:4:77: error: boltzmann.time_step: expected a number above 0 and up to 1, found "
     "'0'"},
    {"a time step above 1",
     "boltzmann: {restitution: 0.5, friction: 0.3, scheme: ogawa-kato, time_step: 1.5}",
     "scene.yaml:4:77: error: boltzmann.time_step: expected a number above 0 and up to 1, found "
     "'1.5'"},
    {"no partners", "boltzmann: {restitution: 0.5, friction: 0.3, scheme: ogawa-kato, partners: 0}",
     "scene.yaml:4:76: error: boltzmann.partners: expected a whole number from 1 to 1000, found "
     "'0'"},
    {"shear in steps",
     "boltzmann: {restitution: 0.5, friction: 0.3, scheme: ogawa-kato, shear_rate: 1}",
     "scene.yaml:4:78: error: boltzmann.shear_rate: only scheme: majorant has it; leave it out, or "
     "change the scheme"},
    {"a negative shear rate", "boltzmann: {restitution: 0.5, friction: 0.3, shear_rate: -1}",
     "scene.yaml:4:58: error: boltzmann.shear_rate: expected a number from 0 to 100, found '-1'"},
    {"no time at all", "boltzmann: {restitution: 0.5, friction: 0.3, until: 0}",
     "scene.yaml:4:53: error: boltzmann.until: expected a number above 0 and up to 1000000000, "
     "found '0'"},
    {"time without end", "boltzmann: {restitution: 0.5, friction: 0.3, until: .inf}",
     "scene.yaml:4:53: error: boltzmann.until: expected a number above 0 and up to 1000000000, "
     "found '.inf'"},
    {"no run at all", "boltzmann: {restitution: 0.5, friction: 0.3, ensemble: 0}",
     "scene.yaml:4:56: error: boltzmann.ensemble: expected a whole number from 1 to 10000, found "
     "'0'"},
    {"a misspelt key of the gas", "boltzmann: {restitution: 0.5, friction: 0.3, restitutoin: 1}",
     "scene.yaml:4:46: error: unknown key 'restitutoin' in boltzmann (allowed: particles, initial, "
     "exact_moments, sampling, restitution, friction, roughness, energy_ratio, scheme, time_step, "
     "partners, shear_rate, until, ensemble); did you mean 'restitution'?"},
    {"a list for a gas", "boltzmann: [0.5]",
     "scene.yaml:4:12: error: boltzmann: expected a map (allowed: particles, initial, "
     "exact_moments, sampling, restitution, friction, roughness, energy_ratio, scheme, time_step, "
     "partners, shear_rate, until, ensemble), found a list"},
    {"a misspelt block that comes second", "boltzman: {}",
     "scene.yaml:6:1: error: unknown key 'boltzman' (allowed: clca, let, title, seed, boltzmann, "
     "output); did you mean 'boltzmann'?"},
    {"a gas in a box", "box: {width: 9, height: 9}",
     "scene.yaml:6:1: error: 'box' does not go with 'boltzmann': a scene of the Boltzmann equation "
     "has the keys clca, let, title, seed, boltzmann, output; one of grains has clca, let, title, "
     "seed, model, begin, box, species, rules, contact, voids, baxter, units, walls, sources, "
     "outlets, "
     "probes, "
     "lines, "
     "stages, "
     "measure, "
     "output"},
    {"a gas with measures", "measure: []",
     "scene.yaml:6:1: error: 'measure' does not go with 'boltzmann': a scene of the Boltzmann "
     "equation has the keys clca, let, title, seed, boltzmann, output; one of grains has clca, "
     "let, title, "
     "seed, model, begin, box, species, rules, contact, voids, baxter, units, walls, sources, "
     "outlets, "
     "probes, "
     "lines, "
     "stages, "
     "measure, "
     "output"},
    {"more than a million rows by default",
     "boltzmann: {restitution: 1, friction: 0, until: 1e9}\noutput: {}",
     "scene.yaml:4:49: error: output.series.every: expected at least 1000, as a series has at most "
     "1000000 rows until 1000000000, found the default 0.5",
     Judge::parser},
});

}  // namespace

std::span<const BadScene> bad_gases() {
  return kBadGases;
}

}  // namespace clca::scene::testing
