#include "script/bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string_view>

#include "script/pattern.hpp"
#include "script/reader.hpp"

namespace ricochet {
namespace {

// Without a budget: a second or so.
constexpr double most_pattern_steps = 1e8;
constexpr lua_Integer most_elements = 50'000'000;
constexpr std::size_t longest_pattern = 100'000;
constexpr std::size_t usual_text = 100'000;  // bytes; 500 comparisons of those take a tenth of a second
constexpr std::size_t piece_of_text = 256;  // bytes that Lua reads before it is looked at how long it took

// "file:line" that is running, of the script rather than of the library that it calls; "" if no Lua is.
std::string line_of(lua_State* L) {
  const std::string library = "@" + session_of(L).library.string() + "/";
  std::string line;
  lua_Debug frame;
  for (int level = 0; level < most_levels && lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "Sl", &frame);
    if (frame.currentline <= 0) continue;
    const bool inside = std::string_view(frame.source).starts_with(library);
    if (line.empty() || !inside) line = fmt::format("{}:{}", frame.source[0] == '@' ? frame.source + 1 : frame.short_src, frame.currentline);
    if (!inside) break;
  }
  return line;
}

// Of this thread's own work.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void raise_over_budget(lua_State* L) {
  lua_sethook(L, watch, LUA_MASKCOUNT, 1);
  const std::string line = line_of(L);
  lua_pushstring(L, fmt::format("{}{}the script used up its budget of {:.0f} instructions; raise --budget or look for a loop without end", line, line.empty() ? "" : ": ", limits_of(L).budget).c_str());
  lua_error(L);
}

// Instructions between looks: where one may compare texts of megabytes, few.
int period_of(const Limits& limits) {
  constexpr double fewest = 5;
  const std::size_t longest = limits.long_sizes.empty() ? usual_text : *limits.long_sizes.rbegin();
  return static_cast<int>(std::max(fewest, hook_period * static_cast<double>(usual_text) / static_cast<double>(longest)));
}

// While it lives, the coroutine's instructions are those that run.
class Running {
 public:
  Running(lua_State* L, lua_State* co) : limits_(limits_of(L)), before_(limits_.running) {
    if (!co || !before_) return;
    limits_.running = co;
    if (const int period = period_of(limits_); lua_gethookcount(co) > period) lua_sethook(co, watch, LUA_MASKCOUNT, period);
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
  if (luaL_getmetafield(L, 1, "__len") != LUA_TNIL) luaL_error(L, "the table has a length of its own (__len), which may be another each time; give a list without (--unsafe lifts this)");
  return static_cast<lua_Integer>(lua_rawlen(L, 1));
}

// An integer argument as Lua itself reads it: floats and strings that are whole numbers, too. What is none the original refuses.
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
    const lua_Integer first = integer_or(L, 3, 1), last = lua_isnoneornil(L, 4) ? length_for_good(L) : integer_or(L, 4, 0);
    if (last > first) spend(L, work_an_element * (static_cast<double>(last) - static_cast<double>(first)));
  }
  return original(L);
}

// a < b, counted: long strings take long.
int less(lua_State* L) {
  std::size_t work = 0;
  if (lua_type(L, 1) == LUA_TSTRING && lua_type(L, 2) == LUA_TSTRING) work = std::min(lua_rawlen(L, 1), lua_rawlen(L, 2));
  spend(L, work_a_comparison + work_a_byte_read * static_cast<double>(work));
  stop_if_used_up(L);
  lua_pushboolean(L, lua_compare(L, 1, 2, LUA_OPLT));
  return 1;
}

int sort(lua_State* L) {
  if (lua_istable(L, 1)) {
    const double length = static_cast<double>(length_for_good(L));
    const bool numbers = lua_rawgeti(L, 1, 1) == LUA_TNUMBER;
    lua_pop(L, 1);
    if (lua_isnoneornil(L, 2) && !numbers) lua_settop(L, 1), lua_pushcfunction(L, less);
    else if (length > 1 && (lua_isnoneornil(L, 2) || lua_iscfunction(L, 2))) spend(L, work_a_comparison * length * std::log2(length));  // a function of Lua's that compares counts itself
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
  spend(L, work_a_byte_read * static_cast<double>(words_length + (begin < whole ? length - static_cast<std::size_t>(begin) : 0)));
  const void* found = begin > whole ? nullptr : memmem(text + begin, static_cast<std::size_t>(whole - begin), words, words_length);
  if (!found) {
    luaL_pushfail(L);
    return 1;
  }
  const lua_Integer at = static_cast<const char*>(found) - text;
  lua_pushinteger(L, at + 1), lua_pushinteger(L, at + static_cast<lua_Integer>(words_length));
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
      return luaL_error(L, "the pattern has %d million bytes or more, above the %d that patterns may have; what is no pattern is found by string.find(text, words, 1, true)", static_cast<int>(pattern_length / 1000000), static_cast<int>(longest_pattern));
    const lua_Integer asked = begin_at ? integer_or(L, begin_at, 1) : 1;
    const lua_Integer length = static_cast<lua_Integer>(text_length);
    const lua_Integer begin = asked > 0 ? asked - 1 : asked == 0 || asked < -length ? 0 : length + asked;
    const double matches = search == Search::gsub && !lua_isnoneornil(L, 4) ? static_cast<double>(integer_or(L, 4, 0)) : all ? 1e300 : 1;
    double most = most_pattern_steps;
    const Limits& limits = limits_of(L);
    if (limits.budget > 0) most = std::min(most, std::max(0.0, limits.budget - limits.work) / work_a_pattern_step);
    const PatternSearch found = search_pattern({text, text_length}, {pattern, pattern_length}, static_cast<std::size_t>(begin), matches, search != Search::gmatch, most);
    spend(L, found.steps * work_a_pattern_step);
    if (found.too_long) {
      if (limits.budget > 0 && most < most_pattern_steps) raise_over_budget(L);
      return luaL_error(L, "the pattern takes more than %d million steps on this text of %I bytes; use fewer of * + - in it, or a shorter text", static_cast<int>(most_pattern_steps / 1e6), length);
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

// table.insert and table.remove shift what a table says that it holds, if they are given a place; table.move what it is told to.
template <int with_place>
int shift(lua_State* L) {
  if (lua_istable(L, 1) && lua_gettop(L) >= with_place) {
    const lua_Integer length = length_for_good(L), place = lua_tointeger(L, 2);
    if (length > most_elements) return luaL_error(L, "the table says that it holds %I elements; more than %I cannot be shifted", length, most_elements);
    spend(L, static_cast<double>(std::max<lua_Integer>(0, length - std::max<lua_Integer>(0, place))));
  }
  return original(L);
}

int move(lua_State* L) {
  const lua_Integer first = lua_tointeger(L, 2), last = lua_tointeger(L, 3);  // 0 if they are no numbers: the original says so
  if (last >= first) {
    if (static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first) >= static_cast<lua_Unsigned>(most_elements))
      return luaL_error(L, "table.move: from %I to %I are more than %I elements", first, last, most_elements);
    spend(L, static_cast<double>(last - first));
  }
  return original(L);
}

// coroutine.wrap and coroutine.close close what a coroutine that failed still holds open. Lua calls no hook meanwhile, so that nothing
// could end it: once the budget is used up it stays open.
int close_coroutine(lua_State* L) {
  stop_if_used_up(L);
  const Running running(L, lua_tothread(L, 1));
  return original(L);
}

// A new coroutine is not looked at for as many instructions as the hook waits: they count when it is made, or many of them, each short, would never count.
int create_coroutine(lua_State* L) {
  spend(L, hook_period);
  stop_if_used_up(L);
  return original(L);
}

int resume_coroutine(lua_State* L) {
  const Running running(L, lua_tothread(L, 1));
  return original(L);
}

// Upvalues: the coroutine, coroutine.resume and coroutine.close.
int resume_wrapped(lua_State* L) {
  lua_State* co = lua_tothread(L, lua_upvalueindex(1));
  lua_pushvalue(L, lua_upvalueindex(2)), lua_insert(L, 1);
  lua_pushvalue(L, lua_upvalueindex(1)), lua_insert(L, 2);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  if (lua_toboolean(L, 1)) return lua_gettop(L) - 1;
  stop_if_used_up(L);
  if (lua_status(co) > LUA_YIELD) lua_pushvalue(L, lua_upvalueindex(3)), lua_pushvalue(L, lua_upvalueindex(1)), lua_call(L, 1, 0);
  if (lua_type(L, 2) == LUA_TSTRING) luaL_where(L, 1), lua_insert(L, 2), lua_settop(L, 3), lua_concat(L, 2);
  return lua_error(L);
}

int wrap_coroutine(lua_State* L) {
  luaL_checktype(L, 1, LUA_TFUNCTION);
  spend(L, hook_period);
  stop_if_used_up(L);
  lua_State* co = lua_newthread(L);
  lua_pushvalue(L, 1), lua_xmove(L, co, 1);
  lua_pushvalue(L, lua_upvalueindex(1)), lua_pushvalue(L, lua_upvalueindex(2));
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

void Limits::note_line() {
  if (state) refused_at = line_of(state);
}

Limits& limits_of(lua_State* L) {
  void* limits = nullptr;
  lua_getallocf(L, &limits);
  return *static_cast<Limits*>(limits);
}

// Called from within Lua: only what allocates none of its memory.
void* allocate(void* opaque, void* block, std::size_t old_size, std::size_t size) {
  auto& limits = *static_cast<Limits*>(opaque);
  const std::size_t before = block ? old_size : 0;
  if (size == 0) {
    if (const auto text = limits.long_texts.find(block); before > usual_text && text != limits.long_texts.end()) {
      limits.long_sizes.erase(limits.long_sizes.find(text->second));
      limits.long_texts.erase(text);
    }
    std::free(block);
    limits.used -= before;
    return nullptr;
  }
  if (size > before) {
    const double work = static_cast<double>(size - before) * work_a_byte;
    const bool over = limits.budget > 0 && work > 1e3 && limits.work + work > limits.budget;
    if (over || limits.used + (size - before) > limits.most) {
      limits.over_budget = over;
      limits.note_line();
      return nullptr;
    }
    limits.work += work;
  }
  void* result = std::realloc(block, size);
  if (result) limits.used += size - before;
  // For a new object Lua gives its type as the old size. A text so long takes long to compare: the hook is to look at once, and more often while
  // the text is held. [lua_sethook may be called at any moment]
  if (result && !block && old_size == LUA_TSTRING && size > usual_text && limits.budget > 0) {
    limits.long_texts[result] = size, limits.long_sizes.insert(size);
    if (limits.running) lua_sethook(limits.running, watch, LUA_MASKCOUNT, std::min(lua_gethookcount(limits.running), period_of(limits)));
  }
  return result;
}

void stop_if_used_up(lua_State* L) {
  const Limits& limits = limits_of(L);
  if (stop_requested) luaL_error(L, "interrupted");
  if (limits.budget > 0 && limits.work > limits.budget) raise_over_budget(L);
}

void spend(lua_State* L, double work) {
  Limits& limits = limits_of(L);
  limits.work += work;
  if (limits.budget > 0 && limits.work > limits.budget) raise_over_budget(L);
}

// Once over the budget it is called at every instruction, so that a script that catches the error gets no further.
void watch(lua_State* L, lua_Debug*) {
  if (stop_requested) {
    lua_sethook(L, watch, LUA_MASKCOUNT, 1);
    lua_pushliteral(L, "interrupted");
    lua_error(L);
  }
  Limits& limits = limits_of(L);
  const int period = lua_gethookcount(L);
  limits.work += period;
  if (limits.budget > 0) {
    if (const int next = period_of(limits); next != period) lua_sethook(L, watch, LUA_MASKCOUNT, next);
    const double now = thread_seconds(), own = now - limits.seconds - limits.engine_seconds, counted = limits.work - limits.looked;
    // Over as many instructions as usual, so that one that had to wait for memory is no cause. What was counted beside instructions is part of that time.
    if (counted >= hook_period || own > hook_period * slowest_instruction) {
      if (own > counted * slowest_instruction) limits.work = std::max(limits.work, limits.looked + own / usual_instruction);
      limits.seconds = now, limits.engine_seconds = 0, limits.looked = limits.work;
    }
  }
  if (limits.budget <= 0 || limits.work <= limits.budget) return;
  raise_over_budget(L);
}

int load_counted(lua_State* L, std::string_view text, const std::string& name) {
  struct Text {
    std::string_view rest;
    double seconds;
  } from{text, thread_seconds()};
  const lua_Reader piece = [](lua_State* state, void* data, std::size_t* size) -> const char* {
    auto& [rest, seconds] = *static_cast<Text*>(data);
    Limits& limits = limits_of(state);
    const double now = thread_seconds(), took = now - seconds;
    seconds = now;
    if (took > piece_of_text * slowest_instruction) limits.work += took / usual_instruction;
    stop_if_used_up(state);
    *size = std::min(rest.size(), piece_of_text);
    const char* begin = rest.data();
    rest.remove_prefix(*size);
    return *size > 0 ? begin : nullptr;
  };
  return lua_load(L, piece, &from, name.c_str(), "t");
}

EngineTime::EngineTime(lua_State* L) : limits_(limits_of(L)), began_(limits_.budget > 0 ? thread_seconds() : 0) {}
EngineTime::~EngineTime() {
  if (limits_.budget > 0) limits_.engine_seconds += thread_seconds() - began_;
}

void start_counting(lua_State* L) {
  limits_of(L).seconds = thread_seconds(), limits_of(L).running = L;
  lua_sethook(L, watch, LUA_MASKCOUNT, hook_period);
}

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
  lua_getfield(L, -1, "resume"), lua_getfield(L, -2, "close");
  lua_pushcclosure(L, wrap_coroutine, 2);
  lua_setfield(L, -2, "wrap");
  lua_pop(L, 1);
}

}  // namespace ricochet
