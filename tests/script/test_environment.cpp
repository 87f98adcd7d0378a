// What the user's environment may hold without harm: variables of Mesa, languages, limits, a terminal that hangs up.

#include <catch2/catch.hpp>

#include "script/program.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

constexpr const char* still = R"(local ricochet = require "ricochet"
ricochet.still { scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 },
  target = ricochet.wall { nodes = 150, width = 4 } }, out = "still", size = { 64, 48 } }
)";

constexpr const char* plot = R"(local ricochet = require "ricochet"
ricochet.plot { x = "a", y = { "b" }, name = "plot", title = "1 °", theory = { b = { { 1, 1 }, { 2, 2 } } } }
)";

}  // namespace

TEST_CASE("no variable of Mesa's changes a pixel or stops the drawing") {
  const Workplace here;
  REQUIRE(here.script(still).status == 0);
  const std::string expected = here.read("out/s/still.png");
  for (const char* variable : {"GALLIUM_DRIVER=zink", "GALLIUM_DRIVER=swr", "GALLIUM_DRIVER=d3d12",
                               "GALLIUM_DRIVER=nonsense", "GALLIUM_DRIVER=softpipe", "MESA_GL_VERSION_OVERRIDE=2.1",
                               "MESA_GLSL_VERSION_OVERRIDE=110", "MESA_EXTENSION_OVERRIDE=-GL_ARB_framebuffer_object",
                               "GALLIUM_TRACE=trace.xml", "LP_NUM_THREADS=0", "LIBGL_ALWAYS_SOFTWARE=0"}) {
    INFO(variable);
    const Ended ended = here.shell(std::string("export ") + variable + "; ricochet run s.lua --force");
    CHECK(ended.status == 0);
    CHECK(here.read("out/s/still.png") == expected);
  }
}

TEST_CASE("plots have no warnings in any language") {
  const Workplace here;
  here.write("s.lua", plot);
  for (const char* language : {"LC_ALL=C", "LC_ALL=de_DE@euro", "LANG=none", "LC_CTYPE=C"}) {
    INFO(language);
    const Ended ended = here.shell(std::string("export ") + language + "; ricochet run s.lua --force");
    CHECK(ended.status == 0);
    CHECK(ended.err.empty());
  }
}

TEST_CASE("a limit on open files is told as one, not as a missing program") {
  const Workplace here;
  here.write("s.lua", plot);
  const int least = machine_can_be_broken ? 4 : 6;  // sanitizers open a pipe to look at an address
  for (int files = least; files < 12; ++files) {
    const Ended ended =
        here.shell("ulimit -n " + std::to_string(files) + "; exec '" RICOCHET_PROGRAM "' run s.lua --force");
    INFO(files << ": " << ended.status << ended.err);
    CHECK(ended.err.find("is not installed") == std::string::npos);
    CHECK((ended.status == 0 || ended.status == 4 || ended.status == 127));  // 127: the program's own libraries
  }
}

TEST_CASE("SIGHUP and SIGTERM end a run as ^C does, unless nohup has it ignored") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  for (const char* signal : {"HUP", "TERM"}) {
    INFO(signal);
    const std::string out = std::string("--out ") + signal;
    const Ended ended =
        here.shell("'" RICOCHET_PROGRAM "' run s.lua samples=300 --quiet " + out + " & p=$!; while [ ! -d " + signal +
                   "/s/parts ]; do sleep 0.01; done; kill -" + signal + " $p; wait $p");
    CHECK(ended.status == 130);
    CHECK_THAT(ended.err, Catch::Matchers::Contains("--resume goes on from there"));
    CHECK(read_table(here.path / signal / "s/results.h5").rows() > 0);
  }
  const Ended ended = here.shell("nohup '" RICOCHET_PROGRAM
                                 "' run s.lua samples=40 --quiet & p=$!; while [ ! -d out/s/parts ]; "
                                 "do sleep 0.01; done; kill -HUP $p; wait $p");
  CHECK(ended.status == 0);
}

TEST_CASE("RICOCHET_FONT is the font of pictures, and one that cannot be read is told by that name") {
  const Workplace here;
  REQUIRE(here.script(still).status == 0);
  const std::string expected = here.read("out/s/still.png");
  const Ended missing = here.shell("export RICOCHET_FONT=/nowhere.ttf; ricochet run s.lua --force");
  CHECK(missing.status == 4);
  CHECK_THAT(missing.first_line(), Catch::Matchers::Contains("RICOCHET_FONT"));
  const fs::path mono = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf";
  REQUIRE(fs::exists(mono));
  REQUIRE(here.shell("export RICOCHET_FONT=" + mono.string() + "; ricochet run s.lua --force").status == 0);
  CHECK(here.read("out/s/still.png") != expected);
}

TEST_CASE("characters that no font has, and scripts that are not UTF-8, are warned of") {
  const Workplace here;
  std::string text = still;
  text.replace(text.find("size ="), 0, "show = { title = '\xf3\xb0\x80\x80' }, ");  // of private use
  const Ended private_use = here.script(text);
  CHECK(private_use.status == 0);
  CHECK_THAT(private_use.err, Catch::Matchers::Contains("warning: the font of pictures lacks U+F0000 and draws boxes"));
  const Ended latin = here.script("local ricochet = require 'ricochet'\nprint('\xe4')\n", "--force");
  CHECK(latin.status == 0);
  CHECK_THAT(latin.err, Catch::Matchers::StartsWith("warning: s.lua:2 is not UTF-8; save the script as UTF-8"));
}

TEST_CASE("a label may begin with an apostrophe, and hold quotes of every kind") {
  const Workplace here;
  std::string text = plot;
  text.replace(text.find("1 °"), 4, "'Tis \\\"a\\\" ''`title`");
  const Ended ended = here.script(text);
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK(ended.err.empty());
}
