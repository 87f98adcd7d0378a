#include "script/shard_store.hpp"

#include <algorithm>

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

void while_they_change(const std::function<std::vector<fs::path>()>& list,
                       const std::function<void(const std::vector<fs::path>&)>& take) {
  for (int listing = 1;; ++listing) {
    const std::vector<fs::path> files = list();
    try {
      return take(files);
    } catch (const FileError&) {
      std::error_code error;
      const bool gone = std::any_of(files.begin(), files.end(), [&](auto& file) { return !fs::exists(file, error); });
      if (!gone || listing == most_listings) throw;
    }
  }
}

std::size_t load_while_they_change(KnownRows& rows, const std::function<std::vector<fs::path>()>& list,
                                   const Provenance& made_by) {
  std::size_t strangers = 0;
  while_they_change(list, [&](const std::vector<fs::path>& files) {
    strangers = 0;
    for (const fs::path& file : files) strangers += rows.load(file, made_by);
  });
  return strangers;
}

ShardStore::ShardStore(Session& session, fs::path folder, std::size_t shard, const std::vector<std::string>& hashes)
    : RowStore(hashes), session_(session), folder_(std::move(folder)), shard_(shard) {
  const auto all = [this] {
    std::vector<fs::path> list = files();
    std::error_code error;
    if (const fs::path results = run_names::readable_results(folder_); fs::exists(results, error))
      list.push_back(results);
    return list;
  };
  load_while_they_change(known_, all, session.made_by());
}

std::vector<fs::path> ShardStore::files() const { return run_names::shard_files(folder_, shard_); }

Provenance ShardStore::origin() const {
  Provenance origin = Session::made_by();
  origin["host"] = host_name();
  return origin;
}

void ShardStore::add(const std::vector<std::pair<std::size_t, Row>>& batch) {
  for (const auto& [index, row] : batch) {
    known_.accept(row);
    waiting_.push_back(row);
  }
  const std::chrono::duration<double> since = Clock::now() - flushed_;
  if (waiting_.size() >= most_waiting || since.count() >= session_.options.flush) flush();
}

void ShardStore::flush() {
  flushed_ = Clock::now();
  if (waiting_.empty()) return;
  std::vector<const Row*> rows;
  for (const Row& row : waiting_) rows.push_back(&row);
  make_folder(run_names::shards(folder_));
  write_table(run_names::shard_part(folder_, shard_), table_of(rows), origin());
  waiting_.clear();
}

void ShardStore::finish() {
  make_folder(run_names::shards(folder_));
  const fs::path own = run_names::shard_part(folder_, shard_), whole = run_names::shard(folder_, shard_);
  write_table(own, table_of(known_.list()), origin());
  std::vector<fs::path> others;
  load_while_they_change(
      known_, [&] { return others = files(); }, Session::made_by());
  rename_over(own, whole);
  for (const fs::path& other : others)
    if (other != own && other != whole) remove_file(other);
  remove_file(run_names::shard_error(folder_, shard_));
}

}  // namespace ricochet
