// ricochet doctor: what works here, what does not. Each line is made to fail once.

#include <catch2/catch.hpp>

#include "script/doctor.hpp"
#include "script/program.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

bool fails(const Ended& ended, const std::string& what, const std::string& why) {
  const std::size_t line = ended.out.find("FAILS    " + what);
  return line != std::string::npos &&
         ended.out.substr(line, ended.out.find('\n', line) - line).find(why) != std::string::npos;
}

}  // namespace

TEST_CASE("the doctor finds that everything works here, and leaves nothing behind") {
  const Workplace here;
  const Ended ended = here.shell("ricochet doctor");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
  CHECK(ended.out.find("FAILS") == std::string::npos);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("lanes") && Catch::Matchers::Contains("processor: "));
  CHECK_FALSE(fs::exists(here.path / "out"));
}

TEST_CASE("what is missing is told by the doctor with what to install, and is no failure of the main job") {
  const Workplace here;
  here.shell("mkdir bin lib; ln -s $(command -v env) bin; echo no library >lib/libOSMesa.so.8");
  const Ended bare = here.shell("PATH=bin; ricochet doctor");
  INFO(bare.out);
  CHECK(bare.status == 0);
  CHECK(fails(bare, "plots (gnuplot)", "apt-get install gnuplot-nox"));
  CHECK(fails(bare, "films (ffmpeg)", "apt-get install ffmpeg"));
  const Ended font = here.shell("export RICOCHET_FONT=/nowhere.ttf; ricochet doctor");
  CHECK(font.status == 0);
  CHECK(fails(font, "pictures (OSMesa, font)", "RICOCHET_FONT"));
  const Ended mesa = here.shell("export LD_LIBRARY_PATH=$PWD/lib; ricochet doctor");
  CHECK(fails(mesa, "pictures (OSMesa, font)", "apt-get install libosmesa6"));
}

TEST_CASE("locks, the Lua library, an impact, a sweep: the doctor tells which of them does not work") {
  if (!machine_can_be_broken) return;
  struct Broken {
    std::string fault, line, why;
    int status;
  };
  const Broken broken[] = {
      {with_fault("flock"), "locks on folders", "do not let two runs write there at a time", 0},
      {with_fault("open", "ricochet/rows.lua"), "Lua and its library", "rows.lua", 1},
      {with_fault("sin"), "an impact", "", 1},
      {with_fault("open", "/rows/"), "a sweep, its rows stored", "rows", 1},
  };
  for (const Broken& machine : broken) {
    const Workplace here;
    const Ended ended = here.shell(machine.fault + "ricochet doctor");
    INFO(machine.fault << "\n" << ended.out << ended.err);
    CHECK(ended.status == machine.status);
    for (const Broken& other : broken)
      if (&other == &machine)
        CHECK(fails(ended, other.line, other.why));
      else if (other.line == "locks on folders")
        CHECK_FALSE(fails(ended, other.line, ""));
  }
}

TEST_CASE("without a folder to write into, or with other bits, the main job fails") {
  const Workplace here;
  here.write("out", "a file");
  const Ended file = here.shell("ricochet doctor");
  CHECK(file.status == 1);
  CHECK(fails(file, "writing into out", "cannot make folder"));
  const std::vector<Finding> findings = examined((here.path / "other").string(), "0x1p+0");
  bool told = false;
  for (const Finding& finding : findings)
    if (finding.what == "its bits") told = finding.needed && finding.trouble.find("please report") != std::string::npos;
  CHECK(told);
}
