// Frames, films, stills, contact sheets and `ricochet render`, as a user makes them.

#include <catch2/catch.hpp>
#include <set>

#include "render/png.hpp"
#include "script/program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

// A small impact; `call` draws it.
std::string drawing(const std::string& call) {
  return "local ricochet = require 'ricochet'\n"
         "local function scene(stiffness) return ricochet.scene { projectile = ricochet.disk { nodes = 60, roughness = "
         "0.03 },\n"
         "  target = ricochet.wall { nodes = 150, width = 4, stiffness = stiffness or 400, roughness = 0.03 }, launch "
         "= { psi1 = 1 } } end\n" +
         call + "\n";
}

std::string all_bytes(const Workplace& here, const fs::path& folder) {
  std::set<fs::path> names;
  for (const auto& entry : fs::directory_iterator(here.path / folder)) names.insert(entry.path().filename());
  std::string bytes;
  for (const fs::path& name : names) bytes += name.string() + here.read(folder / name);
  return bytes;
}

std::pair<int, int> size_of(const std::string& png) {
  const auto number = [&](std::size_t at) {
    return png.size() < at + 4
               ? 0
               : static_cast<unsigned char>(png[at + 2]) * 256 + static_cast<unsigned char>(png[at + 3]);
  };
  return {number(16), number(20)};
}

const char* everything =
    "show = { title = 'all of it', material = 'pressure', ledger = true, plot = 'force_n', forces = true, velocity = "
    "true, spin = true, trail = true, ghost = true, magnify = 3 }";

}  // namespace

TEST_CASE("frames have equal bytes over two runs and over threads, with every layer switched on") {
  const Workplace here;
  const std::string text =
      drawing(std::string("ricochet.animate { scene = scene(), frames = 6, size = { 480, 270 }, ") + everything + " }");
  REQUIRE(here.script(text, "--threads 1 --out a").status == 0);
  REQUIRE(here.script(text, "--threads 2 --out b").status == 0);
  REQUIRE(here.script(text, "--threads 2 --out c").status == 0);
  const std::string first = all_bytes(here, "a/s/frames");
  CHECK(first.size() > 20000);
  CHECK(first == all_bytes(here, "b/s/frames"));
  CHECK(first == all_bytes(here, "c/s/frames"));
}

TEST_CASE("ricochet render draws a recorded impact to the same bytes as animate drew it while it ran") {
  const Workplace here;
  REQUIRE(here.script(drawing("ricochet.animate { scene = scene(), frames = 5, from = 0, size = { 320, 180 }, show = { "
                              "material = 'von_mises', ledger = true, trail = true, fronts = true } }\n"
                              "ricochet.record { scene = scene(), frames = 5 }"))
              .status == 0);
  const Ended ended = here.shell(
      "ricochet render out/s/trajectory.h5 --size 320x180 material=von_mises ledger=true trail=true fronts=true");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  CHECK(all_bytes(here, "out/s/frames") == all_bytes(here, "out/s/trajectory_frames"));
  CHECK(here.shell("ricochet render out/s/trajectory.h5").status == 4);  // never over earlier frames
  CHECK(here.shell("ricochet render out/s/trajectory.h5 --out elsewhere --size 320x180 material=speed").status == 0);
  CHECK(all_bytes(here, "elsewhere") != all_bytes(here, "out/s/frames"));
}

TEST_CASE("a recording with effects that change springs is drawn as it ran: broken springs are gone from both") {
  const Workplace here;
  REQUIRE(here.script("local ricochet = require 'ricochet'\n"
                      "local scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = "
                      "ricochet.wall { nodes = 150, width = 4, stiffness = 1e5 }, launch = { speed = 0.3 },\n"
                      "  contact = { sides = 'two' }, effects = { ricochet.breaking { strain = 0.02 } } }\n"
                      "local row = ricochet.animate { scene = scene, frames = 4, from = 0, duration = 4, size = { 320, "
                      "180 } }\n"
                      "ricochet.record { scene = scene, frames = 4, duration = 4 }\nprint(row.breaking_springs > 0)\n")
              .out.find("true") != std::string::npos);
  REQUIRE(here.shell("ricochet render out/s/trajectory.h5 --size 320x180").status == 0);
  CHECK(all_bytes(here, "out/s/frames") == all_bytes(here, "out/s/trajectory_frames"));
}

TEST_CASE("a recording of elements is drawn as it ran, with their stress") {
  const Workplace here;
  const Ended ended = here.script(
      "local ricochet = require 'ricochet'\n"
      "local scene = ricochet.scene { projectile = ricochet.disk { interior = 'elements', E = 1e4, nu = 0.2, h_min = "
      "0.1 }, target = ricochet.wall { nodes = 150, width = 4, stiffness = 400 }, launch = { speed = 0.1 } }\n"
      "ricochet.animate { scene = scene, frames = 3, from = 0, duration = 4, size = { 320, 180 }, show = { material = "
      "'von_mises' } }\n"
      "ricochet.record { scene = scene, frames = 3, duration = 4 }\n");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  REQUIRE(here.shell("ricochet render out/s/trajectory.h5 material=von_mises --size 320x180").status == 0);
  CHECK(all_bytes(here, "out/s/frames") == all_bytes(here, "out/s/trajectory_frames"));
}

TEST_CASE("an interrupted sequence goes on with --resume: whole frames are kept, torn and strange ones drawn again") {
  const Workplace here;
  const std::string text = drawing("ricochet.animate { scene = scene(), frames = 8, size = { 320, 180 } }");
  REQUIRE(here.script(text).status == 0);
  const std::string whole = all_bytes(here, "out/s/frames");
  const fs::path kept = here.path / "out/s/frames/000000.png";
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(kept, long_ago);
  fs::remove(here.path / "out/s/frames/000006.png");
  here.write("out/s/frames/000003.png", here.read("out/s/frames/000003.png").substr(0, 2000));
  here.write("out/s/frames/000004.png", here.read("out/s/frames/000005.png"));
  REQUIRE(here.script(text, "--resume").status == 0);
  CHECK(all_bytes(here, "out/s/frames") == whole);
  CHECK(fs::last_write_time(kept) == long_ago);
}

TEST_CASE("a signal stops a sequence, whole frames stay, and the message says how to go on") {
  const Workplace here;
  here.write("s.lua", drawing("ricochet.animate { scene = scene(), frames = 400, size = { 1920, 1080 } }"));
  const Ended ended =
      here.shell(std::string("'") + RICOCHET_PROGRAM +
                 "' run s.lua & while [ ! -e out/s/frames/000003.png ]; do sleep 0.01; done; kill -TERM $!; wait $!");
  CHECK(ended.status == 130);
  CHECK_THAT(ended.first_line(), Contains("pictures are drawn; --resume goes on from there"));
  for (const auto& entry : fs::directory_iterator(here.path / "out/s/frames"))
    CHECK_FALSE(ricochet::render::png_texts(here.read(entry.path())).empty());
}

TEST_CASE("a sweep without frames never touches the renderer: OSMesa and LLVM are not even loaded") {
  const Workplace here;
  const std::string look =
      "local function loaded() local f = io.open '/proc/self/maps' local text = f:read 'a' f:close() return text:find "
      "'OSMesa' ~= nil, text:find 'LLVM' ~= nil end\n";
  const Ended ended = here.script(
      drawing(look + "ricochet.sweep { name = 's', over = { k = { 400, 500 } }, scene = function(at) return "
                     "scene(at.k) end }:run()\n"
                     "print(loaded())\nricochet.still { scene = scene(), size = { 64, 36 } }\nprint(loaded())"),
      "--unsafe");
  INFO(ended.err);
  CHECK_THAT(ended.out, Contains("false\tfalse\n"));
  CHECK_THAT(ended.out, Contains("true\ttrue\n"));
}

TEST_CASE("stills and contact sheets are single pictures of the asked size, of one scene or several") {
  const Workplace here;
  const Ended ended =
      here.script(drawing("local row = ricochet.still { scene = scene(), size = { 640, 360 } }\n"
                          "local rows = ricochet.contact_sheet { scenes = { scene(100), scene(5000) }, titles = { "
                          "'soft', 'hard' }, moments = 3, size = { 800, 500 } }\n"
                          "ricochet.contact_sheet { scene = scene(), times = { 0.5, 1, 2 }, out = 'three', size = { "
                          "320, 200 }, show = { camera = 'contact' } }\n"
                          "print(row.status, #rows, rows[1].indentation > rows[2].indentation)"));
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  CHECK_THAT(ended.out, Contains("finished\t2\ttrue"));
  CHECK(size_of(here.read("out/s/still.png")) == std::pair(640, 360));
  CHECK(size_of(here.read("out/s/contact_sheet.png")) == std::pair(800, 500));
  CHECK(size_of(here.read("out/s/three.png")) == std::pair(320, 200));
}

TEST_CASE("slow motion puts more frames into the contact") {
  const Workplace here;
  const auto times = [&](const char* factor) {
    const Ended ended = here.script(
        drawing(std::string("ricochet.animate { scene = scene(), frames = 30, size = { 64, 36 }, slow_motion = ") +
                factor + " }"),
        "--force");
    REQUIRE(ended.status == 0);
    std::vector<double> list;
    for (int k = 0; k < 30; ++k)
      list.push_back(
          std::stod(ricochet::render::png_texts(
                        here.read("out/s/frames/0000" + std::string(k < 10 ? "0" : "") + std::to_string(k) + ".png"))
                        .at("ricochet.time")));
    return list;
  };
  const auto even = times("1"), slow = times("5");
  CHECK(std::abs((even[29] - even[28]) - (even[1] - even[0])) < 0.05);
  CHECK(slow[1] - slow[0] > 3 * (slow[16] - slow[15]));
  CHECK(std::abs(slow[29] - even[29]) < 0.05);
}

TEST_CASE(
    "without ffmpeg a film is refused by the name of its package, and frames that were asked for are drawn all the "
    "same") {
  const Workplace here;
  here.write("s.lua",
             drawing("ricochet.animate { scene = scene(), frames = 3, size = { 64, 36 }, film = 'impact.mp4' }"));
  const Ended film = here.shell(std::string("PATH=/nonexistent '") + RICOCHET_PROGRAM + "' run s.lua");
  CHECK(film.status == 4);
  CHECK(film.first_line() == "error: a film needs ffmpeg, which is not installed; apt-get install ffmpeg");
  CHECK_FALSE(fs::exists(here.path / "out/s/frames"));
  here.write(
      "s.lua",
      drawing(
          "ricochet.animate { scene = scene(), frames = 3, size = { 64, 36 }, film = 'impact.mp4', out = 'frames' }"));
  const Ended both = here.shell(std::string("PATH=/nonexistent '") + RICOCHET_PROGRAM + "' run s.lua --force");
  CHECK(both.status == 4);
  CHECK(fs::exists(here.path / "out/s/frames/000002.png"));
}

TEST_CASE("a film has the frames, the size and the rate that were asked for", "[.slow]") {
  const Workplace here;
  const Ended ended = here.script(drawing(
      "ricochet.animate { scene = scene(), frames = 12, size = { 321, 180 }, film = 'impact.mp4', rate = 24 }"));
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  const Ended probe = here.shell(
      "ffprobe -v error -count_frames -show_entries stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames "
      "-of csv=p=0 out/s/impact.mp4");
  CHECK(probe.out == "h264,322,180,yuv420p,24/1,12\n");
  CHECK_FALSE(fs::exists(here.path / "out/s/frames"));
}

TEST_CASE("a film may be a GIF or an animated PNG, for pages and slides") {
  const Workplace here;
  const Ended ended = here.script(drawing(
      "for _, film in ipairs { 'impact.gif', 'impact.apng' } do ricochet.animate { scene = scene(), frames = 5, "
      "size = { 160, 90 }, film = film, rate = 10 } end"));
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  CHECK(here.read("out/s/impact.gif").starts_with("GIF89a"));
  CHECK_THAT(here.read("out/s/impact.gif"), Catch::Matchers::Contains("NETSCAPE2.0"));  // it repeats
  const std::string png = here.read("out/s/impact.apng");
  const std::size_t control = png.find("acTL");
  REQUIRE(control != std::string::npos);
  CHECK(png.substr(control + 4, 8) == std::string("\0\0\0\5\0\0\0\0", 8));  // five frames, for ever
}

TEST_CASE("mistakes in pictures are found at their own line, before anything runs") {
  struct Case {
    const char *call, *first_line;
  };
  const Case cases[] = {
      {"ricochet.animate { scene = scene(), size = { 0, 100 } }",
       "error: s.lua:4: animate: 'size': a picture has 16 x 16 to 7680 x 4320 pixels, not 0 x 100"},
      {"ricochet.still { scene = scene(), size = { 100000, 100 } }",
       "error: s.lua:4: still: 'size': a picture has 16 x 16 to 7680 x 4320 pixels, not 100000 x 100"},
      {"ricochet.still { scene = scene(), size = { 0/0, 100 } }",
       "error: s.lua:4: still: 'size' must hold only numbers; element 1 is nan"},
      {"ricochet.animate { scene = scene(),\n  show = { materal = 'speed' } }",
       "error: s.lua:5: animate: show: unknown field 'materal' (did you mean 'material'?)"},
      {"ricochet.animate { scene = scene(),\n  show = { material = 'sped' } }",
       "error: s.lua:5: animate: show: 'material' must be one of none, plain, energy_density, speed, velocity_x, "
       "velocity_y, pressure, von_mises, plastic_strain, stretch, is 'sped' (did you mean 'speed'?)"},
      {"ricochet.animate { scene = scene(), ledger = true }",
       "error: s.lua:4: animate: unknown field 'ledger' (it belongs in show = { ledger = ... })"},
      {"ricochet.animate { scene = scene(),\n  show = { springs = 'tension' } }",
       "error: s.lua:5: animate: 'springs': 'tension' colours the springs and 'energy_density' the material, and there "
       "is one colour bar; make one of them plain or none"},
      {"ricochet.still { scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.plane "
       "{}, launch = { speed = 0.1 } },\n  show = { fronts = true } }",
       "error: s.lua:5: still: 'fronts': needs a target whose waves have one speed: it must not be rigid or "
       "prestressed, nor its stiffness or density differ from place to place; a recording by an older version does not "
       "hold it"},
      {"ricochet.animate { frames = 3 }",
       "error: s.lua:4: animate: 'scene': is missing: what is to be drawn (or scenes, for several)"},
      {"ricochet.animate { scenes = { scene(), 3 } }",
       "error: s.lua:4: animate: 'scenes' must be a list of scenes (from ricochet.scene); element 2 is 3"},
      {"ricochet.animate { scene = scene(), scenes = { scene() } }",
       "error: s.lua:4: animate: 'scenes': give scene, or scenes for several side by side"},
      {"ricochet.contact_sheet { scenes = { scene() }, titles = { 'a', 'b' } }",
       "error: s.lua:4: contact_sheet: 'titles': has 2 texts for 1 scenes"},
      {"ricochet.animate { scene = scene(), film = 'impact.avi' }",
       "error: s.lua:4: animate: 'film': 'impact.avi' must end in .mp4, .gif or .apng"},
      {"ricochet.animate { scene = scene(), frames = 1000000 }",
       "error: s.lua:4: animate: 'frames': 1000000 frames in *"},
      {"ricochet.still { scene = scene(), size = { 64, 36 } }\nricochet.still { scene = scene(), size = { 64, 36 } }",
       "error: s.lua:5: still: 'out': 'still.png' was made, or holds what was made, by an earlier call of this script; "
       "give this one another name"},
      {"ricochet.animate { scene = scene(), frames = 3, size = { 64, 36 } }\nricochet.still { scene = scene(), out = "
       "'frames/000001' }",
       "error: s.lua:5: still: 'out': 'frames/000001.png' was made, or holds what was made, by an earlier call of this "
       "script; give this one another name"},
      {"ricochet.record { scene = scene(), out = 'results' }",
       "error: s.lua:4: record: 'out': 'results.h5' is the name of a file that runs leave themselves; give another"},
      {"ricochet.animate { scene = scene(), out = 'run.log' }",
       "error: s.lua:4: animate: 'out': 'run.log' is the name of a file that runs leave themselves; give another"},
      {"ricochet.animate { scene = scene(), out = '' }",
       "error: s.lua:4: animate: 'out': is empty, and no film is asked for: there would be nothing left of it"},
      {"ricochet.still { scene = scene(), size = { 320.5, 180 } }",
       "error: s.lua:4: still: 'size': counts pixels, which 320.5 does not"},
      {"ricochet.contact_sheet { scene = scene(), times = { 1e300 } }",
       "error: s.lua:4: contact_sheet: 'times': must lie between -1e+06 R/c and 1e+06 R/c, one is "
       "1e+300 R/c"},
      {"ricochet.still { scene = scene(), show = { material = 'speed', high = -5 } }",
       "error: s.lua:4: still: 'high': must be above 0: 'speed' is never below"},
      {"ricochet.still { scene = scene(), show = { material = 'speed', low = 1e16, high = 1e16 + 2 } }",
       "error: s.lua:4: still: 'high': is too close to low = 1e+16"},
      {"ricochet.still { scene = scene(), show = { material = 'velocity_y', high = -0.01 } }",
       "error: s.lua:4: still: 'high': must be above 0 where low is not given: 'velocity_y' has both signs"},
      {"ricochet.still { scene = scene(), show = { material = 'speed', low = 5 } }",
       "error: s.lua:4: still: 'low': lies above all values, of which the greatest is *"},
      {"ricochet.still { scenes = { scene(), scene(), scene(), scene() }, size = { 160, 90 }, show = { ledger = true, "
       "plot = 'vn' } }",
       "error: s.lua:4: still: 'size': there is no room for 4 columns and a row of *"},
      {"ricochet.still { scene = scene(), out = '../x' }",
       "error: s.lua:4: '../x.png' is no name below the run's folder; give a relative name without '..'"},
  };
  const Workplace here;
  for (const Case& c : cases) {
    const Ended ended = here.script(drawing(c.call), "--force");
    INFO(c.call << "\n" << ended.err);
    CHECK(ended.status == 1);
    const std::string wanted = c.first_line;
    if (wanted.ends_with('*'))
      CHECK_THAT(ended.first_line(), StartsWith(wanted.substr(0, wanted.size() - 1)));
    else
      CHECK(ended.first_line() == wanted);
  }
}

TEST_CASE("mistakes on the command line of render have the exit status of their kind and a remedy") {
  const Workplace here;
  REQUIRE(here.script(drawing("ricochet.record { scene = scene(), frames = 3 }\nricochet.sweep { name = 'r', over = { "
                              "k = { 400 } }, scene = function(at) return scene(at.k) end }:run()"))
              .status == 0);
  const auto first_line = [&](const std::string& arguments, int status) {
    const Ended ended = here.shell("ricochet render " + arguments);
    INFO(arguments);
    CHECK(ended.status == status);
    return ended.first_line();
  };
  CHECK(first_line("out/s/trajectory.h5 materal=speed", 2) ==
        "error: pictures have no 'materal' (did you mean 'material'?); ricochet reference lists them under show");
  CHECK_THAT(first_line("out/s/trajectory.h5 material=sped", 2), Contains("(did you mean 'speed'?)"));
  CHECK(first_line("out/s/trajectory.h5 magnify=much", 2) == "error: 'magnify' must be a number, is 'much'");
  CHECK(first_line("out/s/trajectory.h5 --size 640", 2) == "error: --size takes WIDTHxHEIGHT, is '640'");
  CHECK(first_line("out/s/trajectory.h5 --size 0x90", 2) ==
        "error: size: a picture has 16 x 16 to 7680 x 4320 pixels, not 0 x 90");
  CHECK(first_line("absent.h5", 4) == "error: absent.h5 does not exist");
  CHECK(first_line("out/r/results.h5", 4) ==
        "error: out/r/results.h5 holds no trajectory (ricochet.record writes one)");
}

TEST_CASE("a full disk stops a sequence with one error, and the frames before it are whole") {
  const Workplace here;
  here.write("s.lua", drawing("ricochet.animate { scene = scene(), frames = 60, size = { 1280, 720 } }"));
  const Ended ended = here.shell(
      "mkdir small && mount -t tmpfs -o size=2m none small && { ricochet run s.lua --out small; s=$?; cp -r small "
      "kept; umount small; exit $s; }");
  if (ended.err.find("mount") != std::string::npos) {
    WARN("no right to mount a small disk here: " << ended.err);
    return;
  }
  CHECK(ended.status == 4);
  CHECK_THAT(ended.first_line(),
             StartsWith("error: cannot write small/s/frames/") && Contains("No space left on device; free some space"));
  int whole = 0;
  for (const auto& entry : fs::directory_iterator(here.path / "kept/s/frames")) {
    if (entry.path().extension() == ".png") CHECK_FALSE(ricochet::render::png_texts(here.read(entry.path())).empty());
    whole += entry.path().extension() == ".png";
  }
  CHECK(whole > 3);
}
