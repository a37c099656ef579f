#pragma once
// Keys of the scene format, each declared once: the parser, the resolved scene, the JSON Schema,
// the tables of docs/scene-format.md and `clca explain` follow from the declaration.

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "clca/scene/scene.hpp"
#include "scene/keyed_map.hpp"
#include "scene/yaml_text.hpp"

namespace clca::scene {

/// Built on demand: only `clca explain` needs it.
using Schema = std::function<Json()>;

struct KeyDescription;
/// Shared, since types and keys are copied into each other.
using Descriptions = std::shared_ptr<const std::vector<KeyDescription>>;

/// A key as users see it. Texts are Markdown.
struct KeyDescription {
  std::string name;
  std::string about;                       ///< one phrase
  std::string allowed;                     ///< values
  std::string otherwise = {};              ///< what holds if it is left out
  std::optional<Yaml> default_value = {};  ///< the same, if it is a value
  bool required = false;
  std::optional<Model> model = {};  ///< the only one that has it
  bool is_collection = false;       ///< its value has names or numbers above the keys
  Schema schema = {};               ///< of the value alone
  Descriptions keys = {};           ///< of the map that the value is; null: none
};

/// A kind of values: how they are read, written and described.
template <class T>
struct Type {
  std::string allowed;
  Schema schema;
  /// `scene` as far as it has been read. Throws SceneError.
  std::function<T(const Value& value, const std::string& path, const Scene& scene)> read;
  std::function<Yaml(const T& value, const Scene& scene)> text;
  Descriptions keys = {};
  bool is_collection = false;
};

/// A key of a map that is read into an Owner.
template <class Owner>
struct Key : KeyDescription {
  /// Leaves the default of the Owner if the key is absent, or throws SceneError if it is required.
  std::function<void(const KeyedMap& fields, Owner& owner, const Scene& scene)> read;
  /// Its value; none if it is left out.
  std::function<std::optional<Yaml>(const Owner& owner, const Scene& scene)> text;

  void describe_as(const KeyDescription& other) { static_cast<KeyDescription&>(*this) = other; }
  /// Has an effect in one model only.
  Key of(Model only) const {
    Key result = *this;
    result.model = only;
    return result;
  }
  /// Described by a phrase, where the default is no value or follows from other keys.
  Key defaults_to(const std::string& phrase) const {
    Key result = *this;
    result.otherwise = phrase;
    result.default_value.reset();
    return result;
  }
};

template <class Owner>
using Keys = std::vector<Key<Owner>>;

/// A map that is read into an Owner.
template <class Owner>
struct Map {
  Keys<Owner> keys = {};
  Owner start = {};  ///< with the defaults
  /// What depends on several keys, once they have been read.
  std::function<void(const KeyedMap& fields, Owner& owner, const Scene& scene)> check = {};
  Schema conditions = {};  ///< the same as far as a schema can say it
};

/// Without backticks and addresses of links.
std::string without_markup(std::string text);
/// What the key is for, without markup.
std::string meaning(const KeyDescription& key);
/// Of a map with these keys.
Json map_schema(const Descriptions& keys, const Schema& conditions);

template <class Owner>
Descriptions descriptions(const Keys<Owner>& keys) {
  return std::make_shared<const std::vector<KeyDescription>>(keys.begin(), keys.end());
}

template <class Owner, class T>
Key<Owner> described(const std::string& name, const Type<T>& type, const std::string& about) {
  Key<Owner> key;
  key.name = name;
  key.about = about;
  key.allowed = type.allowed;
  key.schema = type.schema;
  key.keys = type.keys;
  key.is_collection = type.is_collection;
  return key;
}

/// A member of the Owner.
template <class Owner, class T>
Key<Owner> required(const std::string& name, T Owner::*member, const Type<T>& type,
                    const std::string& about) {
  auto key = described<Owner>(name, type, about);
  key.required = true;
  key.read = [=](const KeyedMap& fields, Owner& owner, const Scene& scene) {
    owner.*member = type.read(fields.at(name), fields.path(name), scene);
  };
  key.text = [=](const Owner& owner, const Scene& scene) {
    return std::optional(type.text(owner.*member, scene));
  };
  return key;
}

/// A member of the Owner that has this default.
template <class Owner, class T>
Key<Owner> key(const std::string& name, T Owner::*member, const Type<T>& type,
               const std::string& about, const std::type_identity_t<T>& otherwise) {
  auto key = required(name, member, type, about);
  const Yaml text = type.text(otherwise, Scene());
  key.required = false;
  key.otherwise = fmt::format("`{}`", flow_text(text));
  key.default_value = text;
  key.read = [=](const KeyedMap& fields, Owner& owner, const Scene& scene) {
    if (const Value* value = fields.find(name)) {
      owner.*member = type.read(*value, fields.path(name), scene);
    }
  };
  return key;
}

/// A member of the Owner, whose default is that of the struct.
template <class Owner, class T>
Key<Owner> key(const std::string& name, T Owner::*member, const Type<T>& type,
               const std::string& about) {
  return key(name, member, type, about, Owner().*member);
}

/// A member of the Owner that may have no value.
template <class Owner, class T>
Key<Owner> key(const std::string& name, std::optional<T> Owner::*member, const Type<T>& type,
               const std::string& about) {
  auto key = described<Owner>(name, type, about);
  key.read = [=](const KeyedMap& fields, Owner& owner, const Scene& scene) {
    if (const Value* value = fields.find(name)) {
      owner.*member = type.read(*value, fields.path(name), scene);
    }
  };
  key.text = [=](const Owner& owner, const Scene& scene) {
    return owner.*member ? std::optional(type.text(*(owner.*member), scene)) : std::nullopt;
  };
  return key;
}

/// A list that may be left out, and is where it is empty.
template <class Owner, class T>
Key<Owner> list_key(const std::string& name, std::vector<T> Owner::*member,
                    const Type<std::vector<T>>& type, const std::string& about) {
  auto result = key(name, member, type, about, {}).defaults_to("none");
  result.text = [=](const Owner& owner, const Scene& scene) {
    return (owner.*member).empty() ? std::nullopt : std::optional(type.text(owner.*member, scene));
  };
  return result;
}

/// One of several keys of which exactly one is given: `T` of the variant.
template <class Variant, class T>
Key<Variant> alternative(const std::string& name, const Type<T>& type, const std::string& about) {
  auto key = described<Variant>(name, type, about);
  key.read = [=](const KeyedMap& fields, Variant& variant, const Scene& scene) {
    if (const Value* value = fields.find(name)) {
      variant = type.read(*value, fields.path(name), scene);
    }
  };
  key.text = [=](const Variant& variant, const Scene& scene) {
    const T* one = std::get_if<T>(&variant);
    return one != nullptr ? std::optional(type.text(*one, scene)) : std::nullopt;
  };
  return key;
}

/// The key of a member of the Owner as a key of the Owner itself.
template <class Owner, class Part>
Key<Owner> inlined(Part Owner::*member, const Key<Part>& part) {
  Key<Owner> key;
  key.describe_as(part);
  key.read = [=](const KeyedMap& fields, Owner& owner, const Scene& scene) {
    part.read(fields, owner.*member, scene);
  };
  key.text = [=](const Owner& owner, const Scene& scene) {
    return part.text(owner.*member, scene);
  };
  return key;
}

/// Reads all keys in their order, then checks. Throws SceneError.
template <class Owner>
void read_fields(const KeyedMap& fields, const Map<Owner>& map, Owner& owner, const Scene& scene) {
  for (const Key<Owner>& key : map.keys) {
    if (key.model && *key.model != scene.model) {
      fields.refuse_foreign(key.name, *key.model);
      continue;
    }
    key.read(fields, owner, scene);
  }
  if (map.check) {
    map.check(fields, owner, scene);
  }
}

template <class Owner>
Owner read_fields(const Value& value, const std::string& path, const Map<Owner>& map,
                  const Scene& scene) {
  const std::vector<std::string_view> names = names_of(map.keys);
  Owner owner = map.start;
  read_fields(KeyedMap(value, path, names), map, owner, scene);
  return owner;
}

/// Those keys that have a value, in their order.
template <class Owner>
Yaml text_of(const Keys<Owner>& keys, const Owner& owner, const Scene& scene) {
  Yaml map = Yaml::map({});
  for (const Key<Owner>& key : keys) {
    if (key.model && *key.model != scene.model) {
      continue;
    }
    if (auto text = key.text(owner, scene)) {
      map.entries.push_back({key.name, std::move(*text)});
    }
  }
  return map;
}

/// A map as the value of a key.
template <class Owner>
Type<Owner> type_of(Map<Owner> of) {
  const auto map = std::make_shared<const Map<Owner>>(std::move(of));
  const Descriptions keys = descriptions(map->keys);
  return {.allowed = "map",
          .schema = [=] { return map_schema(keys, map->conditions); },
          .read = [=](const Value& value, const std::string& path,
                      const Scene& scene) { return read_fields(value, path, *map, scene); },
          .text = [=](const Owner& owner,
                      const Scene& scene) { return text_of(map->keys, owner, scene); },
          .keys = keys};
}

/// A map of which all that is left out is as in a member of the scene.
template <class Owner>
Type<Owner> changed(Owner Scene::*member, Keys<Owner> keys) {
  for (Key<Owner>& key : keys) {
    key = key.defaults_to("as in the scene");
  }
  const auto map = std::make_shared<const Map<Owner>>(Map<Owner>{.keys = std::move(keys)});
  Type<Owner> type = type_of(*map);
  type.read = [=](const Value& value, const std::string& path, const Scene& scene) {
    const std::vector<std::string_view> names = names_of(map->keys);
    Owner owner = scene.*member;
    read_fields(KeyedMap(value, path, names), *map, owner, scene);
    return owner;
  };
  return type;
}

/// A map that is read into the same Owner.
template <class Owner>
Key<Owner> section(const std::string& name, Map<Owner> of, const std::string& about) {
  const auto map = std::make_shared<const Map<Owner>>(std::move(of));
  auto key = described<Owner>(name, type_of(*map), about);
  key.read = [=](const KeyedMap& fields, Owner& owner, const Scene& scene) {
    if (const Value* value = fields.find(name)) {
      const std::vector<std::string_view> names = names_of(map->keys);
      read_fields(KeyedMap(*value, fields.path(name), names), *map, owner, scene);
    }
  };
  key.text = [=](const Owner& owner, const Scene& scene) {
    return std::optional(text_of(map->keys, owner, scene));
  };
  return key;
}

/// A struct of which only this member is given.
template <class Owner, class T>
Type<Owner> as(T Owner::*member, const Type<T>& type) {
  return {.allowed = type.allowed,
          .schema = type.schema,
          .read =
              [=](const Value& value, const std::string& path, const Scene& scene) {
                Owner owner;
                owner.*member = type.read(value, path, scene);
                return owner;
              },
          .text = [=](const Owner& owner,
                      const Scene& scene) { return type.text(owner.*member, scene); },
          .keys = type.keys};
}

/// A map with exactly one of the keys.
template <class Variant>
Type<Variant> one_of(Keys<Variant> keys) {
  Map<Variant> map = {.keys = std::move(keys)};
  map.check = [names = descriptions(map.keys)](const KeyedMap& fields, Variant& /*owner*/,
                                               const Scene& /*scene*/) {
    fields.only(names_of(*names));
  };
  map.conditions = [] { return Json{{"minProperties", 1}, {"maxProperties", 1}}; };
  return type_of(std::move(map));
}

/// `none`, or a value of the type.
template <class T>
Type<std::optional<T>> or_none(const Type<T>& type) {
  return {.allowed = fmt::format("`none`, {}", type.allowed),
          .schema =
              [=] {
                return Json{{"anyOf", {{{"const", "none"}}, type.schema()}}};
              },
          .read = [type](const Value& value, const std::string& path,
                         const Scene& scene) -> std::optional<T> {
            if (is_none(value)) {
              return std::nullopt;
            }
            require_map_or_none(value, path);
            return type.read(value, path, scene);
          },
          .text =
              [type](const std::optional<T>& value, const Scene& scene) {
                return value ? type.text(*value, scene) : Yaml::scalar("none");
              },
          .keys = type.keys};
}

}  // namespace clca::scene
