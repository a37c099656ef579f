#pragma once
// Keys of the scene format, each declared once: the parser, the resolved scene, the JSON Schema,
// the tables of docs/scene-format.md and `clca explain` follow from the declaration.
// Only declarations know C++ types: Type, Key and Map check them. What reads and writes works with
// pointers to void (AnyType, AnyKey, AnyMap), so that it is compiled once and not for each key.

#include <fmt/format.h>

#include <bit>
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
#include "scene/keyed_map.hpp"
#include "scene/schema.hpp"
#include "scene/yaml_text.hpp"

namespace clca::scene {

/// A key as users see it. Texts are Markdown.
struct KeyDescription {
  std::string name;
  std::string about;                       ///< one phrase
  std::string allowed;                     ///< values
  std::string otherwise = {};              ///< what holds if it is left out, or a condition
  bool is_condition = false;               ///< `otherwise` says when the key is given
  std::optional<Yaml> default_value = {};  ///< the same, if it is a value
  bool required = false;
  std::optional<Model> model = {};  ///< the only one that has it
  bool is_collection = false;       ///< its value has names or numbers above the keys
  Schema schema = {};               ///< of the value alone
  Descriptions keys = {};           ///< of the map that the value is; null: none
};

/// Operations on a list, an optional or a variant. The values of a variant are those of one type.
struct Container {
  const void* (*at)(const void* container, std::size_t index) = nullptr;  ///< null after the last
  /// A default value. Null if the container takes none.
  void* (*append)(void* container) = nullptr;
  void (*clear)(void* container) = nullptr;  ///< of an optional
};

template <class T>
inline constexpr Container kListOf = {.at = [](const void* list, std::size_t index) -> const void* {
                                        const auto& values =
                                            *static_cast<const std::vector<T>*>(list);
                                        return index < values.size() ? &values[index] : nullptr;
                                      },
                                      .append = [](void* list) -> void* {
                                        return &static_cast<std::vector<T>*>(list)->emplace_back();
                                      }};

template <class T>
inline constexpr Container kOptional = {
    .at = [](const void* optional, std::size_t index) -> const void* {
      const auto& value = *static_cast<const std::optional<T>*>(optional);
      return index == 0 && value ? &*value : nullptr;
    },
    .append = [](void* optional) -> void* {
      return &static_cast<std::optional<T>*>(optional)->emplace();
    },
    .clear = [](void* optional) { static_cast<std::optional<T>*>(optional)->reset(); }};

template <class Variant, class T>
inline constexpr Container kAlternative = {
    .at = [](const void* variant, std::size_t index) -> const void* {
      return index == 0 ? std::get_if<T>(static_cast<const Variant*>(variant)) : nullptr;
    },
    .append = [](void* variant) -> void* {
      return &static_cast<Variant*>(variant)->template emplace<T>();
    }};

/// Takes no value of the type while it has one of another.
template <class Variant, class T>
inline constexpr Container kPresent = {.at = kAlternative<Variant, T>.at,
                                       .append = [](void* variant) -> void* {
                                         return std::get_if<T>(static_cast<Variant*>(variant));
                                       }};

/// The only value of a list.
template <class T>
inline constexpr Container kSingle = {
    .at = [](const void* list, std::size_t index) -> const void* {
      const auto& values = *static_cast<const std::vector<T>*>(list);
      return index == 0 && values.size() == 1 ? values.data() : nullptr;
    },
    .append = kListOf<T>.append};

/// The list itself, unless it is empty.
template <class T>
inline constexpr Container kNotEmpty = {
    .at = [](const void* list, std::size_t index) -> const void* {
      return index == 0 && !static_cast<const std::vector<T>*>(list)->empty() ? list : nullptr;
    },
    .append = [](void* list) { return list; }};

/// From an object to a member, and on to the value in it where that is a container.
struct Step {
  const void* (*member)(const void* object, std::ptrdiff_t pointer) = nullptr;  ///< null: itself
  std::ptrdiff_t pointer = 0;  ///< to the member, as bits
  const Container* container = nullptr;
};

template <class Owner, class T>
Step step(T Owner::*member, const Container* container = nullptr) {
  return {.member = [](const void* object, std::ptrdiff_t pointer) -> const void* {
            return &(static_cast<const Owner*>(object)->*std::bit_cast<T Owner::*>(pointer));
          },
          .pointer = std::bit_cast<std::ptrdiff_t>(member),
          .container = container};
}

/// A kind of values: how they are read, written and described.
struct AnyType {
  std::string allowed;
  Schema schema;
  /// Into a default value of the type. `scene` as far as it has been read. Throws SceneError.
  std::function<void(const Value& value, const std::string& path, const Scene& scene, void* result)>
      read_into;
  std::function<Yaml(const void* value, const Scene& scene)> text_of;
  Descriptions keys;
  bool is_collection = false;

  // Compiled once.
  AnyType();
  AnyType(const AnyType&);
  AnyType(AnyType&&) noexcept;
  AnyType& operator=(const AnyType&);
  AnyType& operator=(AnyType&&) noexcept;
  ~AnyType();
};

/// The same for values of a C++ type.
template <class T>
struct Type : AnyType {
  explicit Type(AnyType type) : AnyType(std::move(type)) {}

  T read(const Value& value, const std::string& path, const Scene& scene) const {
    T result = T();
    read_into(value, path, scene, &result);
    return result;
  }
  Yaml text(const T& value, const Scene& scene) const { return text_of(&value, scene); }

  /// With a check of the values that have been read.
  Type checked(void (*check)(const T& result, const Value& value, const std::string& path,
                             const Scene& scene)) const {
    Type type = *this;
    type.read_into = [read = read_into, check](const Value& value, const std::string& path,
                                               const Scene& scene, void* result) {
      read(value, path, scene, result);
      check(*static_cast<const T*>(result), value, path, scene);
    };
    return type;
  }
};

/// Without functions.
AnyType any_type(std::string_view allowed, const Schema& schema);

/// A type with functions of its own.
template <class T>
Type<T> own_type(
    std::string_view allowed, const Schema& schema,
    const std::function<T(const Value& value, const std::string& path, const Scene& scene)>& read,
    const std::function<Yaml(const T& value, const Scene& scene)>& text) {
  AnyType type = any_type(allowed, schema);
  type.read_into = [read](const Value& value, const std::string& path, const Scene& scene,
                          void* result) { *static_cast<T*>(result) = read(value, path, scene); };
  type.text_of = [text](const void* value, const Scene& scene) {
    return text(*static_cast<const T*>(value), scene);
  };
  return Type<T>(std::move(type));
}

/// Reads something into an owner, or checks it.
using AnyAction = std::function<void(const KeyedMap& fields, void* owner, const Scene& scene)>;
template <class Owner>
using Action = void (*)(const KeyedMap& fields, Owner& owner, const Scene& scene);

template <class Owner>
AnyAction any_action(Action<Owner> action) {
  if (action == nullptr) {
    return {};
  }
  return [action](const KeyedMap& fields, void* owner, const Scene& scene) {
    action(fields, *static_cast<Owner*>(owner), scene);
  };
}

/// A key of a map that is read into an owner.
struct AnyKey : KeyDescription {
  AnyAction before;                     ///< what is done before it is read
  std::vector<Step> way;                ///< from the owner to the value
  std::shared_ptr<const AnyType> type;  ///< of the value; null: nothing is read or written
  /// Its value in place of that one; none if it is left out.
  std::function<std::optional<Yaml>(const void* owner, const Scene& scene)> text;

  void describe_default(std::string_view phrase);

  // Compiled once.
  AnyKey();
  AnyKey(const AnyKey&);
  AnyKey(AnyKey&&) noexcept;
  AnyKey& operator=(const AnyKey&);
  AnyKey& operator=(AnyKey&&) noexcept;
  ~AnyKey();
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
  /// Described by a phrase, where the default is no value or follows from other keys.
  Key& defaults_to(std::string_view phrase) {
    describe_default(phrase);
    return *this;
  }
  /// Which other keys are given in its place, or with it.
  Key& with_condition(std::string_view phrase) {
    describe_default(phrase);
    is_condition = true;
    return *this;
  }
  Key& after(Action<Owner> action) {
    before = any_action(action);
    return *this;
  }
  Key& written_as(std::optional<Yaml> (*own)(const Owner& owner, const Scene& scene)) {
    text = [own](const void* owner, const Scene& scene) {
      return own(*static_cast<const Owner*>(owner), scene);
    };
    return *this;
  }
};

template <class Owner>
struct Keys : std::vector<AnyKey> {
  explicit Keys(std::vector<AnyKey> keys) : std::vector<AnyKey>(std::move(keys)) {}
  Keys(std::initializer_list<Key<Owner>> keys) : std::vector<AnyKey>(keys.begin(), keys.end()) {}

  void add(const Key<Owner>& key) { push_back(key); }
  void add(const Keys& keys) { insert(end(), keys.begin(), keys.end()); }
};

/// A map that is read into an Owner.
template <class Owner>
struct Map {
  Keys<Owner> keys = {};
  /// What depends on several keys, once they have been read.
  Action<Owner> check = nullptr;
  std::string_view conditions = {};  ///< the same as far as a schema can say it; JSON
};

/// Whether it is left out by `none` as its value, too.
bool may_be_none(const KeyDescription& key);
/// Removes the entries of such keys that have that value, at any depth.
void leave_out_none(Value& value, const std::vector<KeyDescription>& keys);

/// Without backticks and addresses of links.
std::string without_markup(std::string text);
/// What the key is for, without markup.
std::string meaning(const KeyDescription& key);

KeyDescription described(std::string_view name, const AnyType& type, std::string_view about);
/// `otherwise`: the default; null if it is no value.
AnyKey any_key(std::string_view name, const Step& step, const AnyType& type, std::string_view about,
               const void* otherwise = nullptr);
/// After a step to the owner of the keys.
std::vector<AnyKey> inlined_keys(const Step& step, std::vector<AnyKey> keys);

/// A member of the Owner.
template <class Owner, class T>
Key<Owner> required(std::string_view name, T Owner::*member, const Type<T>& type,
                    std::string_view about) {
  Key<Owner> key(any_key(name, step(member), type, about));
  key.required = true;
  return key;
}

/// A member of the Owner that has this default.
template <class Owner, class T>
Key<Owner> key(std::string_view name, T Owner::*member, const Type<T>& type, std::string_view about,
               const std::type_identity_t<T>& otherwise) {
  return Key<Owner>(any_key(name, step(member), type, about, &otherwise));
}

/// A member of the Owner, whose default is that of the struct.
template <class Owner, class T>
Key<Owner> key(std::string_view name, T Owner::*member, const Type<T>& type,
               std::string_view about) {
  return key(name, member, type, about, Owner().*member);
}

/// A member of the Owner that may have no value.
template <class Owner, class T>
Key<Owner> key(std::string_view name, std::optional<T> Owner::*member, const Type<T>& type,
               std::string_view about) {
  return Key<Owner>(any_key(name, step(member, &kOptional<T>), type, about));
}

/// A list that may be left out, and is where it is empty.
template <class Owner, class T>
Key<Owner> list_key(std::string_view name, std::vector<T> Owner::*member,
                    const Type<std::vector<T>>& type, std::string_view about) {
  return Key<Owner>(any_key(name, step(member, &kNotEmpty<T>), type, about)).defaults_to("none");
}

/// One of several keys of which exactly one is given: `T` of the variant.
template <class Variant, class T>
Key<Variant> alternative(std::string_view name, const Type<T>& type, std::string_view about) {
  return Key<Variant>(any_key(name, {.container = &kAlternative<Variant, T>}, type, about));
}

/// The key of a member of the Owner as a key of the Owner itself.
template <class Owner, class Part>
Key<Owner> inlined(Part Owner::*member, const Key<Part>& part) {
  return Key<Owner>(inlined_keys(step(member), {part}).front());
}

template <class Owner, class Part>
Keys<Owner> inlined(Part Owner::*member, const Keys<Part>& part) {
  return Keys<Owner>(inlined_keys(step(member), part));
}

/// The keys of the only item of a list as keys of the Owner.
template <class Owner, class Part>
Keys<Owner> inlined_single(std::vector<Part> Owner::*list, const Keys<Part>& part) {
  return Keys<Owner>(inlined_keys(step(list, &kSingle<Part>), part));
}

/// The key of an alternative of such a member; not read where that has another one.
template <class Owner, class Variant, class Part>
Key<Owner> inlined_alternative(Variant Owner::*member, const Key<Part>& part) {
  return Key<Owner>(inlined_keys(step(member, &kPresent<Variant, Part>), {part}).front());
}

/// A key with functions of its own. Not written without `text`.
template <class Owner>
Key<Owner> own_key(const KeyDescription& description, Action<Owner> read = nullptr,
                   std::optional<Yaml> (*text)(const Owner& owner, const Scene& scene) = nullptr) {
  Key<Owner> key{AnyKey()};
  static_cast<KeyDescription&>(key) = description;
  key.before = any_action(read);
  return text != nullptr ? key.written_as(text) : key;
}

AnyType map_type(const std::vector<AnyKey>& keys, const AnyAction& check,
                 std::string_view conditions);
AnyType one_of_type(const std::vector<AnyKey>& keys);
AnyType member_type(const AnyType& type, const Step& step);
/// `word`, which is read as no value, or a value of the type; `between` them in descriptions.
AnyType optional_type(
    const std::string& word, std::string_view between, const AnyType& type,
    const Container& optional,
    const std::function<bool(const Value& value, const std::string& path)>& is_word);
using PathOfItem = std::string (*)(const std::string& path, const Value& item, std::size_t index);
AnyType list_type(const AnyType& item, const Container& list, std::size_t least, std::size_t most,
                  PathOfItem path_of);
AnyType named_type(const std::string& section, const AnyType& thing, const Container& list,
                   const Step& name, std::size_t least);

/// A map as the value of a key.
template <class Owner>
Type<Owner> type_of(const Map<Owner>& map) {
  return Type<Owner>(map_type(map.keys, any_action(map.check), map.conditions));
}

/// A map of which all that is left out is as in a member of the scene.
template <class Owner>
Type<Owner> changed(Owner Scene::*member, Keys<Owner> keys) {
  for (AnyKey& key : keys) {
    key.describe_default("as in the scene");
  }
  Type<Owner> type = type_of<Owner>({.keys = keys});
  type.read_into = [read = type.read_into, member](const Value& value, const std::string& path,
                                                   const Scene& scene, void* owner) {
    *static_cast<Owner*>(owner) = scene.*member;
    read(value, path, scene, owner);
  };
  return type;
}

/// A map that is read into the same Owner.
template <class Owner>
Key<Owner> section(std::string_view name, const Map<Owner>& map, std::string_view about) {
  return Key<Owner>(any_key(name, {}, type_of(map), about));
}

/// A struct of which only this member is given.
template <class Owner, class T>
Type<Owner> as(T Owner::*member, const Type<T>& type) {
  return Type<Owner>(member_type(type, step(member)));
}

/// A map with exactly one of the keys.
template <class Variant>
Type<Variant> one_of(const Keys<Variant>& keys) {
  return Type<Variant>(one_of_type(keys));
}

/// `none`, or a value of the type.
template <class T>
Type<std::optional<T>> or_none(const Type<T>& type) {
  return Type<std::optional<T>>(optional_type("none", ", ", type, kOptional<T>, is_none));
}

/// A list of `least` to `most` such values; `path_of` an item in messages is that of the list
/// unless it is given.
template <class T>
Type<std::vector<T>> list_of(const Type<T>& item, std::size_t least, std::size_t most,
                             PathOfItem path_of = nullptr) {
  return Type<std::vector<T>>(list_type(item, kListOf<T>, least, most, path_of));
}

/// Things by the names that the scene gives them; `name` is a member of each.
template <class Owner>
Type<std::vector<Owner>> by_name(const std::string& section, const Map<Owner>& map,
                                 std::size_t least = 0) {
  return Type<std::vector<Owner>>(
      named_type(section, type_of(map), kListOf<Owner>, step(&Owner::name), least));
}

}  // namespace clca::scene
