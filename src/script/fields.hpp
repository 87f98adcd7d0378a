#pragma once
// Lists of fields, as the descriptions of functions hold them.

#include <fmt/format.h>

#include <string>
#include <type_traits>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

/// A default as a script would write it.
template <class Value>
std::string lua_text(const Value& value) {
  return fmt::format("{}", value);
}

/// The fields of a plain struct, with its values as defaults: those of a default-made one unless others are given.
template <class Struct>
std::vector<Field> fields_of(const Struct& defaults = {}) {
  std::vector<Field> fields;
  for (const Member<Struct>& member : Struct::fields()) {
    fields.push_back(member.field);
    if (!member.field.initial.empty())
      fields.back().initial = std::visit([&](auto place) { return lua_text(defaults.*place); }, member.place);
  }
  return fields;
}

/// The field of the one scene that a function is about.
inline Field scene_field() { return {"scene", "scene", "", "what happens"}; }

/// Lists of fields, or of functions, one after the other.
template <class Item>
std::vector<Item> operator+(std::vector<Item> a, const std::vector<Item>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace ricochet
