#pragma once
#include <lua.hpp>
#include <memory>
#include <string>

#include "script/bounds.hpp"
#include "script/session.hpp"

namespace ricochet {

/// A Lua state with the module, in a sandbox: strict globals; no os.execute, io, debug, bytecode or native modules; a
/// memory limit; an instruction budget if the session sets one.
class State {
 public:
  explicit State(Session& session);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// Runs the session's script. Throws Error.
  void run_script();
  /// What accuracy costs in the first scene that the script made. Throws Error.
  void study_first_scene();
  /// Runs one piece of text (the repl). Throws Error. Prints the values of an expression.
  void run_text(const std::string& text);

  lua_State* lua() const { return L_; }

 private:
  void call_chunk(int results);

  Session& session_;
  std::unique_ptr<Limits> limits_ = std::make_unique<Limits>();
  lua_State* L_ = nullptr;
};

/// Throws Error if arguments were given to a script that declares no parameters.
void refuse_unused_arguments(const Session& session);

}  // namespace ricochet
