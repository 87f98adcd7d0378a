-- A sweep of more points than are kept in memory together: its scenes are made and run chunk by chunk, whole lattices
-- together, and its rows are read from the file of its results.
local core = require "ricochet.core"
local lattices = require "ricochet.lattices"
local long_rows = require "ricochet.long_rows"
local points = require "ricochet.points"

local long_sweep = {}

-- Scenes of one value after the other of a factor that are made before any runs.
local most_tried = 100

-- Points whose scenes trials choose steps for together, however many are kept together: steps, and with them the bits
-- of rows, do not depend on --at-once.
local tried_together = 8192

local function asks_for_accuracy(scene)
  local _, asks = core.lattice(scene)
  return asks
end

--- True if a sweep has more points than are kept together, or than steps are chosen for together. `make`: the scene at
--- values of `over`.
function long_sweep.is_long(sweep, make)
  local count = points.count(sweep)
  return count > core.at_once() or count > tried_together and asks_for_accuracy(make(points.values_at(sweep, 0)))
end

-- A mistake in the script's function is found before days of impacts, where one value of one name brings it about. True
-- if one of these scenes asks for an accuracy.
local function try_values(sweep, make)
  local asks = false
  for _, factor in ipairs(sweep.factors) do
    local count = #sweep.over[factor.names[1]]
    for i = 1, math.min(count, most_tried) do
      local values = points.values_at(sweep, 0)
      points.set(sweep, factor, values, 1 + (i - 1) * (count - 1) // math.max(1, math.min(count, most_tried) - 1))
      asks = asks_for_accuracy(make(values)) or asks
    end
  end
  return asks
end

-- Calls use(places, scenes) for chunk after chunk of so many, where wanted(places).
local function each_chunk(sweep, at_once, place_of, make, wanted, use)
  local count = points.count(sweep)
  for first = 0, count - 1, at_once do
    local places, scenes = {}, {}
    for i = first, math.min(first + at_once, count) - 1 do places[#places + 1] = place_of(i) end
    table.sort(places)  -- as a sweep has them that is made at once: which are tried goes by their order
    if wanted(places) then
      for k, place in ipairs(places) do scenes[k] = make(points.values_at(sweep, place)) end
      use(places, scenes)
    end
  end
end

local function all() return true end

--- Calls use(places, scenes) for all points of a sweep, from 0, as many as are made together, whole lattices together.
--- names: of lattices.names_of().
function long_sweep.each_chunk(sweep, names, make, use)
  each_chunk(sweep, core.at_once(), points.by_lattice(names), make, all, use)
end

--- The same, as many as steps are chosen for together.
function long_sweep.each_trial(sweep, names, make, use)
  each_chunk(sweep, tried_together, points.by_lattice(names), make, all, use)
end

--- Runs it; the list of its rows. `make`: the scene at values of `over`.
function long_sweep.run(sweep, make)
  local names = lattices.names_of(sweep, make(points.values_at(sweep, 0)), make,
    ("a sweep of more than %d points calls it again for a point, and"):format(math.min(core.at_once(), tried_together)))
  local place_of = points.by_lattice(names)
  local asks = try_values(sweep, make)
  local long = core.long_sweep(sweep.name, points.axes(sweep), points.count(sweep))
  if asks and core.at_once() ~= tried_together and core.long_chooses(long) then
    long_sweep.each_trial(sweep, names, make, function(places, scenes) core.long_choose(long, places, scenes) end)
  end
  if core.long_looks_first(long) then
    long_sweep.each_chunk(sweep, names, make, function(places, scenes) core.long_look(long, places, scenes) end)
    core.long_end_look(long)
  end
  each_chunk(sweep, core.at_once(), place_of, make, function(places) return core.long_lacks(long, places) end,
    function(places, scenes) core.long_run(long, places, scenes) end)
  local stored = core.long_end(long, function(place) return make(points.values_at(sweep, place)) end)
  return long_rows.list(stored, points.axes(sweep), points.count(sweep))
end

--- The rows of one whose shards were merged, for a shard of a later sweep.
function long_sweep.merged(sweep, make)
  local axes, count = points.axes(sweep), points.count(sweep)
  return long_rows.list(core.long_merged(sweep.name, axes, count, make(points.values_at(sweep, 0))), axes, count)
end

return long_sweep
