#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "store/files.hpp"
#include "store/hdf5.hpp"
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
  CHECK(csv(example()) == "e,speed [c],status\n0.5,0.1,finished\n1.25,0.3333333333333333,\"a, \"\"quoted\"\" one\"\n,1e-300,\n");
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
  for (std::size_t size : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) CHECK(refused(whole.substr(0, size)));
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

TEST_CASE("writing replaces a file as a whole and leaves nothing beside it") {
  const Folder folder;
  write_atomically(folder.path / "f", "one"), write_atomically(folder.path / "f", "two");
  CHECK(read_file(folder.path / "f") == "two");
  CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator{}) == 1);
  CHECK_THROWS_WITH(write_atomically(folder.path / "no" / "f", "x"), Catch::Matchers::Contains("cannot write"));
}
