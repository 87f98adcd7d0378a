// Lua's own functions that may run for long without an instruction, each in a form that counts what it does.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "script/bounds.hpp"
#include "script/pattern.hpp"

namespace ricochet {
namespace {

// Without a budget: a second or so.
constexpr double most_pattern_steps = 1e8;
constexpr lua_Integer most_elements = 50'000'000;
constexpr std::size_t longest_pattern = 100'000;

// While it lives, the coroutine's instructions are those that run.
class Running {
 public:
  Running(lua_State* L, lua_State* co) : limits_(limits_of(L)), before_(limits_.running) {
    if (!co || !before_) return;
    limits_.running = co;
    if (const int period = period_of(limits_); lua_gethookcount(co) > period)
      lua_sethook(co, watch, LUA_MASKCOUNT, period);
  }
  ~Running() { limits_.running = before_; }
  Running(const Running&) = delete;

 private:
  Limits& limits_;
  lua_State* before_;
};

// Calls the library's own function in the wrapper's place, so that its errors name the script's line.
int original(lua_State* L) { return lua_tocfunction(L, lua_upvalueindex(1))(L); }

// The length of a list that one of Lua's own functions is going to take the length of again.
lua_Integer length_for_good(lua_State* L) {
  if (luaL_getmetafield(L, 1, "__len") != LUA_TNIL)
    luaL_error(L,
               "the table has a length of its own (__len), which may be another each time; give a list without "
               "(--unsafe lifts this)");
  return static_cast<lua_Integer>(lua_rawlen(L, 1));
}

// An integer argument as Lua itself reads it: floats and strings that are whole numbers, too. What is none the original
// refuses.
lua_Integer integer_or(lua_State* L, int n, lua_Integer initial) {
  if (lua_isnoneornil(L, n)) return initial;
  int is_one = 0;
  const lua_Integer value = lua_tointegerx(L, n, &is_one);
  return is_one ? value : initial;
}

// Argument `n` is a text that the original reads.
template <int n>
int reading(lua_State* L) {
  std::size_t length = 0;
  if (lua_type(L, n) == LUA_TSTRING) lua_tolstring(L, n, &length);
  spend(L, work_a_byte_read * static_cast<double>(length));
  return original(L);
}

int concat(lua_State* L) {
  if (lua_istable(L, 1)) {
    const lua_Integer first = integer_or(L, 3, 1),
                      last = lua_isnoneornil(L, 4) ? length_for_good(L) : integer_or(L, 4, 0);
    if (last > first) spend(L, work_an_element * (static_cast<double>(last) - static_cast<double>(first)));
  }
  return original(L);
}

// a < b, counted: long strings take long.
int less(lua_State* L) {
  std::size_t work = 0;
  if (lua_type(L, 1) == LUA_TSTRING && lua_type(L, 2) == LUA_TSTRING)
    work = std::min(lua_rawlen(L, 1), lua_rawlen(L, 2));
  spend(L, work_a_comparison + work_a_byte_read * static_cast<double>(work));
  lua_pushboolean(L, lua_compare(L, 1, 2, LUA_OPLT));
  return 1;
}

int sort(lua_State* L) {
  if (lua_istable(L, 1)) {
    const double length = static_cast<double>(length_for_good(L));
    const bool numbers = lua_rawgeti(L, 1, 1) == LUA_TNUMBER;
    lua_pop(L, 1);
    if (lua_isnoneornil(L, 2) && !numbers) {
      lua_settop(L, 1);
      lua_pushcfunction(L, less);
    } else if (length > 1 && (lua_isnoneornil(L, 2) || lua_iscfunction(L, 2)))
      spend(L, work_a_comparison * length * std::log2(length));  // a function of Lua's that compares counts itself
  }
  return original(L);
}

// As Lua's string.find does: a pattern without any of these characters is searched for as it stands.
bool is_plain(lua_State* L) {
  if (lua_toboolean(L, 4)) return true;
  std::size_t length = 0;
  const char* pattern = lua_isstring(L, 2) ? lua_tolstring(L, 2, &length) : nullptr;
  return pattern && std::string_view(pattern, length).find_first_of("^$*+?.([%-") == std::string_view::npos;
}

// string.find(text, words, from, true). Lua's own takes as long as both lengths' product.
int find_plain(lua_State* L) {
  std::size_t length = 0, words_length = 0;
  const char *text = luaL_checklstring(L, 1, &length), *words = luaL_checklstring(L, 2, &words_length);
  const lua_Integer whole = static_cast<lua_Integer>(length), asked = luaL_optinteger(L, 3, 1);
  const lua_Integer begin = asked > 0 ? asked - 1 : asked == 0 || asked < -whole ? 0 : whole + asked;
  spend(L, work_a_byte_read *
               static_cast<double>(words_length + (begin < whole ? length - static_cast<std::size_t>(begin) : 0)));
  const void* found =
      begin > whole ? nullptr : memmem(text + begin, static_cast<std::size_t>(whole - begin), words, words_length);
  if (!found) {
    luaL_pushfail(L);
    return 1;
  }
  const lua_Integer at = static_cast<const char*>(found) - text;
  lua_pushinteger(L, at + 1);
  lua_pushinteger(L, at + static_cast<lua_Integer>(words_length));
  return 2;
}

enum class Search { find, match, gmatch, gsub };

template <Search search>
int pattern_function(lua_State* L) {
  constexpr bool all = search == Search::gsub || search == Search::gmatch;
  constexpr int begin_at = search == Search::gsub ? 0 : 3;  // argument
  if (search == Search::find && is_plain(L)) return find_plain(L);
  if (lua_isstring(L, 1) && lua_isstring(L, 2)) {
    std::size_t text_length = 0, pattern_length = 0;
    const char *text = lua_tolstring(L, 1, &text_length), *pattern = lua_tolstring(L, 2, &pattern_length);
    if (pattern_length > longest_pattern)
      return luaL_error(
          L,
          "the pattern has %I bytes, of %d at most; what is no pattern is found by string.find(text, words, 1, true)",
          static_cast<lua_Integer>(pattern_length), static_cast<int>(longest_pattern));
    const lua_Integer asked = begin_at ? integer_or(L, begin_at, 1) : 1;
    const lua_Integer length = static_cast<lua_Integer>(text_length);
    const lua_Integer begin = asked > 0 ? asked - 1 : asked == 0 || asked < -length ? 0 : length + asked;
    const double matches = search == Search::gsub && !lua_isnoneornil(L, 4) ? static_cast<double>(integer_or(L, 4, 0))
                           : all                                            ? 1e300
                                                                            : 1;
    double most = most_pattern_steps;
    const Limits& limits = limits_of(L);
    if (limits.budget > 0) most = std::min(most, std::max(0.0, limits.budget - limits.work) / work_a_pattern_step);
    const PatternSearch found =
        search_pattern({text, text_length}, {pattern, pattern_length}, static_cast<std::size_t>(begin), matches,
                       search != Search::gmatch, most);
    spend(L, found.steps * work_a_pattern_step);
    if (found.too_long) {
      if (limits.budget > 0 && most < most_pattern_steps) raise_over_budget(L);
      return luaL_error(L,
                        "the pattern takes more than %d million steps on this text of %I bytes; use fewer of * + - in "
                        "it, or a shorter text",
                        static_cast<int>(most_pattern_steps / 1e6), length);
    }
  }
  return original(L);
}

// string.rep of nothing would count to n all the same.
int rep(lua_State* L) {
  std::size_t length = 1, between = 0;
  if (lua_isstring(L, 1)) lua_tolstring(L, 1, &length);
  if (lua_isstring(L, 3)) lua_tolstring(L, 3, &between);
  if (length == 0 && between == 0 && lua_isnumber(L, 2)) {
    lua_pushliteral(L, "");
    return 1;
  }
  return original(L);
}

int date(lua_State* L) {
  std::size_t length = 0;
  if (lua_isstring(L, 1)) lua_tolstring(L, 1, &length);
  if (length > 1000) return luaL_error(L, "os.date: the format is longer than 1000 bytes");
  return original(L);
}

// table.insert and table.remove shift what a table says that it holds, if they are given a place; table.move what it is
// told to.
template <int with_place>
int shift(lua_State* L) {
  if (lua_istable(L, 1) && lua_gettop(L) >= with_place) {
    const lua_Integer length = length_for_good(L), place = lua_tointeger(L, 2);
    if (length > most_elements)
      return luaL_error(L, "the table says that it holds %I elements; more than %I cannot be shifted", length,
                        most_elements);
    spend(L, static_cast<double>(std::max<lua_Integer>(0, length - std::max<lua_Integer>(0, place))));
  }
  return original(L);
}

int move(lua_State* L) {
  const lua_Integer first = lua_tointeger(L, 2),
                    last = lua_tointeger(L, 3);  // 0 if they are no numbers: the original says so
  if (last >= first) {
    if (static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first) >= static_cast<lua_Unsigned>(most_elements))
      return luaL_error(L, "table.move: from %I to %I are more than %I elements", first, last, most_elements);
    spend(L, static_cast<double>(last - first));
  }
  return original(L);
}

// coroutine.wrap and coroutine.close close what a coroutine that failed still holds open. Lua calls no hook meanwhile,
// so that nothing could end it: once the budget is used up it stays open.
int close_coroutine(lua_State* L) {
  stop_if_used_up(L);
  const Running running(L, lua_tothread(L, 1));
  return original(L);
}

// A new coroutine is not looked at for as many instructions as the hook waits: they count when it is made, or many of
// them, each short, would never count.
int create_coroutine(lua_State* L) {
  spend(L, hook_period);
  return original(L);
}

int resume_coroutine(lua_State* L) {
  const Running running(L, lua_tothread(L, 1));
  return original(L);
}

// Upvalues: the coroutine, coroutine.resume and coroutine.close.
int resume_wrapped(lua_State* L) {
  lua_State* co = lua_tothread(L, lua_upvalueindex(1));
  lua_pushvalue(L, lua_upvalueindex(2));
  lua_insert(L, 1);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 2);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  if (lua_toboolean(L, 1)) return lua_gettop(L) - 1;
  stop_if_used_up(L);
  if (lua_status(co) > LUA_YIELD) {
    lua_pushvalue(L, lua_upvalueindex(3));
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_call(L, 1, 0);
  }
  if (lua_type(L, 2) == LUA_TSTRING) {
    luaL_where(L, 1);
    lua_insert(L, 2);
    lua_settop(L, 3);
    lua_concat(L, 2);
  }
  return lua_error(L);
}

int wrap_coroutine(lua_State* L) {
  luaL_checktype(L, 1, LUA_TFUNCTION);
  spend(L, hook_period);
  lua_State* co = lua_newthread(L);
  lua_pushvalue(L, 1);
  lua_xmove(L, co, 1);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_pushvalue(L, lua_upvalueindex(2));
  lua_pushcclosure(L, resume_wrapped, 3);
  return 1;
}

void replace(lua_State* L, const char* table, const char* name, lua_CFunction bounded) {
  lua_getglobal(L, table);
  lua_getfield(L, -1, name);
  lua_pushcclosure(L, bounded, 1);
  lua_setfield(L, -2, name);
  lua_pop(L, 1);
}

}  // namespace

void bound_libraries(lua_State* L) {
  replace(L, "string", "find", pattern_function<Search::find>);
  replace(L, "string", "match", pattern_function<Search::match>);
  replace(L, "string", "gmatch", pattern_function<Search::gmatch>);
  replace(L, "string", "gsub", pattern_function<Search::gsub>);
  replace(L, "string", "rep", rep);
  for (const char* name : {"pack", "packsize", "unpack"}) replace(L, "string", name, reading<1>);
  for (const char* name : {"len", "codepoint", "offset", "codes"}) replace(L, "utf8", name, reading<1>);
  replace(L, LUA_GNAME, "tonumber", reading<1>);
  replace(L, "os", "date", date);
  replace(L, "table", "concat", concat);
  replace(L, "table", "sort", sort);
  replace(L, "table", "insert", shift<3>);
  replace(L, "table", "remove", shift<2>);
  replace(L, "table", "move", move);
  replace(L, "coroutine", "create", create_coroutine);
  replace(L, "coroutine", "resume", resume_coroutine);
  replace(L, "coroutine", "close", close_coroutine);
  lua_getglobal(L, "coroutine");
  lua_getfield(L, -1, "resume");
  lua_getfield(L, -2, "close");
  lua_pushcclosure(L, wrap_coroutine, 2);
  lua_setfield(L, -2, "wrap");
  lua_pop(L, 1);
}

}  // namespace ricochet
