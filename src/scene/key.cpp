#include "scene/key.hpp"

#include <algorithm>

namespace clca::scene {

namespace {

std::optional<Value> key_text(const AnyKey& key, const void* owner, const Scene& scene) {
  if (key.text) {
    return key.text(owner, scene);
  }
  // Of an owner that is not changed.
  const void* value = key.type != nullptr ? key.way(const_cast<void*>(owner), false) : nullptr;
  return value != nullptr ? std::optional(key.type->text_of(value, scene)) : std::nullopt;
}

/// Reads the key, or refuses it in another model.
void read_key(const AnyKey& key, const KeyedMap& fields, void* owner) {
  const Value* value = fields.find(key.name);
  if (key.model && *key.model != fields.scene.model) {
    if (value != nullptr) {
      const std::string_view model = name_of(kModelNames, *key.model);
      const auto entry = std::ranges::find(fields.value.entries, key.name, &Entry::key);
      fail(entry->location, "{}: only model {} has it; remove it, or say 'model: {}'",
           fields.inside(*entry).path, model, model);
    }
    return;
  }
  if (key.before) {
    key.before(fields, owner);
  }
  if (key.type == nullptr || (value == nullptr && !key.required)) {
    return;
  }
  const Place place = fields.at(key.name);
  if (void* result = key.way(owner, true)) {
    key.type->read_into(place, result);
  }
}

}  // namespace

bool may_be_none(const KeyDescription& key) {
  return !key.required && !key.default_value &&
         (key.otherwise == "none" || key.otherwise.starts_with("none:"));
}

void leave_out_none(Value& value, const std::vector<KeyDescription>& keys) {
  const auto key_of = [&](const Entry& entry) {
    return std::ranges::find_if(keys,
                                [&](const KeyDescription& key) { return key.name == entry.key; });
  };
  std::erase_if(value.entries, [&](const Entry& entry) {
    const auto key = key_of(entry);
    return key != keys.end() && may_be_none(*key) && !entry.value.quoted &&
           entry.value.text == "none";
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

KeyDescription described(std::string_view name, const AnyType& type, std::string_view about) {
  return {.name = std::string(name),
          .about = std::string(about),
          .allowed = type.allowed,
          .is_collection = type.is_collection,
          .schema = type.schema,
          .keys = type.keys};
}

AnyKey any_key(std::string_view name, const Way& way, const AnyType& type, std::string_view about,
               const void* otherwise) {
  AnyKey key = {described(name, type, about), {}, way, std::make_shared<const AnyType>(type), {}};
  if (otherwise != nullptr) {
    key.default_value = type.text_of(otherwise, Scene());
    key.otherwise = fmt::format("`{}`", flow_text(*key.default_value));
  }
  return key;
}

Way joined(const Way& first, const Way& second) {
  return [=](void* object, bool make) {
    void* between = first(object, make);
    return between != nullptr ? second(between, make) : nullptr;
  };
}

AnyType map_type(const std::vector<AnyKey>& keys, const std::vector<std::string>& one_of,
                 const AnyAction& check, std::string_view conditions) {
  const auto all = std::make_shared<const std::vector<AnyKey>>(keys);
  AnyType type;
  type.allowed = "map";
  type.read_into = [=](const Place& place, void* owner) {
    const KeyedMap fields(place, names_of(*all));
    for (const AnyKey& key : *all) {
      read_key(key, fields, owner);
    }
    if (!one_of.empty()) {
      fields.only(std::vector<std::string_view>(one_of.begin(), one_of.end()));
    }
    if (check) {
      check(fields, owner);
    }
  };
  type.text_of = [=](const void* owner, const Scene& scene) {
    Value result = Value::map();
    for (const AnyKey& key : *all) {
      auto text = key.model.value_or(scene.model) == scene.model ? key_text(key, owner, scene)
                                                                 : std::nullopt;
      if (text) {
        result.add(key.name, std::move(*text));
      }
    }
    return result;
  };
  type.keys = std::make_shared<const std::vector<KeyDescription>>(keys.begin(), keys.end());
  type.schema = map_schema(*type.keys, one_of, conditions);
  return type;
}

}  // namespace clca::scene
