#pragma once
// Keys of the scene format, each declared once: the parser, the resolved scene, the JSON Schema,
// the tables of docs/scene-format.md and `clca explain` follow from the declaration.
// Only declarations know C++ types: Type, Key and Map check them. What reads and writes works with
// pointers to void (AnyType, AnyKey), so that it is compiled once and not for each key.

#include <fmt/format.h>

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "clca/scene/scene.hpp"
#include "scene/place.hpp"

namespace clca::scene {

/// An object of a JSON Schema, as text: parsed only for `clca explain` and for the words
/// of a key. What is put into it holds nothing that JSON escapes.
using Schema = std::string;

struct AnyKey;
/// Shared, since types and keys are copied into each other.
using AnyKeys = std::shared_ptr<const std::vector<AnyKey>>;

/// The schema with more members, given as the text between the brackets of a JSON object.
Schema with(const Schema& schema, std::string_view more);

/// Text that matches the pattern.
Schema text_schema(std::string_view pattern);
/// Text that matches the pattern, in quotes or not.
Schema scalar_schema(std::string_view pattern);
Schema word_schema(std::string_view word);

/// Member of a schema: the array has no equal items.
inline constexpr std::string_view kUniqueItems = R"("uniqueItems": true)";

Schema any_of(const std::vector<Schema>& schemas);
Schema array_schema(const Schema& items);
Schema array_schema(const Schema& items, std::size_t least, std::size_t most);
/// An object whose names match the pattern.
Schema object_schema(const Schema& value, std::string_view pattern);

/// A kind of values: how they are read, written and described.
struct AnyType {
  std::string allowed;  ///< Markdown: which values, such as `0 to 1`
  Schema schema;
  /// Reads into a default value of the type. Throws SceneError.
  std::function<void(const PlacedValue& place, void* result)> read_into = {};
  std::function<Value(const void* value, const Scene& scene)> text_of = {};
  AnyKeys keys = {};           ///< keys of the value if it is a map; else null
  bool is_collection = false;  ///< a value has names or numbers above the keys
};

/// A kind of values of one C++ type.
template <class T>
struct Type : AnyType {
  explicit Type(AnyType type) : AnyType(std::move(type)) {}

  T read(const PlacedValue& place) const {
    T result = T();
    read_into(place, &result);
    return result;
  }
  Value text(const T& value, const Scene& scene) const { return text_of(&value, scene); }

  /// The same type, which also checks the values that it has read.
  Type checked(void (*check)(const T& result, const PlacedValue& place)) const {
    Type type = *this;
    type.read_into = [read = read_into, check](const PlacedValue& place, void* result) {
      read(place, result);
      check(*static_cast<const T*>(result), place);
    };
    return type;
  }
};

/// AnyType::text_of from `text(value, scene)` or `text(value)` of the C++ type.
template <class T, class Text>
auto any_text(const Text& text) {
  return [text](const void* value, const Scene& scene) {
    if constexpr (std::is_invocable_v<Text, const T&>) {
      return text(*static_cast<const T*>(value));
    } else {
      return text(*static_cast<const T*>(value), scene);
    }
  };
}

/// A type made of `read(place)` and `text(value)` or `text(value, scene)`; `keys`: of maps.
template <class T, class Read, class Text>
Type<T> custom_type(std::string_view allowed, const Schema& schema, const Read& read,
                    const Text& text, const AnyKeys& keys = {}) {
  return Type<T>(
      AnyType{.allowed = std::string(allowed),
              .schema = schema,
              .read_into = [read](const PlacedValue& place,
                                  void* result) { *static_cast<T*>(result) = read(place); },
              .text_of = any_text<T>(text),
              .keys = keys});
}

/// Reads something into an owner, or checks it.
using AnyAction = std::function<void(const PlacedValue& fields, void* owner)>;
template <class Owner>
using Action = void (*)(const PlacedValue& fields, Owner& owner);

template <class Owner>
AnyAction any_action(Action<Owner> action) {
  if (action == nullptr) {
    return {};
  }
  return [action](const PlacedValue& fields, void* owner) {
    action(fields, *static_cast<Owner*>(owner));
  };
}

/// From an object to a part of it, or null. `make`: first puts a default part there.
using Access = std::function<void*(void* object, bool make)>;

/// A key of a map that is read into an owner. Texts are Markdown.
struct AnyKey {
  std::string name;
  std::string about;                         ///< one phrase
  std::shared_ptr<const AnyType> type = {};  ///< of the value
  Access access = {};  ///< from the owner to the value; null: only `action` reads, `text` writes it
  std::string default_phrase = {};          ///< what holds if the key is left out, or a condition
  bool is_condition = false;                ///< `default_phrase` says when the key is given
  std::optional<Value> default_value = {};  ///< the same, if it is a value
  bool required = false;
  std::optional<Model> model = {};  ///< the only one that has the key
  AnyAction action = {};            ///< before the value is read; reads it where `access` is null
  /// Written in place of the value; none: the key is left out.
  std::function<std::optional<Value>(const void* owner, const Scene& scene)> text = {};

  void describe_default(std::string_view phrase) {
    default_phrase = phrase;
    default_value.reset();
  }
};

/// A key of a map that is read into an Owner.
template <class Owner>
struct Key : AnyKey {
  explicit Key(AnyKey key) : AnyKey(std::move(key)) {}

  /// Has an effect in one model only.
  Key& of(Model only) {
    model = only;
    return *this;
  }
  Key& mark_required() {
    required = true;
    return *this;
  }
  /// Describes a default that is no value or follows from other keys.
  Key& defaults_to(std::string_view phrase) {
    describe_default(phrase);
    return *this;
  }
  /// Describes which other keys are given in its place, or with it.
  Key& with_condition(std::string_view phrase) {
    describe_default(phrase);
    is_condition = true;
    return *this;
  }
  /// Done before the value is read; reads it where there is no access.
  Key& with_action(Action<Owner> own) {
    action = any_action(own);
    return *this;
  }
  /// Left out of the resolved scene where this does not hold.
  Key& written_if(bool (*holds)(const Owner& owner)) {
    access = [access = access, holds](void* owner, bool make) {
      return make || holds(*static_cast<const Owner*>(owner)) ? access(owner, make) : nullptr;
    };
    return *this;
  }
  /// `own(owner)` or `own(owner, scene)`: none if it is left out.
  template <class Text>
  Key& written_as(const Text& own) {
    text = any_text<Owner>(own);
    return *this;
  }
};

template <class Owner>
struct Keys : std::vector<AnyKey> {
  explicit Keys(std::vector<AnyKey> keys) : std::vector<AnyKey>(std::move(keys)) {}
  Keys(std::initializer_list<Key<Owner>> keys) : std::vector<AnyKey>(keys.begin(), keys.end()) {}

  void add(const Keys& keys) { insert(end(), keys.begin(), keys.end()); }
};

/// A map that is read into an Owner.
template <class Owner>
struct Map {
  Keys<Owner> keys = {};
  std::vector<std::string> one_of = {};  ///< of these keys exactly one is given
  /// Checks that depend on several keys, after reading.
  Action<Owner> check = nullptr;
  std::string_view schema_members = {};  ///< of JSON Schema: what it can say of `check`
};

/// Paths of the keys of this name below `top`, the shortest first; such as `walls.NAME.motion`.
std::vector<std::string> paths_of_key(const AnyKeys& top, std::string_view name);

/// Paths of the keys below `top` that say this word about themselves, the shortest first.
std::vector<std::string> paths_about(const AnyKeys& top, std::string_view word);

/// `; did you mean 'rules.inertia'?` for a key of this or a similar name below `top`, or nothing.
std::string path_suggestion(const AnyKeys& top, std::string_view name);

/// Whether the value `none` is as if the key is left out.
bool may_be_none(const AnyKey& key);
/// Removes entries whose value is `none` and whose key may_be_none(), at any depth.
void remove_none_entries(Value& value, const std::vector<AnyKey>& keys);

/// The text without backticks and addresses of links.
std::string without_markup(std::string text);
/// What the key is for, without markup.
std::string meaning(const AnyKey& key);

/// `default_value`: null if the default is no value.
AnyKey any_key(std::string_view name, const Access& access, const AnyType& type,
               std::string_view about, const void* default_value = nullptr);

/// The second access, to what the first one returns.
Access composed_access(const Access& first, const Access& second);
template <class Owner, class T>
Access member_access(T Owner::*member) {
  return [member](void* owner, bool /*make*/) -> void* {
    return &(static_cast<Owner*>(owner)->*member);
  };
}
template <class T>
Access optional_access() {
  return [](void* object, bool make) -> void* {
    auto& value = *static_cast<std::optional<T>*>(object);
    if (make) {
      value.emplace();
    }
    return value ? &*value : nullptr;
  };
}
/// To `T` of the variant; if it `stays`, only where that is what the variant has.
template <class Variant, class T>
Access alternative_access(bool stays = false) {
  return [stays](void* object, bool make) -> void* {
    auto& variant = *static_cast<Variant*>(object);
    if (make && !stays) {
      variant.template emplace<T>();
    }
    return std::get_if<T>(&variant);
  };
}

/// A member of the Owner that is always given.
template <class Owner, class T>
Key<Owner> required_key(std::string_view name, T Owner::*member, const Type<T>& type,
                        std::string_view about) {
  return Key<Owner>(any_key(name, member_access(member), type, about)).mark_required();
}

/// A member of the Owner, whose default is that of the struct.
template <class Owner, class T>
Key<Owner> key(std::string_view name, T Owner::*member, const Type<T>& type,
               std::string_view about) {
  const Owner defaults;
  return Key<Owner>(any_key(name, member_access(member), type, about, &(defaults.*member)));
}

/// A member of the Owner that may have no value.
template <class Owner, class T>
Key<Owner> key(std::string_view name, std::optional<T> Owner::*member, const Type<T>& type,
               std::string_view about) {
  return Key<Owner>(
      any_key(name, composed_access(member_access(member), optional_access<T>()), type, about));
}

/// A list that may be left out, and is where it is empty.
template <class Owner, class T>
Key<Owner> list_key(std::string_view name, std::vector<T> Owner::*member,
                    const Type<std::vector<T>>& type, std::string_view about) {
  const Access access = [member](void* owner, bool make) -> void* {
    std::vector<T>& list = static_cast<Owner*>(owner)->*member;
    return make || !list.empty() ? &list : nullptr;
  };
  return Key<Owner>(any_key(name, access, type, about)).defaults_to("none");
}

/// One of several keys of which exactly one is given: `T` of the variant.
template <class Variant, class T>
Key<Variant> alternative_key(std::string_view name, const Type<T>& type, std::string_view about) {
  return Key<Variant>(any_key(name, alternative_access<Variant, T>(), type, about));
}

/// One of several keys of which exactly one is given: `T` of a variant that is a member.
template <class Owner, class Variant, class T>
Key<Owner> alternative_key(std::string_view name, Variant Owner::*member, const Type<T>& type,
                           std::string_view about) {
  const Access access = composed_access(member_access(member), alternative_access<Variant, T>());
  return Key<Owner>(any_key(name, access, type, about));
}

/// Keys of the part that `access` returns, as keys of the Owner itself.
template <class Owner>
Keys<Owner> inlined_keys(const Access& access, std::vector<AnyKey> keys) {
  for (AnyKey& key : keys) {
    if (key.access) {
      key.access = composed_access(access, key.access);
    }
  }
  return Keys<Owner>(std::move(keys));
}

/// The key of an alternative of a member, as a key of the Owner; not read for other alternatives.
template <class Owner, class Variant, class Part>
Key<Owner> inlined_alternative(Variant Owner::*member, const Key<Part>& part) {
  const Access access =
      composed_access(member_access(member), alternative_access<Variant, Part>(true));
  return Key<Owner>(inlined_keys<Owner>(access, {part}).front());
}

/// A key with a function of its own, if any, that reads it. Not written unless `written_as`.
template <class Owner>
Key<Owner> custom_key(std::string_view name, const AnyType& type, std::string_view about,
                      Action<Owner> read = nullptr) {
  return Key<Owner>(any_key(name, {}, type, about)).with_action(read);
}

AnyType map_type(const std::vector<AnyKey>& keys, const std::vector<std::string>& one_of,
                 const AnyAction& check, std::string_view schema_members);

/// A map as the value of a key.
template <class Owner>
Type<Owner> type_of(const Map<Owner>& map) {
  return Type<Owner>(map_type(map.keys, map.one_of, any_action(map.check), map.schema_members));
}

/// A map whose missing keys have the values of a member of the scene.
template <class Owner>
Type<Owner> stage_map_type(Owner Scene::*member, Keys<Owner> keys) {
  for (AnyKey& key : keys) {
    key.describe_default("as in the scene");
  }
  Type<Owner> type = type_of<Owner>({.keys = keys});
  type.read_into = [read = type.read_into, member](const PlacedValue& place, void* owner) {
    *static_cast<Owner*>(owner) = place.scene.*member;
    read(place, owner);
  };
  return type;
}

/// A map that is read into the same Owner.
template <class Owner>
Key<Owner> section_key(std::string_view name, const Map<Owner>& map, std::string_view about) {
  return Key<Owner>(any_key(
      name, [](void* owner, bool /*make*/) { return owner; }, type_of(map), about));
}

/// The type of a struct that is written as the value of one of its members.
template <class Owner, class T>
Type<Owner> member_type(T Owner::*member, const Type<T>& type) {
  Type<Owner> result(type);
  result.read_into = [member, read = type.read_into](const PlacedValue& place, void* owner) {
    read(place, &(static_cast<Owner*>(owner)->*member));
  };
  result.text_of = [member, text = type.text_of](const void* owner, const Scene& scene) {
    return text(&(static_cast<const Owner*>(owner)->*member), scene);
  };
  return result;
}

/// A map with exactly one of the keys.
template <class Variant>
Type<Variant> one_of_type(const Keys<Variant>& keys) {
  return Type<Variant>(map_type(keys, text::names_of<std::string>(keys), {}, {}));
}

}  // namespace clca::scene
