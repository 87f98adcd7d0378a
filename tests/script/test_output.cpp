// Output that cannot be written never ends a run, and what of it matters is told.

#include <catch2/catch.hpp>

#include "script/program.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

bool whole(const Workplace& here, const std::string& folder) {
  return fs::exists(here.path / folder / "s/results.h5") && !fs::exists(here.path / folder / "s/parts");
}

}  // namespace

TEST_CASE(
    "a run whose standard error is closed, full or read no further goes on in silence and ends as it would have") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  CHECK(here.shell("ricochet run s.lua samples=1 --out closed 2>&-").status == 0);
  CHECK(here.shell("ricochet run s.lua samples=1 --out full 2>/dev/full").status == 0);
  here.shell("{ ricochet run s.lua samples=3 --out pipe 2>&1 >/dev/null; echo $? >status.txt; } | true");
  CHECK(here.read("status.txt") == "0\n");
  for (const char* folder : {"closed", "full", "pipe"}) CHECK(whole(here, folder));
  CHECK(here.shell("ricochet run nosuch.lua 2>&-").status == 4);
  CHECK(here.shell("ricochet frobnicate 2>/dev/full").status == 2);
}

TEST_CASE(
    "standard output that nobody reads on is no error, one that cannot be written is told, and results are whole") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  CHECK(here.shell("{ ricochet run s.lua samples=1 --out pipe; echo $? >status.txt; } | true").err.find("error") ==
        std::string::npos);
  CHECK(here.read("status.txt") == "0\n");
  CHECK(whole(here, "pipe"));
  for (const char* to : {">/dev/full", ">&-"}) {
    const std::string out = to[1] == '&' ? "closed" : "full";
    const Ended ended = here.shell("ricochet run s.lua samples=1 --quiet --out " + out + " " + to);
    CHECK(ended.status == 4);
    CHECK_THAT(ended.first_line(),
               Catch::Matchers::StartsWith("error: some of the output was lost: standard output cannot be written (") &&
                   Catch::Matchers::EndsWith("; what the run stored is whole"));
    CHECK(whole(here, out));
  }
  CHECK(here.shell("ricochet reference >/dev/full").status == 4);
  CHECK(here.shell("{ ricochet reference; echo $? >status.txt; } | head -1").out == "# Reference of the Lua module\n");
  CHECK(here.read("status.txt") == "0\n");
}

TEST_CASE("the option --quiet leaves standard output to what the script prints, and run.log holds the rest") {
  const Workplace here;
  const Ended ended = here.script(std::string(small_sweep) + "print 'mine'\n", "samples=1 --quiet");
  INFO(ended.err);
  CHECK(ended.err.empty());
  CHECK_THAT(ended.out, Catch::Matchers::StartsWith("psi1 ") && Catch::Matchers::EndsWith("\nmine\n"));
  CHECK_THAT(here.read("out/s/run.log"), Catch::Matchers::Contains("s: 3 of 3 impacts finished"));
}

TEST_CASE("what takes no byte, without an error, is an error too: nothing loops for ever") {
  if (!machine_can_be_broken) return;
  const Workplace here;
  here.write("s.lua", "print('hello')\n");
  const Ended text = here.shell(with_fault("write") + "timeout 20 '" RICOCHET_PROGRAM "' run s.lua | cat");
  CHECK_THAT(text.err, Catch::Matchers::Contains("Input/output error"));
  here.write("s.lua", small_sweep);
  const Ended rows = here.shell(with_fault("write") + "timeout 20 '" RICOCHET_PROGRAM "' run s.lua samples=1 --quiet");
  INFO(rows.err);
  CHECK(rows.status == 4);
  CHECK_THAT(rows.err, Catch::Matchers::Contains("cannot write") && Catch::Matchers::Contains("Input/output error"));
}
