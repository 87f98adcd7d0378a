// pairs() in an order that is the same in every run. Lua gives the keys of a table in the order of their hashes, and
// seeds the hash of texts from the clock and from addresses, anew in every run.

#include "script/pairs.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

namespace ricochet {
namespace {

// Numbers, then texts, each rising; keys of other kinds keep the place that Lua gives them, after these.
struct Key {
  int type;
  lua_Number number;
  const char* text;  // held by the list of keys
  std::size_t length;
  lua_Integer at;  // in the list of keys
};

bool before(const Key& a, const Key& b) {
  const auto rank = [](const Key& key) { return key.type == LUA_TNUMBER ? 0 : key.type == LUA_TSTRING ? 1 : 2; };
  if (rank(a) != rank(b)) return rank(a) < rank(b);
  if (a.type == LUA_TNUMBER && b.type == LUA_TNUMBER && a.number != b.number) return a.number < b.number;
  if (a.type == LUA_TSTRING && b.type == LUA_TSTRING) {
    const int order = std::memcmp(a.text, b.text, std::min(a.length, b.length));
    return order != 0 ? order < 0 : a.length < b.length;
  }
  return a.at < b.at;
}

// The next key of the list (upvalue 1) that still has a value, and that value; upvalue 2 counts.
int next_in_order(lua_State* L) {
  lua_settop(L, 1);
  for (lua_Integer at = lua_tointeger(L, lua_upvalueindex(2)) + 1;; ++at) {
    lua_pushinteger(L, at);
    lua_replace(L, lua_upvalueindex(2));
    if (lua_rawgeti(L, lua_upvalueindex(1), at) == LUA_TNIL) return 1;
    lua_pushvalue(L, -1);
    if (lua_rawget(L, 1) != LUA_TNIL) return 2;
    lua_pop(L, 2);
  }
}

// Puts the keys of the table at index 1 into the list at index 2; false if no key is a text, so that Lua's own order is
// the same in every run.
bool list_keys(lua_State* L, std::vector<Key>& keys) {
  bool texts = false;
  lua_Integer count = 0;
  for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1)) {
    Key key{lua_type(L, -2), 0, nullptr, 0, ++count};
    if (key.type == LUA_TNUMBER) key.number = lua_tonumber(L, -2);
    if (key.type == LUA_TSTRING) key.text = lua_tolstring(L, -2, &key.length);
    texts = texts || key.type == LUA_TSTRING;
    keys.push_back(key);
    lua_pushvalue(L, -2);
    lua_rawseti(L, 2, count);
  }
  return texts;
}

int pairs(lua_State* L) {
  luaL_checkany(L, 1);
  if (!lua_istable(L, 1) || luaL_getmetafield(L, 1, "__pairs") != LUA_TNIL) {
    lua_settop(L, 1);
    return original(L);
  }
  lua_settop(L, 1);
  lua_newtable(L);
  std::vector<Key> keys;
  if (!list_keys(L, keys)) {
    lua_settop(L, 1);
    return original(L);
  }
  std::sort(keys.begin(), keys.end(), before);
  lua_createtable(L, static_cast<int>(keys.size()), 0);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    lua_rawgeti(L, 2, keys[k].at);
    lua_rawseti(L, 3, static_cast<lua_Integer>(k) + 1);
  }
  lua_pushinteger(L, 0);
  lua_pushcclosure(L, next_in_order, 2);
  lua_pushvalue(L, 1);
  lua_pushnil(L);
  return 3;
}

}  // namespace

void order_pairs(lua_State* L) {
  lua_getglobal(L, "pairs");
  lua_pushcclosure(L, guarded<pairs>, 1);
  lua_setglobal(L, "pairs");
}

}  // namespace ricochet
