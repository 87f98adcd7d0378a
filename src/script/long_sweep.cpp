#include "script/long_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "script/fields.hpp"
#include "script/shard_merge.hpp"
#include "script/shard_work.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace {

constexpr std::uint32_t no_row = std::numeric_limits<std::uint32_t>::max();

std::uint8_t number_of(const Method& method) {
  std::uint8_t number = 0;
  while (methods()[number].name != method.name) ++number;
  return number;
}

std::vector<bool> all_of(const std::vector<Scene>& scenes) { return std::vector<bool>(scenes.size(), true); }

}  // namespace

LongSweep::LongSweep(Session& session, std::string name, std::vector<SweptAxis> axes, std::size_t points,
                     std::size_t own)
    : session_(session),
      name_(std::move(name)),
      axes_(std::move(axes)),
      own_(own),
      hashes_(points),
      method_(points),
      chosen_(points),
      counted_(points),
      steps_(points),
      told_(points) {
  if (session.options.check) return;
  store_.emplace(session, name_, axes_);
  const bool merges = session.options.part == Part::merge;
  if (merges) plan_ = plan_of_merge(session, name_, points);
  if (store_->folder().is_shard()) plan_ = read_plan(session.sharded);
  if (session.options.resume || store_->folder().is_shard()) store_->load();
  looks_first_ = !store_->folder().is_shard() && (store_->index().rows() > 0 || merges);
}

void LongSweep::choose_steps(const std::vector<std::size_t>& points, std::vector<Scene>& scenes) {
  try {
    steps_.choose(session_, points, scenes, printed(session_, [&](std::size_t i) { return place(points[i]); }));
  } catch (const Error& error) {
    if (error.exit != Exit::interrupted) throw;
    throw with_stored(error, left_behind());
  }
}

void LongSweep::choose(const std::vector<std::size_t>& points, std::vector<Scene> scenes) {
  choose_steps(points, scenes);
  chose_ = true;
}

void LongSweep::take_steps(const std::vector<std::size_t>& points, std::vector<Scene>& scenes) {
  if (session_.options.check) return;
  if (!plan_ && !chose_ && !looked_) return choose_steps(points, scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) try {
      if (store_->folder().is_shard())
        scenes[i] = plan_->with_planned_step(std::move(scenes[i]), points[i]);
      else
        give_step(scenes[i], points[i]);
    } catch (const FieldError& error) {
      throw SceneError(error, i);
    }
}

void LongSweep::take(const std::vector<std::size_t>& points, std::vector<Scene>& scenes) {
  if (!first_) first_ = scenes.front();
  take_steps(points, scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const HashKey key = HashKey::of(scenes[i].hash());
    if (looked_ && key != hashes_[points[i]])
      throw Error(
          fmt::format("{}: the function 'scene' returned another scene at {} than before; it must depend on "
                      "`at` alone, not on what it was called for before",
                      name_, place(points[i])));
    hashes_[points[i]] = key;
    method_[points[i]] = number_of(scenes[i].method());
    chosen_[points[i]] = scenes[i].step_is_chosen();
    if (!looked_) told_.add_scene(points[i], scenes[i]);
  }
}

void LongSweep::look(const std::vector<std::size_t>& points, std::vector<Scene> scenes) { take(points, scenes); }

std::size_t LongSweep::known() const {
  return static_cast<std::size_t>(std::count_if(
      hashes_.begin(), hashes_.end(), [this](const HashKey& key) { return store_->index().find(key) != nullptr; }));
}

void LongSweep::end_look() {
  looked_ = true;
  store_->folder().refuse_strangers(store_->index().strangers(hashes_));
  for (std::size_t point = 0; point < hashes_.size(); ++point)
    counted_[point] = store_->index().find(hashes_[point]) != nullptr;
  if (plan_ || session_.options.part == Part::merge) refuse_missing(session_, name_, counted_);
}

bool LongSweep::lacks(const std::vector<std::size_t>& points) {
  if (session_.options.part == Part::merge) return false;
  const auto has_none = [this](std::size_t point) { return store_->index().find(hashes_[point]) == nullptr; };
  if (!looked_ || std::any_of(points.begin(), points.end(), has_none)) return true;
  const std::size_t fresh = count_stored(points);
  if (fresh > 0 && progress_) progress_->add(fresh, 0);
  return false;
}

void LongSweep::warn_of_twins(std::size_t repeated, std::size_t of) {
  if (repeated == 0 || warned_) return;
  warned_ = true;
  session_.warn(fmt::format(
      "{}: {} of {} scenes that were made together repeat another one exactly, so they are no samples of their own; "
      "does every name of 'over' reach the scene, and at.sample as its seed?",
      name_, repeated, of));
}

void LongSweep::add_use(const SweepUse& use) {
  const double all = use_.seconds + use.seconds;
  const auto mean = [&](double before, double now) {
    return all > 0 ? (before * use_.seconds + now * use.seconds) / all : 0;
  };
  use_ = {all, use.threads, mean(use_.idle_threads, use.idle_threads), mean(use_.idle_lanes, use.idle_lanes)};
}

// How many points of a chunk have a row that the progress does not know of.
std::size_t LongSweep::count_stored(const std::vector<std::size_t>& points) {
  std::size_t fresh = 0;
  for (const std::size_t point : points) {
    if (counted_[point] || !store_->index().find(hashes_[point])) continue;
    counted_[point] = true;
    ++fresh;
  }
  return fresh;
}

// Returns false if it was interrupted.
bool LongSweep::run_rest(const std::vector<std::size_t>& points, const std::vector<Scene>& scenes) {
  if (!progress_) {
    const bool is_shard = store_->folder().is_shard();
    progress_.emplace(session_, is_shard ? shard_name(session_, name_) : name_, own_, looked_ ? known() : 0);
  }
  std::vector<bool> todo(scenes.size());
  std::unordered_map<HashKey, std::size_t, HashKey::Spread> points_of;  // a scene that occurs twice runs once
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const HashKey& key = hashes_[points[i]];
    todo[i] = ++points_of[key] == 1 && !store_->index().find(key);
  }
  warn_of_twins(scenes.size() - points_of.size(), scenes.size());
  const std::size_t before = count_stored(points);
  const auto keep = [&](const std::vector<Result>& results) {
    std::vector<Row> rows;
    std::vector<std::size_t> of;
    std::size_t failed = 0, with_row = 0;
    for (const Result& result : results) {
      const std::size_t i = result.index;
      with_row += points_of.at(hashes_[points[i]]);
      rows.push_back(row_of(scenes[i], result.outcome, result.seconds, hashes_[points[i]].digits()));
      of.push_back(points[i]);
      failed += result.outcome.status != Status::finished;
    }
    ran_ += rows.size();
    progress_->add(with_row, failed);
    store_->add(std::move(rows), of);
  };
  const SceneName name = [&](std::size_t i) { return place(points[i]); };
  SweepUse use;
  const bool whole =
      run_chosen(scenes, todo, options_of(session_), stop_requested, keep, printed(session_, name), &use);
  add_use(use);
  if (before > 0) progress_->add(before, 0);
  for (const std::size_t point : points) counted_[point] = true;
  return whole;
}

void LongSweep::run(const std::vector<std::size_t>& points, std::vector<Scene> scenes) {
  take(points, scenes);
  if (session_.options.check) return check_scenes(scenes, all_of(scenes), options_of(session_), stop_requested);
  check_steps(session_, scenes);
  const Storing storing;
  try {
    if (run_rest(points, scenes)) return store_->end_chunk();
    store_->flush();
    throw Error("interrupted: " + left_behind(), Exit::interrupted);
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}{}", error.what(), stored()));
  } catch (const SceneError&) {
    store_->flush();
    throw;
  }
}

// Before the scenes were looked at, it is not known which of the stored rows are theirs.
std::string LongSweep::left_behind() const {
  return store_->folder().left_behind(looks_first_ && !looked_ ? store_->index().rows() : known(), own_);
}

std::string LongSweep::stored() const { return store_ && store_->index().rows() > 0 ? "\n  " + left_behind() : ""; }

void LongSweep::end_shard() {
  std::vector<std::size_t> points;
  std::vector<HashKey> scenes;
  for (std::size_t point = 0; point < hashes_.size(); ++point) {
    if (!counted_[point]) continue;
    points.push_back(point);
    scenes.push_back(hashes_[point]);
  }
  tell_shard_end(session_, name_, store_->write_shard(scenes, points), points.size());
}

void LongSweep::end() {
  if (session_.options.check) return session_.inform(fmt::format("{}: {} scenes are sound\n", name_, hashes_.size()));
  std::vector<RowPlace> rows;
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < hashes_.size(); ++point)
    if (const RowPlace* place = store_->index().find(hashes_[point])) {
      rows.push_back(*place);
      points.push_back(point);
    }
  LongStore::Columns columns;
  for (const char* name : {"step", "theta", "theta_most", "over_yield", "folded", "penetration"}) columns[name];
  const bool whole = rows.size() == hashes_.size();
  const LongStore::Written written = store_->write_results(rows, points, columns, whole);
  if (!whole) rows_.assign(hashes_.size(), no_row);
  for (std::size_t row = 0; !whole && row < points.size(); ++row) rows_[points[row]] = static_cast<std::uint32_t>(row);
  tell(written, columns, points);
}

void LongSweep::tell(const LongStore::Written& written, const LongStore::Columns& columns,
                     const std::vector<std::size_t>& points) {
  const auto of = [&](const char* name, std::size_t row) { return columns.at(name)[row]; };
  for (std::size_t row = 0; row < points.size(); ++row) {
    const std::size_t point = points[row];
    told_.add_row(point, {&methods()[method_[point]], chosen_[point], written.finished[row], of("step", row),
                          of("theta", row), of("theta_most", row), of("over_yield", row), of("folded", row),
                          of("penetration", row) / told_.units().worth("R")});
  }
  const auto finished = static_cast<std::size_t>(std::count(written.finished.begin(), written.finished.end(), true));
  session_.count(finished, points.size() - finished, written.first_failure);
  std::string text = fmt::format("{}: {} of {} impacts finished; {}\n{}  digest of outcomes {}\n", name_, finished,
                                 hashes_.size(), results().string(), told_.steps_text(), written.digest);
  if (ran_ > 0) text += use_text(use_);
  session_.inform(text);
  told_.warn_of_limit(session_, [this](std::size_t point) { return place(point); });
  if (session_.options.quiet) told_.warn_of_doubts(session_);
}

std::filesystem::path LongSweep::results() const { return run_names::readable_results(session_.folders.named(name_)); }

std::optional<std::size_t> LongSweep::row_of_point(std::size_t point) const {
  if (!store_) return std::nullopt;
  if (rows_.empty()) return point;
  return rows_[point] == no_row ? std::nullopt : std::optional<std::size_t>(rows_[point]);
}

Row LongSweep::missing(std::size_t point) const {
  Row row = store_ ? missing_row(*first_) : row_of(*first_, Outcome{}, 0);
  row.hash = hashes_[point].digits();
  row.seed.clear();  // that of another scene
  return row;
}

void LongSweep::give_step(Scene& scene, std::size_t point) const {
  if (plan_)
    scene = plan_->with_step(scene, point);
  else
    steps_.give(scene, point);
}

std::optional<std::size_t> LongSweep::point_of(const std::string& hash) const {
  const auto found = std::find(hashes_.begin(), hashes_.end(), HashKey::of(hash));
  if (found == hashes_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - hashes_.begin());
}

}  // namespace ricochet
