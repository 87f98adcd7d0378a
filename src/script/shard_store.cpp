#include "script/shard_store.hpp"

#include "core/error.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// Rows of a part, at most.
constexpr std::size_t most_waiting = 4096;

// A shard ends once; files that go each time they are listed are not its doing.
constexpr int most_listings = 100;

}  // namespace

std::size_t load_while_they_change(KnownRows& rows, const std::function<std::vector<fs::path>()>& list) {
  for (int listing = 1;; ++listing) {
    std::size_t strangers = 0;
    bool gone = false;
    for (const fs::path& file : list()) try {
        strangers += rows.load(file);
      } catch (const FileError&) {
        std::error_code error;
        if (fs::exists(file, error) || listing == most_listings) throw;
        gone = true;
      }
    if (!gone) return strangers;
  }
}

ShardStore::ShardStore(Session& session, std::size_t shard, const std::vector<std::string>& hashes,
                       const Parameters& parameters)
    : RowStore(hashes), session_(session), folder_(session.sharded), shard_(shard), parameters_(parameters) {
  const auto all = [this] {
    std::vector<fs::path> list = files();
    std::error_code error;
    if (const fs::path results = run_names::readable_results(folder_); fs::exists(results, error))
      list.push_back(results);
    return list;
  };
  load_while_they_change(known_, all);
}

std::vector<fs::path> ShardStore::files() const { return run_names::shard_files(folder_, shard_); }

void ShardStore::write(const fs::path& file, const std::vector<const Row*>& rows,
                       const std::vector<std::size_t>& places) const {
  Provenance origin = Session::made_by();
  origin["host"] = host_name();
  Table table = table_of(rows);
  parameters_.add_to(table, places);
  write_table(file, table, origin);
}

void ShardStore::add(const std::vector<std::pair<std::size_t, Row>>& batch) {
  for (const auto& [index, row] : batch) {
    known_.accept(row);
    waiting_.emplace_back(index, row);
  }
  const std::chrono::duration<double> since = Clock::now() - flushed_;
  if (waiting_.size() >= most_waiting || since.count() >= session_.options.flush) flush();
}

void ShardStore::flush() {
  flushed_ = Clock::now();
  if (waiting_.empty()) return;
  std::vector<const Row*> rows;
  std::vector<std::size_t> places;
  for (const auto& [index, row] : waiting_) {
    rows.push_back(&row);
    places.push_back(index);
  }
  make_folder(run_names::shards(folder_));
  write(run_names::shard_part(folder_, shard_), rows, places);
  waiting_.clear();
}

void ShardStore::finish() {
  make_folder(run_names::shards(folder_));
  const fs::path own = run_names::shard_part(folder_, shard_), whole = run_names::shard(folder_, shard_);
  write(own, known_.list(), known_.places());
  std::vector<fs::path> others;
  load_while_they_change(known_, [&] { return others = files(); });
  try {
    rename_over(own, whole);
  } catch (const FileError&) {
    // Another process of this shard has taken up what is here, compared it with its own rows and removed it.
    std::error_code error;
    if (fs::exists(own, error) || !fs::exists(whole, error)) throw;
  }
  for (const fs::path& other : others)
    if (other != own && other != whole) remove_file(other);
  remove_file(run_names::shard_error(folder_, shard_));
}

}  // namespace ricochet
