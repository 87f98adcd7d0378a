-- A sweep of more points than are kept in memory together: its scenes are made and run chunk by chunk, whole lattices
-- together, and its rows are read from the file of its results.
local core = require "ricochet.core"
local lattices = require "ricochet.lattices"
local long_rows = require "ricochet.long_rows"
local points = require "ricochet.points"

local long_sweep = {}

-- Scenes of one value after the other of a factor that are made before any runs.
local most_tried = 100

--- True if a sweep has more points than are kept together.
function long_sweep.is_long(sweep) return points.count(sweep) > core.at_once() end

-- A mistake in the script's function is found before days of impacts, where one value of one name brings it about.
local function try_values(sweep, make)
  for _, factor in ipairs(sweep.factors) do
    local count = #sweep.over[factor.names[1]]
    for i = 1, math.min(count, most_tried) do
      local values = points.values_at(sweep, 0)
      points.set(sweep, factor, values, 1 + (i - 1) * (count - 1) // math.max(1, math.min(count, most_tried) - 1))
      make(values)
    end
  end
end

-- Calls use(places, scenes) for chunk after chunk, where wanted(places).
local function each_chunk(sweep, place_of, make, wanted, use)
  local count, at_once = points.count(sweep), core.at_once()
  for first = 0, count - 1, at_once do
    local places, scenes = {}, {}
    for i = first, math.min(first + at_once, count) - 1 do places[#places + 1] = place_of(i) end
    if wanted(places) then
      for k, place in ipairs(places) do scenes[k] = make(points.values_at(sweep, place)) end
      use(places, scenes)
    end
  end
end

--- Calls use(places, scenes) for all points of a sweep, from 0, as many as are made together, whole lattices together.
--- names: of lattices.names_of().
function long_sweep.each_chunk(sweep, names, make, use)
  each_chunk(sweep, points.by_lattice(names), make, function() return true end, use)
end

--- Runs it; the list of its rows. `make`: the scene at values of `over`.
function long_sweep.run(sweep, make)
  local names = lattices.names_of(sweep, make(points.values_at(sweep, 0)), make,
    ("a sweep of more than %d points calls it again for a point, and"):format(core.at_once()))
  local place_of = points.by_lattice(names)
  try_values(sweep, make)
  local long = core.long_sweep(sweep.name, points.axes(sweep), points.count(sweep))
  if core.long_looks_first(long) then
    long_sweep.each_chunk(sweep, names, make, function(places, scenes) core.long_look(long, places, scenes) end)
    core.long_end_look(long)
  end
  each_chunk(sweep, place_of, make, function(places) return core.long_lacks(long, places) end,
    function(places, scenes) core.long_run(long, places, scenes) end)
  local stored = core.long_end(long, function(place) return make(points.values_at(sweep, place)) end)
  return long_rows.list(stored, points.axes(sweep), points.count(sweep))
end

return long_sweep
