// Which folder may include which, and which may know HDF5, OpenGL, Lua and CGAL.

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <regex>
#include <set>

#include "house/source.hpp"

using namespace ricochet::house;

namespace {

using Names = std::set<std::string>;

// A folder includes itself and these.
const std::map<std::string, Names> layers{
    {"core", {}},
    {"material", {"core"}},
    {"shape", {"core"}},
    {"body", {"core", "material", "shape"}},
    {"contact", {"core", "material", "shape", "body"}},
    {"integrate", {"core", "material", "shape", "body"}},
    {"effect", {"core", "material", "shape", "body", "contact"}},
    {"impact", {"core", "material", "shape", "body", "contact", "integrate", "effect"}},
    {"record", {"core", "material", "shape", "body", "contact", "integrate", "effect", "impact"}},
    {"store", {"core"}},
    {"theory", {"core"}},
    {"render", {"core", "material"}},
    {"sandbox", {"core"}},
    {"script",
     {"core", "material", "shape", "body", "contact", "integrate", "effect", "impact", "record", "store", "theory",
      "render", "sandbox"}},
};

struct Library {
  std::string name;
  std::regex header;
  Names folders;
};

const std::vector<Library> libraries{
    {"HDF5", std::regex("hdf5.*|H5.*"), {"store"}},
    {"OpenGL", std::regex("GL/.*"), {"render"}},
    {"FreeType", std::regex("ft2build.h|freetype.*"), {"render"}},
    {"libpng", std::regex("png.h"), {"render"}},
    {"Lua", std::regex("lua.*|lauxlib.*"), {"script", "sandbox"}},
    {"CGAL", std::regex("CGAL/.*"), {"shape"}},
};

// "src/body/springs/sweep.hpp" -> "body", "render/font.hpp" -> "render"
std::string folder_of(const std::string& name) {
  const std::string inner = name.starts_with("src/") ? name.substr(4) : name;
  return inner.substr(0, inner.find('/'));
}

Findings wrong_includes(const File& file) {
  const std::string folder = folder_of(file.name);
  if (!layers.count(folder)) return {file.name + ": '" + folder + "' stands in no layer"};
  const Names& allowed = layers.at(folder);
  static const std::regex include(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*(["<])([^">]+)[">])re");
  Findings found;
  for (auto match = std::sregex_iterator(file.text.begin(), file.text.end(), include); match != std::sregex_iterator();
       ++match) {
    const std::string header = (*match)[2];
    const auto line = 1 + std::count(file.text.begin(), file.text.begin() + match->position(2), '\n');
    const auto wrong = [&](const std::string& what) { found.push_back(at(file, static_cast<int>(line), what)); };
    if ((*match)[1] == "\"") {
      const std::string other = header.substr(0, header.find('/'));
      if (!layers.count(other))
        wrong("\"" + header + "\" is not written \"folder/file\"");
      else if (other != folder && !allowed.count(other))
        wrong("'" + folder + "' may not include '" + other + "'");
    }
    for (const Library& library : libraries)
      if (std::regex_match(header, library.header) && !library.folders.count(folder))
        wrong("'" + folder + "' may not include " + library.name);
  }
  return found;
}

bool lies_in(const File& file, const std::vector<std::string>& places) {
  return std::any_of(places.begin(), places.end(), [&](const auto& place) { return file.name.starts_with(place); });
}

bool goes_on(const std::vector<Word>& list, std::size_t at, const std::vector<std::string_view>& words) {
  for (std::size_t k = 0; k < words.size(); ++k)
    if (at + k >= list.size() || list[at + k].text != words[k]) return false;
  return true;
}

// Where a vector is read by its y: an impact asks along its axes instead.
Findings heights(const File& file) {
  Findings found;
  const std::vector<Word> list = words(file.text);
  for (std::size_t i = 0; i < list.size(); ++i)
    if (goes_on(list, i, {".", "y", "(", ")"})) found.push_back(at(file, list[i].line, ".y(): ask along the axes"));
  return found;
}

// Where a body is meant by a number.
Findings numbered_bodies(const File& file) {
  Findings found;
  const std::vector<Word> list = words(file.text);
  for (std::size_t i = 0; i < list.size(); ++i) {
    static const std::set<std::string_view> lists{"body", "bodies", "solids", "motions", "surfaces"};
    bool meant = goes_on(list, i, {":", "{", "0", ",", "1", "}", ")"}) &&
                 (list[i - 1].text == "b" || list[i - 1].text == "body");
    for (const std::string_view number : {"0", "1"}) {
      meant |= lists.count(list[i].text) && goes_on(list, i + 1, {"[", number, "]"});
      meant |= goes_on(list, i, {"body", "==", number}) || goes_on(list, i, {"body", "!=", number});
    }
    if (meant) found.push_back(at(file, list[i].line, "a body meant by its number"));
  }
  return found;
}

}  // namespace

TEST_CASE("an impact reads facts along its axes, and names its bodies only where it knows projectile and target") {
  Findings found;
  for (const File& file : cpp_files({"src/impact"})) {
    if (lies_in(file, {"src/impact/launch/", "src/impact/axes.hpp"})) continue;
    for (const std::string& one : heights(file)) found.push_back(one);
  }
  for (const File& file : cpp_files({"src/body", "src/effect", "src/impact"})) {
    if (lies_in(file, {"src/impact/launch/", "src/impact/watch/endings", "src/impact/outcome", "src/impact/roles.hpp",
                       "src/impact/scene.cpp"}))
      continue;
    for (const std::string& one : numbered_bodies(file)) found.push_back(one);
  }
  CHECK(listed(found) == "");
}

TEST_CASE("heights and numbered bodies are found") {
  CHECK(heights({"a.cpp", "f(v.y()); // v.y()\ng(v.x());"}).size() == 1);
  CHECK(numbered_bodies({"a.cpp", "a = bodies[0]; if (body == 1) f(); for (int b : {0, 1}) g(b);"}).size() == 3);
  CHECK(numbered_bodies({"a.cpp", "a = bodies[i]; if (body == c) f(); for (int side : {0, 1}) g(side); h[0];"}) ==
        Findings{});
}

TEST_CASE("each folder includes only what lies below it") {
  Findings found;
  for (const File& file : cpp_files({"src", "render"}))
    for (const std::string& one : wrong_includes(file)) found.push_back(one);
  CHECK(listed(found) == "");
}

TEST_CASE("the layers have a lowest and a highest, and no two that include each other") {
  for (const auto& [folder, allowed] : layers)
    for (const std::string& below : allowed) {
      CAPTURE(folder, below);
      CHECK(layers.count(below) == 1);
      CHECK(layers.at(below).count(folder) == 0);
      // What lies below that lies below this, too.
      for (const std::string& lowest : layers.at(below)) CHECK(allowed.count(lowest) == 1);
    }
}

TEST_CASE("an include that breaks the layers is found") {
  const auto of = [](const std::string& name, const std::string& text) { return wrong_includes({name, text}); };
  CHECK(of("src/core/a.hpp", "#pragma once\n#include \"store/table.hpp\"\n") ==
        Findings{"src/core/a.hpp:2: 'core' may not include 'store'"});
  CHECK(of("src/body/springs/a.hpp", "#include \"contact/pair.hpp\"\n").size() == 1);
  CHECK(of("src/theory/a.cpp", "  #  include \"impact/scene.hpp\"\n").size() == 1);
  CHECK(of("render/a.cpp", "#include \"body/solid.hpp\"\n").size() == 1);
  CHECK(of("src/store/a.cpp", "#include \"table.hpp\"\n").size() == 1);
  CHECK(of("src/impact/a.cpp", "#include <hdf5.h>\n#include <vector>\n").size() == 1);
  CHECK(of("src/store/a.cpp", "#include <GL/gl.h>\n").size() == 1);
  CHECK(of("src/record/a.cpp", "#include <lua.hpp>\n").size() == 1);
  CHECK(of("src/body/a.cpp", "#include <CGAL/Surface_mesh.h>\n").size() == 1);
  CHECK(of("src/novel/a.cpp", "").size() == 1);
  CHECK(of("src/script/a.cpp", "#include <lua.hpp>\n#include \"render/film.hpp\"\n#include \"script/b.hpp\"\n") ==
        Findings{});
  CHECK(of("src/body/springs/a.hpp", "#include \"body/springs/b.hpp\"\n#include \"core/lane.hpp\"\n") == Findings{});
}
