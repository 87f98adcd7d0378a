#pragma once
// What a script may use up: memory, and work counted in Lua instructions, wherever it is done.

#include <cstddef>
#include <lua.hpp>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

namespace ricochet {

struct Limits {
  std::size_t used = 0, most = std::size_t{2} << 30;  ///< bytes of Lua's own memory
  double work = 0;                                    ///< Lua instructions executed so far, and what else costs as much
  double budget = 0;                                  ///< greatest work; 0: no limit
  double seconds = 0, engine_seconds = 0;  ///< of this thread at the last look; since then spent in our own functions
  double looked = 0;                       ///< work at that look
  lua_State *state = nullptr,
            *running = nullptr;  ///< running: the coroutine that runs, or the script itself; none before and after it
  std::unordered_map<void*, std::size_t>
      long_texts;  ///< strings so long that comparing them takes long, and their bytes; under a budget only
  std::multiset<std::size_t> long_sizes;  ///< of those
  std::string refused_at;                 ///< "file:line" of the last refusal of memory
  bool over_budget = false;               ///< that refusal was for the work of filling so much

  void note_line();
};

// Work in instructions, as measured against a loop of Lua: one takes about 5 ns.
inline constexpr double work_a_byte = 1 / 16.0;         // of new memory
inline constexpr double work_a_pattern_step = 1 / 3.0;  // of a search
inline constexpr double work_a_file =
    1e5;  // written and synced: 0.6 ms on a quiet machine, ten times that beside a build
inline constexpr double work_a_node = 20;        // placed
inline constexpr double work_a_byte_read = 1;    // of a text read by one of Lua's own functions; 0.4 (tonumber), 1.3
                                                 // (packsize), up to 6 in the hardest plain search
inline constexpr double work_an_element = 6;     // of a table joined
inline constexpr double work_a_value_read = 50;  // of a parameter, shown in help
inline constexpr double work_a_comparison = 8;   // of a table sorted
inline constexpr double work_a_node_stretched = 1000;  // by ricochet.elasticity
inline constexpr double work_a_plot = 5e5;  // a thirtieth of its time, so that small budgets leave room for some
// Instructions that take longer than this on average have done what nobody counted (comparing long strings, searching
// emptied tables), and cost their time. Loops that make tables, strings or formatted numbers take 0.1 to 0.2 us an
// instruction.
inline constexpr double slowest_instruction = 1e-6, usual_instruction = 5e-9;  // [s]

Limits& limits_of(lua_State* L);

/// While it lives, time is our own functions', which count their work themselves. Impacts count none: a budget bounds
/// the script, not the physics.
class EngineTime {
 public:
  explicit EngineTime(lua_State* L);
  ~EngineTime();
  EngineTime(const EngineTime&) = delete;

 private:
  Limits& limits_;
  double began_;
};

/// Names that are looked through for one that was meant.
inline constexpr std::size_t most_names = 1000;

/// Calls in calls that are looked through for a line or a name; each costs as many steps as it is deep.
inline constexpr int most_levels = 1000;

/// Sets the hook of a new state, and begins to count.
void start_counting(lua_State* L);

/// Loads a chunk of text as luaL_loadbufferx does. Lua may take long over little (names among thousands of locals):
/// that counts as the time it takes, and a signal or a used up budget ends it.
int load_counted(lua_State* L, std::string_view text, const std::string& name);

/// Allocates for Lua within the limits; what new memory costs to fill counts as work.
void* allocate(void* limits, void* block, std::size_t old_size, std::size_t size);

/// Counts work that no instruction stands for; raises Lua's error if the budget is used up, or the run is to stop.
void spend(lua_State* L, double work);

/// Instructions between looks: where a script may compare texts of megabytes, few.
int period_of(const Limits& limits);

/// Raises Lua's error of a budget that is used up; the script gets no further even if it catches it.
void raise_over_budget(lua_State* L);

/// Raises Lua's error if the budget is used up, or the run is to stop.
void stop_if_used_up(lua_State* L);

/// The hook that counts instructions and sees ^C.
void watch(lua_State* L, lua_Debug*);
inline constexpr int hook_period = 500;  // instructions, fewer where a long text is held

/// Replaces functions of Lua's libraries that may run for ever without an instruction by those that cannot.
void bound_libraries(lua_State* L);

}  // namespace ricochet
