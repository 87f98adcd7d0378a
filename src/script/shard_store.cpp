#include "script/shard_store.hpp"

#include <fmt/format.h>

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

std::size_t load_while_they_change(KnownRows& rows, const std::function<std::vector<fs::path>()>& list) {
  std::size_t strangers = 0;
  while_they_change(list, [&](const std::vector<fs::path>& files) {
    strangers = 0;
    for (const fs::path& file : files) strangers += rows.load(file);
  });
  return strangers;
}

ShardStore::ShardStore(Session& session, std::size_t shard, const std::vector<std::string>& hashes,
                       const Parameters& parameters)
    : RowStore(hashes), session_(session), folder_(session.sharded), shard_(shard), parameters_(parameters) {
  load_while_they_change(known_, [this] { return run_names::stored_for_shard(folder_, shard_); });
}

void ShardStore::write(const fs::path& file, const std::vector<const Row*>& rows,
                       const std::vector<std::size_t>& places) const {
  Table table = table_of(rows);
  parameters_.add_to(table, places);
  write_table(file, table, origin_of_shard());
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
  const fs::path own = run_names::shard_part(folder_, shard_);
  write(own, known_.list(), known_.places());
  std::vector<fs::path> all;
  load_while_they_change(known_, [&] { return all = run_names::shard_files(folder_, shard_); });
  become_shard(own, folder_, shard_, all);
}

void become_shard(const fs::path& own, const fs::path& folder, std::size_t shard, const std::vector<fs::path>& all) {
  const fs::path whole = run_names::shard(folder, shard);
  try {
    rename_over(own, whole);
  } catch (const FileError&) {
    // Another process of this shard has taken up what is here, compared it with its own rows and removed it.
    std::error_code error;
    if (fs::exists(own, error) || !fs::exists(whole, error)) throw;
  }
  for (const fs::path& other : all)
    if (other != own && other != whole) remove_file(other);
  remove_file(run_names::shard_error(folder, shard));
}

std::string shard_left_behind(const Session& session, std::size_t count, std::size_t all) {
  return fmt::format("{} of {} impacts of shard {}/{} are stored in {}; the same command goes on from there", count,
                     all, session.options.shard, session.options.shards, session.sharded.string());
}

Provenance origin_of_shard() {
  Provenance origin = Session::made_by();
  origin["host"] = host_name();
  return origin;
}

}  // namespace ricochet
