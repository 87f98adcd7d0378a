#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "store/csv.hpp"
#include "store/files.hpp"
#include "store/h5md.hpp"
#include "store/hdf5.hpp"
#include "store/run_names.hpp"
#include "store/sinks.hpp"
#include "store/table.hpp"

using namespace ricochet;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("ricochet_store_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

Table example() {
  Table table;
  table.numbers.push_back({{"e", "number", "", "restitution"}, {0.5, 1.25, std::nan("")}});
  table.numbers.push_back({{"speed", "number", "c", "speed"}, {0.1, 1.0 / 3, 1e-300}});
  table.texts.push_back({{"status", "string", "", "ending"}, {"finished", "a, \"quoted\" one", ""}});
  return table;
}

}  // namespace

TEST_CASE("a table comes back from its file as it was, with units and meanings") {
  const Folder folder;
  write_table(folder.path / "t.h5", example(), {{"script", std::string(100000, 'x')}, {"host", "here"}});
  const Table back = read_table(folder.path / "t.h5"), table = example();
  REQUIRE(back.rows() == 3);
  for (const auto& column : table.numbers)
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = back.number(column.field.name)->values[i];
      CHECK((value == column.values[i] || (std::isnan(value) && std::isnan(column.values[i]))));
    }
  CHECK(back.text("status")->values == table.texts[0].values);
  CHECK(back.number("speed")->field.unit == "c");
  CHECK(back.number("e")->field.doc == "restitution");
  CHECK(read_provenance(folder.path / "t.h5").at("script").size() == 100000);
}

TEST_CASE("equal tables give equal bytes") {
  const Folder folder;
  write_table(folder.path / "a.h5", example(), {{"host", "here"}});
  write_table(folder.path / "b.h5", example(), {{"host", "here"}});
  CHECK(read_file(folder.path / "a.h5") == read_file(folder.path / "b.h5"));
}

TEST_CASE("CSV has units in its header, empty cells for undefined numbers, and numbers that read back exactly") {
  CHECK(csv(example()) ==
        "e,speed [c],status\n0.5,0.1,finished\n1.25,0.3333333333333333,\"a, \"\"quoted\"\" one\"\n,1e-300,\n");
}

TEST_CASE("a damaged file is refused by name, never repaired in silence") {
  const Folder folder;
  write_table(folder.path / "t.h5", example(), {});
  const std::string whole = read_file(folder.path / "t.h5");
  const auto refused = [&](const std::string& bytes) {
    write_atomically(folder.path / "cut.h5", bytes);
    try {
      read_table(folder.path / "cut.h5");
    } catch (const FileError& error) {
      const std::string text = error.what();
      return text.find("cut.h5") != std::string::npos && text.find("--force") != std::string::npos;
    }
    return false;
  };
  for (std::size_t size : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1})
    CHECK(refused(whole.substr(0, size)));
  CHECK(refused(whole + "x"));
  int noticed = 0, flips = 0;
  for (std::size_t at = 0; at < whole.size(); at += 5, ++flips) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    noticed += refused(flipped);
  }
  CHECK(flips > 1000);
  CHECK(noticed == flips);
  CHECK_THROWS_AS(read_table(folder.path / "absent.h5"), FileError);
}

namespace {

/// As h5py adds a data set to a file that it opened to write.
void add_numbers(const fs::path& path, const char* name, const std::vector<double>& values) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hsize_t shape[] = {values.size()};
  const hid_t space = H5Screate_simple(1, shape, nullptr),
              made = H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  REQUIRE(H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  H5Dclose(made);
  H5Sclose(space);
  REQUIRE(H5Fclose(file) >= 0);
}

bool is_example(const Table& table) {
  const Table wanted = example();
  const auto same = [](double a, double b) { return a == b || (a != a && b != b); };
  for (const NumberColumn& column : wanted.numbers) {
    const NumberColumn* read = table.number(column.field.name);
    if (!read || read->field.unit != column.field.unit || read->values.size() != column.values.size() ||
        !std::equal(column.values.begin(), column.values.end(), read->values.begin(), same))
      return false;
  }
  return table.numbers.size() == 2 && table.texts.size() == 1 && table.text("status")->values == wanted.texts[0].values;
}

}  // namespace

TEST_CASE("what a user adds beside our groups is no damage, and stays when the results are written again") {
  const Folder folder;
  const fs::path path = folder.path / "t.h5";
  write_table(path, example(), {{"host", "here"}});
  add_numbers(path, "mine", {1, 2, 3});
  CHECK(is_example(read_table(path)));
  CHECK(read_provenance(path) == Provenance{{"host", "here"}});
  CHECK_FALSE(is_trajectory(path));  // as ricochet info asks
  add_numbers(path, "too", {4});
  for (int again = 0; again < 2; ++again) {
    write_table(path, example(), {{"host", "there"}});
    CHECK(read_provenance(path).at("host") == "there");
    const hdf5::Handle file = hdf5::open_file(path);
    CHECK(hdf5::read_numbers(file, "mine") == std::vector<double>{1, 2, 3});
    CHECK(hdf5::read_numbers(file, "too") == std::vector<double>{4});
  }
}

TEST_CASE("of a file that a user added to, our groups are guarded as before: not one wrong number is read") {
  const Folder folder;
  const fs::path path = folder.path / "t.h5", other = folder.path / "cut.h5";
  write_table(path, example(), {{"host", "here"}});
  add_numbers(path, "mine", {1, 2, 3});
  const std::string grown = read_file(path);
  int refused = 0, wrong = 0;
  const auto read = [&](const std::string& bytes) {
    std::ofstream(other, std::ios::binary) << bytes;
    try {
      wrong += !is_example(read_table(other));
    } catch (const FileError& error) {
      ++refused;
      CHECK_THAT(error.what(), Catch::Matchers::Contains("cut.h5"));
    }
  };
  for (const std::string& bytes : {grown.substr(0, grown.size() - 1), grown + "x", grown.substr(0, 5000)}) read(bytes);
  CHECK(refused == 3);
  for (std::size_t at = 0; at < grown.size(); at += 5) {
    std::string flipped = grown;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    read(flipped);
  }
  CHECK(refused > 100);
  CHECK(wrong == 0);
  add_numbers(path, "rows/mine", {1, 2, 3});
  CHECK_THROWS_WITH(read_table(path), Catch::Matchers::Contains("t.h5 is damaged, or something in its groups 'rows'"));
}

TEST_CASE("writing replaces a file as a whole and leaves nothing beside it") {
  const Folder folder;
  write_atomically(folder.path / "f", "one");
  write_atomically(folder.path / "f", "two");
  CHECK(read_file(folder.path / "f") == "two");
  CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator{}) == 1);
  CHECK_THROWS_WITH(write_atomically(folder.path / "no" / "f", "x"), Catch::Matchers::Contains("cannot write"));
}

namespace {

// A square of two triangles and springs above another one of two elements, two frames.
Trajectory small_trajectory() {
  FrameMesh mesh;
  mesh.bodies = {{0, 4, {0.5}, {{{0, 1, 2, 3}}}}, {4, 4, {}, {{{4, 5}, false}, {{5, 6, 7}}}, {2, 0.3, 0.4}}};
  for (const double y : {1.0, -1.0})
    for (const auto& p : {Vec2(0, y), Vec2(1, y), Vec2(1, y + 1), Vec2(0, y + 1)}) {
      append(mesh.rest, p);
      mesh.mass.push_back(y < 0 ? 2 : 1);
      mesh.anchored.push_back(y < 0);
    }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  mesh.springs = {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 2}};
  mesh.length.assign(5, 1.0);
  mesh.stiffness.assign(5, 10.0);
  mesh.modulus = {0, 0, 5, 6};
  mesh.lame = {0, 0, 0, 0, 0.1, 0.4, 0.2, 0.3};
  Trajectory trajectory(mesh);
  for (int k : {0, 1}) {
    Frame frame;
    frame.time = k;
    frame.step = k;
    frame.energy.fill(0.5);
    frame.position.assign(mesh.rest.begin(), mesh.rest.end());
    frame.velocity.assign(mesh.rest.size(), 0);
    for (int i = 0; i < mesh.nodes(); ++i) append(frame.contact_force, Vec2(0, k));
    frame.elongation.assign(5, 0.25f);
    trajectory.add(frame);
  }
  return trajectory;
}

}  // namespace

TEST_CASE("a trajectory reads back as it was written") {
  const Folder folder;
  const Trajectory written = small_trajectory();
  write_h5md(folder.path / "t.h5", written, {{"version", "1"}});
  const Trajectory read = read_trajectory(folder.path / "t.h5");
  CHECK(read.mesh().dim == 2);
  CHECK(read.mesh().rest == written.mesh().rest);
  CHECK(read.mesh().mass == written.mesh().mass);
  CHECK(read.mesh().anchored == written.mesh().anchored);
  CHECK(read.mesh().springs == written.mesh().springs);
  CHECK(read.mesh().triangles == written.mesh().triangles);
  CHECK(read.mesh().modulus == written.mesh().modulus);
  CHECK(read.mesh().lame == written.mesh().lame);
  REQUIRE(read.mesh().bodies.size() == 2);
  for (std::size_t b : {0, 1}) {
    const BodyMesh &back = read.mesh().bodies[b], &body = written.mesh().bodies[b];
    CHECK((back.first == body.first && back.nodes == body.nodes && back.law == body.law));
    CHECK(back.solid_law == body.solid_law);
    REQUIRE(back.surface.size() == body.surface.size());
    for (std::size_t c = 0; c < body.surface.size(); ++c) {
      CHECK(back.surface[c].node == body.surface[c].node);
      CHECK(back.surface[c].closed == body.surface[c].closed);
    }
  }
  REQUIRE(read.frames().size() == 2);
  CHECK(read.frames()[1].position == written.frames()[1].position);
  CHECK(read.frames()[1].contact_force == written.frames()[1].contact_force);
  CHECK(read.frames()[1].elongation == written.frames()[1].elongation);
  CHECK(read.frames()[1].energy == written.frames()[1].energy);
}

TEST_CASE("a sealed trajectory whose parts are missing, of another size, or number nothing is refused by its name") {
  const Folder folder;
  const fs::path path = folder.path / "t.h5";
  const char* sets[] = {"ricochet/launch",
                        "ricochet/bodies",
                        "ricochet/rest",
                        "ricochet/anchored",
                        "ricochet/rest_length",
                        "ricochet/stiffness",
                        "ricochet/chains",
                        "ricochet/contact_force",
                        "ricochet/elongation",
                        "connectivity/springs",
                        "connectivity/triangles",
                        "particles/trajectory/mass",
                        "particles/trajectory/position/value",
                        "particles/trajectory/velocity/value",
                        "particles/trajectory/position/step",
                        "observables/total/value"};
  for (const char* set : sets)
    for (const char* harm : {"missing", "shorter", "numbers nothing"}) {
      const std::string name = set;
      const bool numbers = name.find("chains") != std::string::npos || name.starts_with("connectivity");
      if (std::string(harm) == "numbers nothing" && !numbers) continue;
      if (std::string(harm) == "missing" && name == "ricochet/elongation") continue;  // it may be
      write_h5md(path, small_trajectory(), {});
      const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
      REQUIRE(H5Ldelete(file, set, H5P_DEFAULT) >= 0);
      if (std::string(harm) != "missing") {
        const std::vector<double> values =
            std::string(harm) == "shorter" ? std::vector<double>(1, 0.0) : std::vector<double>{0, 1, 2, 99, 3, 1};
        const hsize_t shape[] = {values.size()};
        const hid_t space = H5Screate_simple(1, shape, nullptr),
                    made = H5Dcreate2(file, set, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        REQUIRE(H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
        H5Dclose(made);
        H5Sclose(space);
      }
      H5Fclose(file);
      const std::string bytes = read_file(path).substr(512);
      write_atomically(path, hdf5::seal_of(bytes) + bytes);
      INFO(set << " " << harm);
      if (name == "ricochet/launch" && std::string(harm) == "shorter") continue;  // it is one number anyway
      CHECK_THROWS_WITH(read_trajectory(path),
                        Catch::Matchers::Contains("t.h5 is no trajectory that this version can draw"));
    }
}

TEST_CASE("results in every format are the run's own, are found by their names, and go together") {
  const Folder folder;
  write_everywhere(run_names::results(folder.path), example(), {});
  for (const RowsSink& sink : rows_sinks()) {
    const std::string name = std::string("results") + sink.extension;
    INFO(name);
    CHECK(fs::exists(folder.path / name));
    CHECK(run_names::is_of_the_run(name));
    CHECK(run_names::is_of_the_run(name + ".new"));
  }
  CHECK(run_names::holds_results(folder.path));
  CHECK(run_names::stored(folder.path) == std::vector<fs::path>{run_names::readable_results(folder.path)});
  CHECK(read_table(run_names::readable_results(folder.path)).rows() == 3);
  run_names::remove_results(folder.path);
  CHECK(fs::is_empty(folder.path));
}

TEST_CASE("what a run made is on its list, a folder of frames loses its frames alone, and a list leads nowhere else") {
  const Folder folder;
  write_everywhere(folder.path / "a.b", small_trajectory(), {});
  fs::create_directories(folder.path / "frames");
  write_atomically(run_names::frame(folder.path / "frames", 7), "x");
  write_atomically(folder.path / "frames" / "photo.png", "x");
  write_atomically(folder.path / "plot.gp", "x");
  const std::set<std::string> made{"a.b.h5", "a.b.xdmf", "frames", "plot.gp", "gone.png"};
  run_names::write_made(folder.path, made);
  CHECK(run_names::made_in(folder.path) == made);
  CHECK(run_names::is_of_the_run(run_names::list));
  for (const TrajectorySink& sink : trajectory_sinks())
    CHECK(run_names::is_product(folder.path / (std::string("a.b") + sink.extension)));
  CHECK(run_names::is_product(folder.path / "frames"));
  CHECK_FALSE(run_names::is_product(folder.path / "plot.gp"));
  CHECK_FALSE(run_names::is_product(folder.path / "gone.png"));
  for (const std::string& name : made) run_names::remove_product(folder.path / name);
  CHECK(fs::exists(folder.path / "frames" / "photo.png"));
  CHECK_FALSE(fs::exists(run_names::frame(folder.path / "frames", 7)));
  CHECK_FALSE(run_names::is_product(folder.path / "frames"));
  CHECK_FALSE(fs::exists(folder.path / "a.b.h5"));
  write_atomically(folder.path / run_names::list, "../up.png\n/etc/passwd\nresults.h5\nsub/../../up.png\nfine.png\n");
  CHECK(run_names::made_in(folder.path) == std::set<std::string>{"fine.png"});
}
