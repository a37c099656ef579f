#include "scene/key.hpp"

#include <algorithm>

namespace clca::scene {

AnyType::AnyType() = default;
AnyType::AnyType(const AnyType&) = default;
AnyType::AnyType(AnyType&&) noexcept = default;
AnyType& AnyType::operator=(const AnyType&) = default;
AnyType& AnyType::operator=(AnyType&&) noexcept = default;
AnyType::~AnyType() = default;

AnyKey::AnyKey() = default;
AnyKey::AnyKey(const AnyKey&) = default;
AnyKey::AnyKey(AnyKey&&) noexcept = default;
AnyKey& AnyKey::operator=(const AnyKey&) = default;
AnyKey& AnyKey::operator=(AnyKey&&) noexcept = default;
AnyKey::~AnyKey() = default;

void AnyKey::describe_default(std::string_view phrase) {
  otherwise = phrase;
  default_value.reset();
}

namespace {

/// A map that is read into an owner.
struct AnyMap {
  std::vector<AnyKey> keys;
  AnyAction check;
};

const void* member(const Step& step, const void* object) {
  return step.member == nullptr ? object : step.member(object, step.pointer);
}

void* member(const Step& step, void* object) {
  // Of an object that is not constant, no member is.
  return const_cast<void*>(member(step, static_cast<const void*>(object)));
}

/// Where the value is; null if there is none.
const void* find(const std::vector<Step>& way, const void* object) {
  for (std::size_t i = 0; object != nullptr && i < way.size(); ++i) {
    object = member(way[i], object);
    object = way[i].container == nullptr ? object : way[i].container->at(object, 0);
  }
  return object;
}

/// Where the value is to be; null if it cannot be there.
void* target(const std::vector<Step>& way, void* object) {
  for (std::size_t i = 0; object != nullptr && i < way.size(); ++i) {
    object = member(way[i], object);
    object = way[i].container == nullptr ? object : way[i].container->append(object);
  }
  return object;
}

void read_key(const AnyKey& key, const KeyedMap& fields, void* owner, const Scene& scene) {
  if (key.before) {
    key.before(fields, owner, scene);
  }
  if (key.type == nullptr) {
    return;
  }
  const Value* value = key.required ? &fields.at(key.name) : fields.find(key.name);
  void* result = value != nullptr ? target(key.way, owner) : nullptr;
  if (result != nullptr) {
    key.type->read_into(*value, fields.path(key.name), scene, result);
  }
}

std::optional<Yaml> key_text(const AnyKey& key, const void* owner, const Scene& scene) {
  if (key.text) {
    return key.text(owner, scene);
  }
  const void* value = key.type != nullptr ? find(key.way, owner) : nullptr;
  return value != nullptr ? std::optional(key.type->text_of(value, scene)) : std::nullopt;
}

/// Reads all keys in their order, then checks. Throws SceneError.
void read_fields(const Value& value, const std::string& path, const AnyMap& map, void* owner,
                 const Scene& scene) {
  const std::vector<std::string_view> names = names_of(map.keys);
  const KeyedMap fields(value, path, names);
  for (const AnyKey& key : map.keys) {
    if (key.model && *key.model != scene.model) {
      fields.refuse_foreign(key.name, *key.model);
      continue;
    }
    read_key(key, fields, owner, scene);
  }
  if (map.check) {
    map.check(fields, owner, scene);
  }
}

/// Those keys that have a value, in their order.
Yaml map_text(const AnyMap& map, const void* owner, const Scene& scene) {
  Yaml result = Yaml::map({});
  for (const AnyKey& key : map.keys) {
    if (key.model && *key.model != scene.model) {
      continue;
    }
    if (auto text = key_text(key, owner, scene)) {
      result.entries.push_back({key.name, std::move(*text)});
    }
  }
  return result;
}

}  // namespace

bool may_be_none(const KeyDescription& key) {
  return !key.required && !key.default_value &&
         (key.otherwise == "none" || key.otherwise.starts_with("none:"));
}

void leave_out_none(Value& value, const std::vector<KeyDescription>& keys) {
  const auto key_of = [&](const Entry& entry) {
    return std::find_if(keys.begin(), keys.end(),
                        [&](const KeyDescription& key) { return key.name == entry.key; });
  };
  std::erase_if(value.entries, [&](const Entry& entry) {
    const auto key = key_of(entry);
    return key != keys.end() && may_be_none(*key) && entry.value.is(Value::Kind::scalar) &&
           !entry.value.quoted && entry.value.text == "none";
  });
  for (Entry& entry : value.entries) {
    const auto key = key_of(entry);
    if (key == keys.end() || key->keys == nullptr) {
      continue;
    }
    if (!key->is_collection) {
      leave_out_none(entry.value, *key->keys);
    }
    for (Value& item : entry.value.items) {
      leave_out_none(item, *key->keys);
    }
    for (Entry& named : entry.value.entries) {
      if (key->is_collection) {
        leave_out_none(named.value, *key->keys);
      }
    }
  }
}

std::string meaning(const KeyDescription& key) {
  // A link at the end says where to read on.
  std::string about = key.about;
  const std::size_t link = about.rfind('[');
  if (about.ends_with(")") && link != std::string::npos && link >= 2 &&
      about.find("](", link) != std::string::npos && about[link - 1] == ' ' &&
      (about[link - 2] == ':' || about[link - 2] == ';')) {
    about.erase(link - 2);
  }
  return without_markup(
      (key.model ? fmt::format("with model: {}: ", name_of(kModelNames, *key.model)) : "") + about);
}

std::string without_markup(std::string text) {
  // Links first: [text](address).
  for (std::size_t end = text.find("]("); end != std::string::npos; end = text.find("](")) {
    text.erase(end, text.find(')', end) - end + 1);
    text.erase(text.rfind('[', end), 1);
  }
  std::erase(text, '`');
  return text;
}

AnyType any_type(std::string_view allowed, const Schema& schema) {
  AnyType type;
  type.allowed = allowed;
  type.schema = schema;
  return type;
}

KeyDescription described(std::string_view name, const AnyType& type, std::string_view about) {
  return {.name = std::string(name),
          .about = std::string(about),
          .allowed = type.allowed,
          .is_collection = type.is_collection,
          .schema = type.schema,
          .keys = type.keys};
}

AnyKey any_key(std::string_view name, const Step& step, const AnyType& type, std::string_view about,
               const void* otherwise) {
  AnyKey key;
  static_cast<KeyDescription&>(key) = described(name, type, about);
  key.way = {step};
  key.type = std::make_shared<const AnyType>(type);
  if (otherwise != nullptr) {
    key.default_value = type.text_of(otherwise, Scene());
    key.otherwise = fmt::format("`{}`", flow_text(*key.default_value));
  }
  return key;
}

std::vector<AnyKey> inlined_keys(const Step& step, std::vector<AnyKey> keys) {
  for (AnyKey& key : keys) {
    key.way.insert(key.way.begin(), step);
  }
  return keys;
}

AnyType map_type(const std::vector<AnyKey>& keys, const AnyAction& check,
                 std::string_view conditions) {
  const auto map = std::make_shared<const AnyMap>(AnyMap{keys, check});
  AnyType type;
  type.allowed = "map";
  type.read_into = [map](const Value& value, const std::string& path, const Scene& scene,
                         void* owner) { read_fields(value, path, *map, owner, scene); };
  type.text_of = [map](const void* owner, const Scene& scene) {
    return map_text(*map, owner, scene);
  };
  type.keys = std::make_shared<const std::vector<KeyDescription>>(keys.begin(), keys.end());
  type.schema = map_schema(type.keys, std::string(conditions));
  return type;
}

AnyType one_of_type(const std::vector<AnyKey>& keys) {
  const auto check = [keys](const KeyedMap& fields, void* /*owner*/, const Scene& /*scene*/) {
    fields.only(names_of(keys));
  };
  return map_type(keys, check, R"({"minProperties": 1, "maxProperties": 1})");
}

AnyType member_type(const AnyType& type, const Step& step) {
  AnyType result = type;
  result.read_into = [read = type.read_into, step](const Value& value, const std::string& path,
                                                   const Scene& scene, void* owner) {
    read(value, path, scene, member(step, owner));
  };
  result.text_of = [text = type.text_of, step](const void* owner, const Scene& scene) {
    return text(member(step, owner), scene);
  };
  return result;
}

AnyType optional_type(
    const std::string& word, std::string_view between, const AnyType& type,
    const Container& optional,
    const std::function<bool(const Value& value, const std::string& path)>& is_word) {
  AnyType result = type;
  result.allowed = fmt::format("`{}`{}{}", word, between, type.allowed);
  result.schema = any_of({word_schema(word), type.schema});
  result.read_into = [=, read = type.read_into, &optional](const Value& value,
                                                           const std::string& path,
                                                           const Scene& scene, void* none_or_one) {
    optional.clear(none_or_one);
    if (!is_word(value, path)) {
      read(value, path, scene, optional.append(none_or_one));
    }
  };
  result.text_of = [=, text = type.text_of, &optional](const void* none_or_one,
                                                       const Scene& scene) {
    const void* value = optional.at(none_or_one, 0);
    return value != nullptr ? text(value, scene) : Yaml::scalar(word);
  };
  return result;
}

AnyType list_type(const AnyType& item, const Container& list, std::size_t least, std::size_t most,
                  PathOfItem path_of) {
  AnyType type;
  type.schema = array_schema(item.schema, least, most);
  type.read_into = [=, &list, read = item.read_into](const Value& value, const std::string& path,
                                                     const Scene& scene, void* result) {
    std::size_t index = 0;
    for (const Value& entry : read_list(value, path, least, most)) {
      read(entry, path_of == nullptr ? path : path_of(path, entry, index++), scene,
           list.append(result));
    }
  };
  type.text_of = [&list, text = item.text_of](const void* values, const Scene& scene) {
    Yaml result = Yaml::list({});
    for (std::size_t i = 0; list.at(values, i) != nullptr; ++i) {
      result.items.push_back(text(list.at(values, i), scene));
    }
    return result;
  };
  type.keys = item.keys;
  type.is_collection = item.keys != nullptr;
  return type;
}

AnyType named_type(const std::string& section, const AnyType& thing, const Container& list,
                   const Step& name, std::size_t least) {
  AnyType type;
  type.allowed = "map of names";
  type.schema = named_schema(thing.schema, least);
  type.read_into = [=, &list, read = thing.read_into](const Value& value, const std::string& path,
                                                      const Scene& scene, void* things) {
    for (const Entry& entry : read_named(value, path)) {
      void* added = list.append(things);
      read(entry.value, join_path(section, entry.key), scene, added);
      *static_cast<std::string*>(member(name, added)) = entry.key;
    }
    if (least > 0 && list.at(things, least - 1) == nullptr) {
      fail(value.location, fmt::format("{}: expected at least one", path));
    }
  };
  type.text_of = [=, &list, text = thing.text_of](const void* things, const Scene& scene) {
    Yaml result = Yaml::map({});
    result.in_lines = true;
    for (std::size_t i = 0; const void* value = list.at(things, i); ++i) {
      const auto& key = *static_cast<const std::string*>(member(name, value));
      result.entries.push_back({name_text(key).text, text(value, scene)});
    }
    return result;
  };
  type.keys = thing.keys;
  type.is_collection = true;
  return type;
}

}  // namespace clca::scene
