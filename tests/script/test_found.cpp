// Cases from public reports about other programs: tests/found/, each a script that ends with 0 if this one does it
// right. Its head names the reports, what happened here at an earlier commit, and what happens now.

#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "script/program.hpp"

using namespace ricochet;
using namespace ricochet::test;

TEST_CASE("what public reports found in other programs is right here") {
  std::vector<fs::path> scripts;
  for (const auto& entry : fs::directory_iterator(fs::path(RICOCHET_SOURCE) / "tests/found"))
    if (entry.path().extension() == ".sh") scripts.push_back(entry.path());
  std::sort(scripts.begin(), scripts.end());
  REQUIRE(scripts.size() >= 20);
  for (const fs::path& script : scripts) {
    const Workplace here;
    here.write("sweep.lua", std::string(small_sweep).replace(std::string(small_sweep).find("\"s\""), 3, "\"sweep\""));
    here.shell("mkdir bin; ln -s '" RICOCHET_PROGRAM "' bin/ricochet");
    const Ended ended = here.shell("PATH=\"$PWD/bin:$PATH\" sh '" + script.string() + "'");
    INFO(script << "\n" << ended.out << ended.err);
    CHECK(ended.status == 0);
  }
}

TEST_CASE("a case from public reports is short and names its reports and both verdicts") {
  for (const auto& entry : fs::directory_iterator(fs::path(RICOCHET_SOURCE) / "tests/found")) {
    if (entry.path().extension() != ".sh") continue;
    INFO(entry.path());
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(std::count(text.begin(), text.end(), '\n') <= 30);
    CHECK_THAT(text, Catch::Matchers::Matches("#!/bin/sh\n# [A-Za-z0-9._-]+/[A-Za-z0-9._-]+#[0-9]+[^]*") &&
                         Catch::Matchers::Contains("# Here at "));
  }
}
