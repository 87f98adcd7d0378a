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

-- Lets trials choose the steps of all points, as a run of all of them would.
local function choose_steps(sweep, names, make)
  local count = points.count(sweep)
  long_sweep.each_trial(sweep, names, make, function(places, scenes)
    core.plan_steps(sweep.name, count, places, scenes)
  end)
end

-- A shard of more points than are kept together.
local function run_chunks(sweep, own, make)
  local shard, at_once = core.long_sweep(sweep.name, points.axes(sweep), points.count(sweep), #own), core.at_once()
  for first = 1, #own, at_once do
    local places, scenes = table.move(own, first, math.min(first + at_once - 1, #own), 1, {}), {}
    for i, place in ipairs(places) do scenes[i] = make(points.values_at(sweep, place)) end
    core.long_run(shard, places, scenes)
  end
  core.long_end_shard(shard)
end

--- Runs this process's shard, or makes the plan of all, and ends the script. `make`: the scene at values of `over`.
function shards.run(sweep, make)
  local over, first = text_of(sweep), make(points.values_at(sweep, 0))
  local own = core.shard_points(sweep.name, over, first)
  if not own then
    local names = lattices.names_of(sweep, first, make, "in shards")
    local _, by_trials = core.lattice(first)
    if by_trials then choose_steps(sweep, names, make) end
    if core.holds_rows(sweep.name) then
      long_sweep.each_chunk(sweep, names, make, function(places, scenes) core.plan_look(places, scenes) end)
    end
    core.plan_shards(sweep.name, over, first, names)
    own = core.shard_points(sweep.name, over, first)
  end
  if #own > core.at_once() then run_chunks(sweep, own, make) end
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
