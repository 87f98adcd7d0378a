#include "script/bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string_view>

#include "script/reader.hpp"

namespace ricochet {
namespace {

constexpr std::size_t usual_text =
    100'000;  // bytes; two of zeros, the slowest, are compared in 0.85 ms, which 500 instructions do some 150 times
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
    if (line.empty() || !inside)
      line = fmt::format("{}:{}", frame.source[0] == '@' ? frame.source + 1 : frame.short_src, frame.currentline);
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

}  // namespace

void Limits::note_line() {
  if (state) refused_at = line_of(state);
}

Limits& limits_of(lua_State* L) {
  void* limits = nullptr;
  lua_getallocf(L, &limits);
  return *static_cast<Limits*>(limits);
}

void raise_over_budget(lua_State* L) {
  lua_sethook(L, watch, LUA_MASKCOUNT, 1);
  const std::string line = line_of(L);
  lua_pushstring(
      L, fmt::format(
             "{}{}the script used up its budget of {:.0f} instructions; raise --budget or look for a loop without end",
             line, line.empty() ? "" : ": ", limits_of(L).budget)
             .c_str());
  lua_error(L);
}

int period_of(const Limits& limits) {
  constexpr double fewest = 5;
  const std::size_t longest = limits.long_sizes.empty() ? usual_text : *limits.long_sizes.rbegin();
  return static_cast<int>(
      std::max(fewest, hook_period * static_cast<double>(usual_text) / static_cast<double>(longest)));
}

// Called from within Lua: only what allocates none of its memory.
void* allocate(void* opaque, void* block, std::size_t old_size, std::size_t size) {
  auto& limits = *static_cast<Limits*>(opaque);
  const std::size_t before = block ? old_size : 0;
  if (size == 0) {
    if (before > usual_text)
      if (const auto text = limits.long_texts.find(block); text != limits.long_texts.end()) {
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
  // For a new object Lua gives its type as the old size. A text so long takes long to compare: the hook is to look at
  // once, and more often while the text is held. [lua_sethook may be called at any moment]
  if (result && !block && old_size == LUA_TSTRING && size > usual_text && limits.budget > 0) {
    limits.long_texts[result] = size;
    limits.long_sizes.insert(size);
    if (limits.running)
      lua_sethook(limits.running, watch, LUA_MASKCOUNT, std::min(lua_gethookcount(limits.running), period_of(limits)));
  }
  return result;
}

void stop_if_used_up(lua_State* L) {
  const Limits& limits = limits_of(L);
  if (stop_requested) luaL_error(L, "interrupted");
  if (limits.budget > 0 && limits.work > limits.budget) raise_over_budget(L);
}

void spend(lua_State* L, double work) {
  limits_of(L).work += work;
  stop_if_used_up(L);
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
    const double now = thread_seconds(), own = now - limits.seconds - limits.engine_seconds,
                 counted = limits.work - limits.looked;
    // Over as many instructions as usual, so that one that had to wait for memory is no cause. What was counted beside
    // instructions is part of that time.
    if (counted >= hook_period || own > hook_period * slowest_instruction) {
      if (own > counted * slowest_instruction)
        limits.work = std::max(limits.work, limits.looked + own / usual_instruction);
      limits.seconds = now;
      limits.engine_seconds = 0;
      limits.looked = limits.work;
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
  limits_of(L).seconds = thread_seconds();
  limits_of(L).running = L;
  lua_sethook(L, watch, LUA_MASKCOUNT, hook_period);
}

}  // namespace ricochet
