// Wrong stages.

#include <array>

#include "bad_scenes.hpp"

namespace clca::scene::testing {

namespace {

constexpr auto kBadStages = std::to_array<BadScene>({
    {"a rule of a stage that is out of range", "stages: [{name: first, rules: {inertia: 2}}]",
     "scene.yaml:10:41: error: stages.first.rules.inertia: expected a number from 0 to 1, found "
     "'2'"},
    {"friction of a stage without the contact model",
     "stages: [{name: first, contact: {friction: 0}}]",
     "scene.yaml:10:24: error: stages.first.contact: only model contact has it; remove it, or say "
     "'model: contact'",
     Judge::parser},
    {"a deposition with the gravity of the stage",
     "stages: [{name: first, rules: {gravity: up}, fill: {method: deposition, region: [0, 0, 20, "
     "20], counts: {small: 1}}}]",
     "scene.yaml:10:61: error: stages.first.fill.method: deposition needs rules.gravity: down",
     Judge::parser},
    {"a stage that never comes to rest by its rules",
     "stages: [{name: first, rules: {candidates: all}}]",
     "scene.yaml:10:10: error: stages.first.until: never comes to rest with rules.candidates: all; "
     "give max_steps",
     Judge::parser},
    {"no stages", "stages: []",
     "scene.yaml:10:9: error: stages: expected 1 to 1000 items, found 0"},
    {"stages in a map", "stages: {first: {until: settled}}",
     "scene.yaml:10:9: error: stages: expected a list, found a map"},
    {"a stage that is a word", "stages: [settle]",
     "scene.yaml:10:10: error: stages.0: expected a map (allowed: name, fill, remove, insert, "
     "move, sources, vessel, rules, contact, until, max_steps), found 'settle'"},
    {"a stage without a name", "stages: [{until: settled}]",
     "scene.yaml:10:10: error: stages.0: key 'name' is missing"},
    {"a stage with a name that is no file name", "stages: [{name: a/b}]",
     "scene.yaml:10:17: error: stages.a/b.name: a name has 1 to 64 of the characters A-Z a-z 0-9 _ "
     "-, "
     "found 'a/b'"},
    {"two stages of one name",
     "stages:\n"
     "  - {name: first, sources: [spout]}\n"
     "  - {name: first}",
     "scene.yaml:12:12: error: stages: the name 'first' is taken", Judge::parser},
    {"a misspelt key of a stage",
     "stages:\n"
     "  - name: first\n"
     "    untill: settled",
     "scene.yaml:12:5: error: unknown key 'untill' in stages.first (allowed: name, fill, remove, "
     "insert, move, sources, vessel, rules, contact, until, max_steps); did you mean 'until'?"},
    {"a fill without a region", "stages: [{name: first, fill: {counts: {small: 5}}}]",
     "scene.yaml:10:30: error: stages.first.fill: key 'region' is missing"},
    {"an unknown method of filling",
     "stages: [{name: first, fill: {method: rain, region: [0, 0, 50, 50], counts: {small: 5}}}]",
     "scene.yaml:10:39: error: stages.first.fill.method: expected one of random, deposition, found "
     "'rain'"},
    {"a fill without counts", "stages: [{name: first, fill: {region: [0, 0, 50, 50]}}]",
     "scene.yaml:10:30: error: stages.first.fill: expected exactly one of counts, mix, picture, "
     "found "
     "none"},
    {"a fill with counts and a mix",
     "stages: [{name: first, fill: {region: [0, 0, 50, 50], counts: {small: 5}, mix: {small: 1}}}]",
     "scene.yaml:10:30: error: stages.first.fill: expected exactly one of counts, mix, picture, "
     "found "
     "counts and mix"},
    {"a mix of nothing", "stages: [{name: first, fill: {region: [0, 0, 50, 50], mix: {small: 0}}}]",
     "scene.yaml:10:60: error: stages.first.fill.mix: expected a weight above 0", Judge::parser},
    {"a level of a fill at random",
     "stages: [{name: first, fill: {region: [0, 0, 50, 50], mix: {small: 1}, level: 20}}]",
     "scene.yaml:10:79: error: stages.first.fill.level: needs a mix and 'method: deposition'",
     Judge::parser},
    {"a level above the region",
     "stages: [{name: first, fill: {method: deposition, region: [0, 0, 50, 50], mix: {small: 1}, "
     "level: 51}}]",
     "scene.yaml:10:99: error: stages.first.fill.level: expected a height in the region, above 0 "
     "and up to 50, found 51",
     Judge::parser},
    {"a picture of species without species",
     "stages: [{name: first, fill: {region: [0, 0, 50, 50], picture: {rows: [A]}}}]",
     "scene.yaml:10:64: error: stages.first.fill.picture: key 'pixels' is missing"},
    {"a picture with a letter of no species",
     "stages: [{name: first, fill: {region: [0, 0, 50, 50], picture: {rows: [AB], pixels: {A: "
     "small}}}}]",
     "scene.yaml:10:85: error: stages.first.fill.picture.pixels: no species for the pixels B",
     Judge::parser},
    {"a picture of an unknown species",
     "stages: [{name: first, fill: {region: [0, 0, 50, 50], picture: {rows: [A], pixels: {A: "
     "smal}}}}]",
     "scene.yaml:10:88: error: stages.first.fill.picture.pixels.A: unknown species 'smal' (known: "
     "small, large); did you mean 'small'?",
     Judge::parser},
    {"rows of a picture with colours",
     "stages: [{name: first, fill: {region: [0, 0, 50, 50], picture: {rows: [A], pixels: {A: "
     "small}, colors: {\"#d55e00\": small}}}}]",
     "scene.yaml:10:104: error: stages.first.fill.picture.colors: goes with 'file'", Judge::parser},
    {"a fill outside the box",
     "stages: [{name: first, fill: {region: [0, 50, 50, 60], counts: {small: 5}}}]",
     "scene.yaml:10:39: error: stages.first.fill.region: no site of the box, 100 wide and 50 "
     "high, lies in [0, 50, 50, 60]",
     Judge::parser},
    {"a fill of an unknown species",
     "stages: [{name: first, fill: {region: [0, 0, 50, 50], counts: {lage: 5}}}]",
     "scene.yaml:10:64: error: stages.first.fill.counts: unknown species 'lage' (known: "
     "small, large); did you mean 'large'?",
     Judge::parser},
    {"half a particle",
     "stages: [{name: first, fill: {region: [0, 0, 50, 50], counts: {small: 0.5}}}]",
     "scene.yaml:10:71: error: stages.first.fill.counts.small: expected a whole number from 0 "
     "to 2147483647, found '0.5'"},
    {"a wall that is not there", "stages: [{name: first, remove: [rihgt], sources: [spout]}]",
     "scene.yaml:10:33: error: stages.first.remove: unknown wall 'rihgt' (known: left, "
     "right); did you mean 'right'?",
     Judge::parser},
    {"a wall outside a list", "stages: [{name: first, remove: right, sources: [spout]}]",
     "scene.yaml:10:32: error: stages.first.remove: expected a list, found 'right'; write [right]"},
    {"a name of no wall outside a list", "stages: [{name: first, remove: nosuch}]",
     "scene.yaml:10:32: error: stages.first.remove: expected a list, found 'nosuch'"},
    {"a wall twice in one list",
     "stages: [{name: first, remove: [right, right], sources: [spout]}]",
     "scene.yaml:10:40: error: stages.first.remove: 'right' is named twice"},
    {"a wall that is gone already",
     "stages:\n"
     "  - {name: first, remove: [right], sources: [spout]}\n"
     "  - {name: second, remove: [left, right]}",
     "scene.yaml:12:35: error: stages.second.remove: wall 'right' is gone since stage 'first'",
     Judge::parser},
    {"a source that is not there", "stages: [{name: first, sources: [rain]}]",
     "scene.yaml:10:34: error: stages.first.sources: unknown source 'rain' (known: spout)",
     Judge::parser},
    {"a misspelt end", "stages: [{name: first, sources: [spout], until: setled}]",
     "scene.yaml:10:49: error: stages.first.until: expected settled, {steps: N}, {discharged: "
     "SHARE}, {cycles: N} or {time: T}, found 'setled'; did you mean 'settled'?"},
    {"a misspelt key of an end", "stages: [{name: first, sources: [spout], until: {step: 5}}]",
     "scene.yaml:10:50: error: unknown key 'step' in stages.first.until (allowed: steps, "
     "discharged, cycles, time); did you mean 'steps'?"},
    {"two ends", "stages: [{name: first, sources: [spout], until: {steps: 5, discharged: 1}}]",
     "scene.yaml:10:49: error: stages.first.until: expected exactly one of steps, discharged, "
     "cycles, time, found steps and discharged"},
    {"an end after 0 steps", "stages: [{name: first, sources: [spout], until: {steps: 0}}]",
     "scene.yaml:10:57: error: stages.first.until.steps: expected a whole number from 1 to "
     "1000000000000, found '0'"},
    {"a share of 0", "stages: [{name: first, sources: [spout], until: {discharged: 0}}]",
     "scene.yaml:10:62: error: stages.first.until.discharged: expected a number above 0 and "
     "up to 1, found '0'"},
    {"a share above 1", "stages: [{name: first, sources: [spout], until: {discharged: 90}}]",
     "scene.yaml:10:62: error: stages.first.until.discharged: expected a number above 0 and "
     "up to 1, found '90'"},
    {"a discharge without an outlet",
     "outlets: {}\n"
     "stages: [{name: first, sources: [spout], until: {discharged: 0.9}}]",
     "scene.yaml:10:49: error: stages.first.until: nothing can be discharged, the scene has "
     "no outlets",
     Judge::parser},
    {"a bound below the steps asked for",
     "stages: [{name: first, sources: [spout], until: {steps: 50}, max_steps: 9}]",
     "scene.yaml:10:73: error: stages.first.max_steps: 9 is less than the 50 steps of until",
     Judge::parser},
    {"a rest that never comes, since all directions are open", "rules: {candidates: all}",
     "scene.yaml:10:10: error: stages.first.until: never comes to rest with rules.candidates: "
     "all; give max_steps",
     Judge::parser},
    {"a rest that never comes, since everything slides round and round",
     "box: {width: 100, height: 100, periodic: true}\n"
     "rules: {gravity: down_right}",
     "scene.yaml:10:10: error: stages.first.until: never comes to rest with a sideways "
     "rules.gravity in a periodic box; give max_steps",
     Judge::parser},
    {"a rest that never comes, since a source never ends",
     "sources: {spout: {at: [20, 40], rate: 1}}",
     "scene.yaml:10:10: error: stages.first.until: never comes to rest while source 'spout' "
     "is open, which has no count; give max_steps",
     Judge::parser},
    {"no particles",
     "sources: {}\n"
     "stages: [{name: first, fill: {region: [0, 0, 50, 50], counts: {small: 0}}}]",
     "scene.yaml:10:9: error: stages: no particles; give a stage a fill or a source, "
     "or begin with another run",
     Judge::parser},
});

}  // namespace

std::span<const BadScene> bad_stages() {
  return kBadStages;
}

}  // namespace clca::scene::testing
