// The repl: values keep, entries go on, objects are shown.

#include <catch2/catch.hpp>

#include "script/program.hpp"
#include "script/source.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

Ended typed(const Workplace& here, const std::string& text) {
  here.write("typed.txt", text);
  return here.shell("ricochet repl <typed.txt");
}

}  // namespace

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
  const Ended ended = typed(here, "help\nhelp 'disk'\nhelp 'ricochet.theory.hertz'\nhelp 'dsik'\n");
  CHECK_THAT(ended.out, Catch::Matchers::Contains("theory.hertz") && Catch::Matchers::Contains("disk: ") &&
                            Catch::Matchers::Contains("  nodes          ") && Catch::Matchers::Contains("gives "));
  CHECK_THAT(ended.err, Catch::Matchers::Contains("there is no 'dsik' in the reference (did you mean 'disk'?)"));
}
