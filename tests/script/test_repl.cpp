// The repl: values keep, entries go on, objects are shown.

#include <poll.h>
#include <pty.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>

#include "script/program.hpp"
#include "script/source.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

Ended typed(const Workplace& here, const std::string& text) {
  here.write("typed.txt", text);
  return here.shell("ricochet repl <typed.txt");
}

/// The repl at a terminal, as someone at a keyboard has it.
class Terminal {
 public:
  explicit Terminal(const Workplace& here) {
    child_ = forkpty(&descriptor_, nullptr, nullptr, nullptr);
    if (child_ != 0) return;
    if (chdir(here.path.c_str()) != 0) _exit(1);
    setenv("HOME", here.path.c_str(), 1);
    setenv("TERM", "dumb", 1);
    unsetenv("XDG_STATE_HOME");
    execl(RICOCHET_PROGRAM, "ricochet", "repl", nullptr);
    _exit(1);
  }
  ~Terminal() {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    close(descriptor_);
  }
  Terminal(const Terminal&) = delete;

  /// Types, and gives what is shown until `awaited` is; all there is after a minute without it. What is typed before
  /// the next prompt stands, the terminal itself echoes: await the prompt.
  std::string type(const std::string& keys, const std::string& awaited) {
    std::string shown;
    if (write(descriptor_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size())) return shown;
    constexpr int minute = 60000;
    char text[4096];
    for (pollfd ready{descriptor_, POLLIN, 0}; shown.find(awaited) == std::string::npos;) {
      if (poll(&ready, 1, minute) <= 0) break;
      const ssize_t count = read(descriptor_, text, sizeof text);
      if (count <= 0) break;
      std::copy_if(text, text + count, std::back_inserter(shown), [](char c) { return c != '\a'; });
    }
    return shown;
  }

 private:
  int descriptor_ = -1;
  pid_t child_ = -1;
};

}  // namespace

TEST_CASE("at a terminal ^C gives up what was typed or what runs, tab completes, ^D ends, and lines are remembered") {
  const Workplace here;
  const auto contains = [](const char* text) { return Catch::Matchers::Contains(text); };
  {
    Terminal terminal(here);
    CHECK_THAT(terminal.type("", "\n> "), contains("help lists the reference"));
    CHECK_THAT(terminal.type("20 + 22\n", "42\r\n> "), contains("42"));
    CHECK_THAT(terminal.type("for i = 1, 2 do\n", ">> "), contains(">> "));
    CHECK_THAT(terminal.type("\x03", "> "), contains("> "));
    CHECK_THAT(terminal.type("50 + 3\n", "53\r\n> "), contains("53"));
    terminal.type("print('on') while true do end\n", "\non\r\n");
    CHECK_THAT(terminal.type("\x03", "\n> "), contains("interrupted"));
    CHECK_THAT(terminal.type("math.flo\t(64.5)\n", "64\r\n> "), contains("math.floor(64.5)"));
    CHECK_THAT(terminal.type("ricochet.theory.hert\t\n", "\n> "), contains("ricochet.theory.hertz"));
    terminal.type("\x04", "no such text");
  }
  CHECK_THAT(here.read(".local/state/ricochet/history"), contains("20 + 22\n"));
  Terminal again(here);
  again.type("", "\n> ");
  CHECK_THAT(again.type("\x10\x10\x10\x10\x10\x10\n", "42\r\n"), contains("20 + 22"));  // ^P: the line before
}

TEST_CASE("exit and quit end the repl, as does help with a word beside it tell of it") {
  const Workplace here;
  const Ended ended = typed(here, "help disk\nquit\nprint('not reached')\n");
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("  nodes          "));
  CHECK(ended.out.find("not reached") == std::string::npos);
  CHECK(typed(here, "exit\nprint('not reached')\n").out.find("not reached") == std::string::npos);
  // A value of the user's own goes first.
  CHECK_THAT(typed(here, "quit = 64\nquit\n").out, Catch::Matchers::Contains("64\n"));
}

TEST_CASE("what is local outside of every block is assigned instead") {
  CHECK(without_outer_locals("local x = 1") == "      x = 1");
  CHECK(without_outer_locals("local a, b") == "      a, b = nil");
  CHECK(without_outer_locals("local a local b = 2") == "      a = nil       b = 2");
  CHECK(without_outer_locals("local function f() local x = 1 end local y = 'local z'") ==
        "      function f() local x = 1 end       y = 'local z'");
  CHECK(without_outer_locals("for i = 1, 2 do local x end\nlocal t = { 'local' }") ==
        "for i = 1, 2 do local x end\n      t = { 'local' }");
}

TEST_CASE("values of the repl keep, and unfinished input goes on") {
  const Workplace here;
  const Ended ended = typed(here,
                            "local x = 2\ny = 3\nprint(x * y)\nlocal function f(a)\n  return a + x\nend\nf(y)\n"
                            "x = x + 1\nf(y)\nfor i = 1, 2 do\n  print(i)\nend\nlocal t = {\n\nnothing\n1 + 1\n");
  INFO(ended.out);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("> 6\n") && Catch::Matchers::Contains("> >> >> > 5\n") &&
                            Catch::Matchers::Contains("> 6\n> >> >> 1\n2\n") && Catch::Matchers::EndsWith("> 2\n> \n"));
  CHECK_THAT(ended.err, Catch::Matchers::Contains("unknown name 'nothing'") && Catch::Matchers::Contains("<eof>"));
}

TEST_CASE("rows, bodies, scenes and summaries are shown, in the repl and by print()") {
  const Workplace here;
  const std::string make =
      "local ricochet = require 'ricochet'\nlocal b = ricochet.disk { nodes = 60 }\n"
      "local s = ricochet.scene { projectile = b, target = ricochet.wall { nodes = 150, width = 4 }, effects = { "
      "ricochet.gravity { g = 1e-3 } } }\nlocal row = s:run()\n";
  const Ended printed =
      here.script(make + "print(b)\nprint(s)\nprint(row)\nprint(ricochet.materials.steel)\n", "--quiet");
  INFO(printed.err);
  CHECK_THAT(printed.out, Catch::Matchers::StartsWith("a body of springs, 2 x 2, 60 nodes\na scene\n  projectile: ") &&
                              Catch::Matchers::Contains("\n  with gravity\n") &&
                              Catch::Matchers::Contains("row\n  status                       finished\n") &&
                              Catch::Matchers::Contains("\n  e                            0.") &&
                              Catch::Matchers::Contains(" [R/c]\n") && Catch::Matchers::Contains("a material: E = "));
  CHECK(printed.out.find("nan") == std::string::npos);
  CHECK(printed.out.find("0x") == std::string::npos);
  const Ended shown = typed(here, make +
                                      "b\nrow\nricochet.still { scene = s, out = 'a', size = { 64, 48 } }\n"
                                      "ricochet.still { scene = s, out = 'a', size = { 64, 48 } }\n");
  INFO(shown.err);
  CHECK_THAT(shown.out, Catch::Matchers::Contains("> a body of springs, 2 x 2, 60 nodes\n") &&
                            Catch::Matchers::Contains("  status                       finished\n") &&
                            Catch::Matchers::Contains("picture: out/repl/a.png\n"));
  CHECK_FALSE(shown.out.find("picture: out/repl/a.png\n") == shown.out.rfind("picture: out/repl/a.png\n"));
  const Ended rows =
      here.script(std::string(small_sweep) + "print(rows)\nprint(rows:summary { by = 'psi1', of = { 'e' } })\n",
                  "samples=1 --quiet --force");
  CHECK_THAT(rows.out, Catch::Matchers::Contains("3 rows, 3 finished; ") && Catch::Matchers::Contains("\npsi1 "));
}

TEST_CASE("help lists the reference and tells of one function") {
  const Workplace here;
  const Ended ended = typed(here, "help\nhelp contact_time\nhelp 'disk'\nhelp 'ricochet.theory.hertz'\nhelp 'dsik'\n");
  CHECK_THAT(ended.out, Catch::Matchers::Contains("theory.hertz") &&
                            Catch::Matchers::Contains("contact_time [R/c]: ") && Catch::Matchers::Contains("disk: ") &&
                            Catch::Matchers::Contains("  nodes          ") && Catch::Matchers::Contains("gives "));
  CHECK_THAT(ended.err, Catch::Matchers::Contains("there is no 'dsik' in the reference (did you mean 'disk'?)"));
}
