// The program where it is installed, copied or not to be written into.

#include <catch2/catch.hpp>
#include <sstream>

#include "script/program.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

const std::string source = RICOCHET_SOURCE;

/// "run", "merge" ... as the program lists them.
std::vector<std::string> commands(const Workplace& here) {
  std::istringstream lines(here.shell("ricochet --help | sed -n '/^Subcommands/,$s/^  \\([a-z]*\\) .*/\\1/p'").out);
  std::vector<std::string> names;
  for (std::string name; std::getline(lines, name);) names.push_back(name);
  return names;
}

}  // namespace

TEST_CASE("a copied checkout runs its own library, an installed program that of its prefix, and one without says so") {
  const Workplace here;
  here.write("s.lua", "print(require(\"ricochet.mark\"))");
  const auto copy = [&](const std::string& program, const std::string& library) {
    here.shell("mkdir -p $(dirname " + program + ") " + library + "; cp '" RICOCHET_PROGRAM "' " + program +
               "; cp -r '" + source + "/lua/.' " + library);
    here.write(library + "/ricochet/mark.lua", "return \"" + library + "\"");
    return here.shell("./" + program + " run s.lua --unsafe").out;
  };
  CHECK(copy("checkout/.build/release/ricochet", "checkout/lua") == "checkout/lua\n");
  CHECK(copy("usr/bin/ricochet", "usr/share/ricochet/lua") == "usr/share/ricochet/lua\n");
  const Ended bare = here.shell("mkdir bare; cp '" RICOCHET_PROGRAM "' bare; bare/ricochet run s.lua");
  CHECK(bare.status == 4);
  CHECK_THAT(bare.err,
             Contains("the Lua library is missing") && Contains("bare/ricochet") && Contains("lua/ricochet/init.lua"));
}

TEST_CASE("what is installed has all that runs need, and the man page and the completion know every command") {
  const Workplace here;
  const Ended installed = here.shell("cmake --install '" + fs::path(RICOCHET_PROGRAM).parent_path().string() +
                                     "' --prefix \"$PWD/usr\" >install.txt");
  INFO(installed.err);
  REQUIRE(installed.status == 0);
  for (const char* file :
       {"bin/ricochet", "share/ricochet/lua/ricochet/init.lua", "share/ricochet/scripts/soft_wall.lua",
        "share/ricochet/examples/01_drop.lua", "share/doc/ricochet/copyright", "share/doc/ricochet/README.md",
        "share/man/man1/ricochet.1", "share/bash-completion/completions/ricochet"})
    CHECK(fs::exists(here.path / "usr" / file));
  CHECK_THAT(here.shell("usr/bin/ricochet run usr/share/ricochet/scripts/soft_wall.lua --help").out,
             Contains("samples="));
  const std::string page = here.read("usr/share/man/man1/ricochet.1");
  const std::vector<std::string> names = commands(here);
  CHECK(names.size() >= 13);
  for (const std::string& name : names) CHECK_THAT(page, Contains("\n.B " + name + "\n"));
  const auto completed = [&](const std::string& words, int at) {
    return here
        .shell("bash -c 'PATH=$PWD/usr/bin:$PATH; . usr/share/bash-completion/completions/ricochet; COMP_WORDS=(" +
               words + "); COMP_CWORD=" + std::to_string(at) + "; _ricochet; echo ${COMPREPLY[@]}'")
        .out;
  };
  CHECK(completed("ricochet me", 1) == "merge\n");
  CHECK(completed("ricochet run --sh", 2) == "--shard\n");
  here.write("sweep.lua", "");
  CHECK(completed("ricochet run sw", 2) == "sweep.lua\n");
}

TEST_CASE("workbench runs what is built in a checkout that it cannot write into, and says so where nothing is") {
  if (getuid() != 0) return;  // another user's folder is needed
  const Workplace here;
  here.shell("mkdir -p theirs/.build/release; cp '" + source + "/workbench' theirs; cp -r '" + source +
             "/lua' theirs; cp '" RICOCHET_PROGRAM "' theirs/.build/release; chmod -R a+rX .; chmod 755 .");
  const auto as_nobody = [&](const std::string& command) {
    return here.shell("setpriv --reuid=65534 --regid=65534 --clear-groups " + command);
  };
  CHECK_THAT(as_nobody("theirs/workbench --version").out, Contains("ricochet "));
  here.shell("rm theirs/.build/release/ricochet");
  const Ended nothing = as_nobody("theirs/workbench --version");
  CHECK(nothing.status == 4);
  CHECK_THAT(nothing.err, Contains("cannot be written into, and nothing is built there"));
}
