// The void model.

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

Type<voids::Rules> voids_type() {
  return type_of<voids::Rules>(
      {.keys = {key("straight", &voids::Rules::straight, number(0, 1),
                    "weight of the grain straight above a void; the two beside it share the "
                    "rest: 1/3 is equal chances")}});
}

}  // namespace clca::scene
