#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>

#include "sandbox/sandbox.hpp"

namespace ricochet {

std::atomic<bool> stop_requested{false};
std::atomic<int> Storing::now{0};

namespace {

std::atomic<lua_State*> running{nullptr};  // read by a signal's handler
std::atomic<double> limit_reached{0};      // seconds
pthread_t interpreter;
std::string script, stopped_at;  // "s.lua", "s.lua:3"

std::string time_is_up_at(const std::string& place) {
  return fmt::format("script stopped: --max-seconds {:g} reached at {}", limit_reached.load(), place);
}

// At every instruction from then on, so that a script that catches the error gets no further.
void stop(lua_State* L, lua_Debug*) {
  note_stop(L);
  lua_pushliteral(L, "interrupted");
  lua_error(L);
}

void stop_if_asked(lua_State* L) {
  if (L && stop_requested) lua_sethook(L, stop, LUA_MASKCOUNT, 1);
}

// In the interpreter's own thread, as in lua.c.
extern "C" void on_asked(int) { stop_if_asked(running); }

// While it lives, this coroutine is what runs.
struct Running {
  explicit Running(lua_State* coroutine) : before(running) {
    if (coroutine && before) running = coroutine;
    stop_if_asked(running);
  }
  ~Running() {
    running = before;
    stop_if_asked(before);
  }
  lua_State* before;
};

// coroutine.resume and coroutine.close.
int resume(lua_State* L) {
  const Running now(lua_tothread(L, 1));
  return original(L);
}

// What coroutine.wrap makes: a function with the coroutine as upvalue.
int resume_wrapped(lua_State* L) {
  const Running now(lua_tothread(L, lua_upvalueindex(1)));
  return original(L, 2);
}

int wrap(lua_State* L) {
  original(L);
  lua_getupvalue(L, -1, 1);
  lua_insert(L, -2);
  lua_pushcclosure(L, resume_wrapped, 2);
  return 1;
}

void watch(const std::stop_token& over, double seconds) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any ended;
  const auto over_within = [&](double time) {
    return ended.wait_for(lock, over, std::chrono::duration<double>(time), [&] { return over.stop_requested(); });
  };
  if (over_within(seconds)) return;
  limit_reached = seconds;
  ask_to_stop();
  if (over_within(1) || (Storing::now > 0 && over_within(grace - 1))) return;
  // Files are whole at any moment. All else belongs to threads that are in the midst of it.
  const std::string words = "error: " + time_is_up_at(script) + "\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
  _exit(static_cast<int>(Exit::script));
}

}  // namespace

bool ask_to_stop() {
  const bool before = stop_requested.exchange(true);
  if (running.load()) pthread_kill(interpreter, SIGUSR1);
  return before;
}

void note_stop(lua_State* L) {
  if (stop_requested && stopped_at.empty()) stopped_at = sandbox_of(L).given.where(L);
}

Clock::Clock(lua_State* L, double seconds, const std::string& file) {
  limit_reached = 0;
  script = file;
  stopped_at.clear();
  interpreter = pthread_self();
  std::signal(SIGUSR1, on_asked);  // as BSD has it: calls that the signal interrupts go on
  running = L;
  stop_if_asked(L);
  if (seconds > 0) watcher_ = std::jthread(watch, seconds);
}

Clock::~Clock() { running = nullptr; }

std::string Clock::time_is_up() {
  return limit_reached > 0 ? time_is_up_at(stopped_at.empty() ? script : stopped_at) : "";
}

void open_coroutines(lua_State* L) {
  lua_getglobal(L, LUA_COLIBNAME);
  for (const luaL_Reg& f : {luaL_Reg{"resume", resume}, {"close", resume}, {"wrap", wrap}}) {
    lua_getfield(L, -1, f.name);
    lua_pushcclosure(L, f.func, 1);
    lua_setfield(L, -2, f.name);
  }
  lua_pop(L, 1);
}

}  // namespace ricochet
