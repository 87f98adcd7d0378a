-- A sweep in shards, each a process of its own: only the scenes of its own points are made.
local core = require "ricochet.core"
local lattices = require "ricochet.lattices"
local long_sweep = require "ricochet.long_sweep"
local points = require "ricochet.points"

local shards = {}

-- All values, exactly, those that go together in a line each.
local function text_of(sweep)
  local lines = {}
  for _, factor in ipairs(sweep.factors) do
    for k = 1, #sweep.over[factor.names[1]] do
      local values = {}
      for i, name in ipairs(factor.names) do values[i] = ("%s = %q"):format(name, sweep.over[name][k]) end
      lines[#lines + 1] = table.concat(values, ", ")
    end
  end
  return table.concat(lines, "\n")
end

local function all_scenes(sweep, make)
  local places, scenes = {}, {}
  for point = 0, points.count(sweep) - 1 do
    places[point + 1], scenes[point + 1] = point, make(points.values_at(sweep, point))
  end
  return places, scenes
end

-- Lets trials choose the steps of all points, as a run of all of them would.
local function choose_steps(sweep, names, make)
  if long_sweep.is_long(sweep) then
    local count = points.count(sweep)
    long_sweep.each_chunk(sweep, names, make, function(places, scenes)
      core.plan_steps(sweep.name, count, places, scenes)
    end)
    return
  end
  local places, scenes = all_scenes(sweep, make)
  core.plan_steps(sweep.name, #places, places, scenes)
end

--- Runs this process's shard, or makes the plan of all, and ends the script. `make`: the scene at values of `over`.
function shards.run(sweep, make)
  local over, first = text_of(sweep), make(points.values_at(sweep, 0))
  local own = core.shard_points(sweep.name, over, first)
  if not own then
    local names = lattices.names_of(sweep, first, make, "in shards")
    local _, by_trials = core.lattice(first)
    if by_trials then choose_steps(sweep, names, make) end
    local _, scenes = nil, {}
    if core.holds_rows(sweep.name) then _, scenes = all_scenes(sweep, make) end
    core.plan_shards(sweep.name, over, first, names, scenes)
    own = core.shard_points(sweep.name, over, first)
  end
  local values, scenes = {}, {}
  for i, point in ipairs(own) do
    values[i] = points.values_at(sweep, point)
    scenes[i] = make(values[i])
  end
  core.run_shard(sweep.name, sweep.names, values, scenes, own, sweep.units)
end

--- True if this process is to run a shard of the sweep, or to plan it.
function shards.runs(name)
  local part = core.part()
  return (part == "shard" or part == "plan") and not core.is_merged(name)
end

return shards
