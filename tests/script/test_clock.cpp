// --max-seconds: a script is stopped wherever it is, and what was finished is kept.

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "impact/parallel.hpp"
#include "scenes.hpp"
#include "script/program.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

#ifdef __SANITIZE_THREAD__
constexpr bool signals_come_late = true;  // the sanitizer holds them back where nothing of its own is called
#else
constexpr bool signals_come_late = false;
#endif

struct Stopped {
  const char* name;
  const char* script;
  const char* place;  ///< with a line: at an instruction; without: in one call
  Ended ended;
  double seconds;
};

}  // namespace

TEST_CASE("a script without end is stopped at its line, or a second later in the call that it sits in") {
  std::vector<Stopped> scripts{
      {"a loop", "local n = 0\nwhile true do n = n + 1 end", "s.lua:2"},
      {"in a coroutine", "local co = coroutine.wrap(function()\n  while true do end\nend)\nco()", "s.lua:2"},
      {"in a coroutine of a coroutine",
       "local create, resume = coroutine.create, coroutine.resume\nresume(create(function() resume(create(function()\n"
       "  while true do end\nend)) end))",
       "s.lua:3"},
      {"in the coroutine that goes on when another was stopped",
       "coroutine.wrap(function()\n  pcall(coroutine.wrap(function() while true do end end))\n  while true do "
       "end\nend)()",
       "s.lua:2"},
      {"in pcall", "while true do\n  pcall(function() while true do end end)\nend", "s.lua:2"},
      {"in xpcall, by a handler that goes on", "while true do\n  xpcall(function() while true do end end, print)\nend",
       "s.lua:2"},
      {"in a new coroutine each time", "while true do\n  pcall(coroutine.wrap(function() while true do end end))\nend",
       "s.lua:2"},
      {"by __close", "local x <close> = setmetatable({}, { __close = function() while true do end end })\nerror('x')",
       "s.lua:1"},
      {"in text that was loaded", "local f = load('while true do end')\nf()", "s.lua:2"},
      {"in a function that the library calls",
       "local ricochet = require 'ricochet'\nricochet.body { outline = { {0, 0}, {1, 0}, {0, 1} }, nodes = 50,\n"
       "  anchored = function() while true do end end }",
       "s.lua:3"},
      {"in a search", "print(('a'):rep(3000):find(('.-'):rep(20) .. 'b'))", "s.lua"},
      {"in a repetition", "print((''):rep(1e18))", "s.lua"},
      {"in a handler of the stop itself", "xpcall(function() while true do end end, function() while true do end end)",
       "s.lua"},
      {"in __close of a coroutine that was stopped",
       "coroutine.wrap(function()\n  local x <close> = setmetatable({}, { __close = function() while true do end end "
       "})\n"
       "  while true do end\nend)()",
       "s.lua"},
  };
  in_parallel(scripts, 4, [](Stopped& s) {
    const Workplace here;
    const auto began = std::chrono::steady_clock::now();
    s.ended = here.script(s.script, "--max-seconds 0.7");
    s.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  });
  for (const Stopped& s : scripts) {
    INFO(s.name << ": " << s.ended.err);
    const std::string place = s.place;
    CHECK(s.ended.status == 1);
    CHECK(s.ended.err.starts_with("error: script stopped: --max-seconds 0.7 reached at s.lua"));
    if (!signals_come_late || place == "s.lua")
      CHECK(s.ended.err == "error: script stopped: --max-seconds 0.7 reached at " + place + "\n");
    CHECK(s.seconds > (place == "s.lua" ? 1.7 : 0.7));
    CHECK(s.seconds < 20);  // 1.7 and 0.7 on a machine that does nothing else
  }
}

TEST_CASE("a sweep that its time ends keeps what is finished, and --resume completes it") {
  const Workplace here;
  // On a quiet core 0.1 s before the first impact, and 38 ms for each: two seconds are enough for a few, on a core ten
  // times as busy too, and never for all.
  here.write("s.lua", R"(local ricochet = require "ricochet"
ricochet.sweep { name = "s", over = { sample = ricochet.range(200) }, scene = function(at)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = 200, placement = "uniform", seed = at.sample },
    target = ricochet.wall { width = 4, depth = 1.5, nodes = 600, placement = "uniform", seed = at.sample },
    contact = { V0 = 150, xi = 300 },
  }
end }:run()
)");
  const std::string limit = sanitized ? "40" : "2";
  const Ended ended = here.run("s.lua --quiet --threads 1 --batch 1 --max-seconds " + limit);
  INFO(ended.err);
  CHECK(ended.status == 1);
  CHECK_THAT(ended.err,
             Catch::Matchers::StartsWith("error: script stopped: --max-seconds " + limit + " reached at s.lua:2: "));
  CHECK_THAT(ended.err,
             Catch::Matchers::EndsWith(" of 200 impacts are stored in out/s; --resume goes on from there\n"));
  CHECK_THAT(here.read("out/s/run.log"), Catch::Matchers::Contains(ended.err));
  CHECK_FALSE(fs::exists(here.path / "out/s/parts"));
  const std::size_t rows = read_table(here.path / "out/s/results.h5").rows();
  CHECK(rows > 0);
  CHECK(rows < 200);

  const Ended resumed = here.run("s.lua --quiet --resume --max-seconds 500");
  INFO(resumed.err);
  CHECK(resumed.status == 0);
  CHECK(resumed.err.empty());
  CHECK(read_table(here.path / "out/s/results.h5").rows() == 200);
}

TEST_CASE("without --max-seconds a call may take as long as it likes, and in time nothing is said of it") {
  const Workplace here;
  // Each takes a tenth of a second or more: a search of 2e8 steps, a sort, a loop.
  const std::string slow =
      "print(('a'):rep(250):find('.-.-.-b'))\nlocal t = {} for i = 1, 3e5 do t[i] = -i end table.sort(t)\n"
      "local n = 0 for i = 1, 3e7 do n = n + 1 end\nprint(n)";
  for (const char* limit : {"", "--max-seconds 300"}) {
    const Ended ended = here.script(slow, std::string("--force ") + limit);
    INFO(ended.err);
    CHECK(ended.status == 0);
    CHECK(ended.err.empty());
    CHECK(ended.out == "nil\n30000000\n");
  }
}

TEST_CASE("a plot that gnuplot is drawing ends with the run") {
  const Workplace here;
  here.write("bin/gnuplot", "#!/bin/sh\necho $$ >drawing\nexec sleep 60\n");
  fs::permissions(here.path / "bin/gnuplot", fs::perms::owner_all);
  here.write("s.lua",
             "local ricochet = require 'ricochet' ricochet.plot { x = 'x', y = { 'y' }, theory = { y = function(x) "
             "return x end }, xrange = { 0, 1 }, name = 'p' }");
  const Ended ended =
      here.shell("PATH='" + (here.path / "bin").string() + "':\"$PATH\" ricochet run s.lua --unsafe --max-seconds 1");
  CHECK(ended.err == "error: script stopped: --max-seconds 1 reached at s.lua\n");
  const fs::path process = "/proc/" + here.shell("printf %s $(cat out/s/drawing)").out;
  const auto runs = [&] { return here.shell("grep -q '^State:.[^Z]' " + (process / "status").string()).status == 0; };
  for (int i = 0; i < 100 && runs(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  CHECK_FALSE(runs());
}

TEST_CASE("^C ends a script at its next instruction; in the repl a mistake ends only what was typed") {
  const Workplace here;
  here.write("s.lua", "local n = 0\nwhile true do n = n + 1 end");
  const Ended ended = here.shell("'" RICOCHET_PROGRAM "' run s.lua & sleep 0.7; kill -INT $!; wait $!");
  if (!signals_come_late) CHECK(ended.err == "error: interrupted\n");
  CHECK(ended.status == 130);

  here.write("in.txt", "setmetatable({}, {__gc = print})\nlocal function f() return 1 + f() end f()\n1 + 1\n");
  const Ended typed = here.shell("ricochet repl <in.txt");
  CHECK(typed.status == 0);
  CHECK_THAT(typed.err,
             Catch::Matchers::Contains("__gc is not for scripts") && Catch::Matchers::Contains("stack overflow"));
  CHECK_THAT(typed.out, Catch::Matchers::Contains("> 2\n"));
}
