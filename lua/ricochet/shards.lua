-- A sweep in shards, each a process of its own: only the scenes of its own points are made.
local core = require "ricochet.core"

local shards = {}

-- How many values a factor has.
local function values_of(sweep, factor) return #sweep.over[factor.names[1]] end

-- Sets the names of a factor to their k-th values.
local function set(sweep, factor, values, k)
  for _, name in ipairs(factor.names) do values[name] = sweep.over[name][k] end
end

-- The values of `over` at a point, counted from 0: the last factor is the fastest.
local function values_at(sweep, point)
  local values = {}
  for i = #sweep.factors, 1, -1 do
    local factor = sweep.factors[i]
    local count = values_of(sweep, factor)
    set(sweep, factor, values, point % count + 1)
    point = point // count
  end
  return values
end

-- All values, exactly, those that go together in a line each.
local function text_of(sweep)
  local lines = {}
  for _, factor in ipairs(sweep.factors) do
    for k = 1, values_of(sweep, factor) do
      local values = {}
      for i, name in ipairs(factor.names) do values[i] = ("%s = %q"):format(name, sweep.over[name][k]) end
      lines[#lines + 1] = table.concat(values, ", ")
    end
  end
  return table.concat(lines, "\n")
end

-- A list of { name =, values =, changes_lattice = }, one a factor: does another value of it alone make another lattice?
-- Where this is wrong, shards take longer, and come to the same.
local function names_of(sweep, first, make)
  local group, _, hash = core.lattice(first)
  local names = {}
  for i, factor in ipairs(sweep.factors) do
    local count, changes = values_of(sweep, factor), false
    for _, k in ipairs { 2, count } do
      if k > 1 and k <= count then
        local values = values_at(sweep, 0)
        set(sweep, factor, values, k)
        changes = changes or core.lattice(make(values)) ~= group
      end
    end
    names[i] = { name = table.concat(factor.names, " "), values = count, changes_lattice = changes }
  end
  local _, _, again = core.lattice(make(values_at(sweep, 0)))
  if again ~= hash then
    core.fail_in(sweep.scene, "scene", "the function returned two different scenes for the same values: in shards " ..
      "it must depend on `at` alone, not on what it was called for before")
  end
  return names
end

local function all_scenes(sweep, names, make)
  local count = 1
  for _, name in ipairs(names) do count = count * name.values end
  local scenes = {}
  for point = 0, count - 1 do scenes[point + 1] = make(values_at(sweep, point)) end
  return scenes
end

--- Runs this process's shard, or makes the plan of all, and ends the script. `make`: the scene at values of `over`.
function shards.run(sweep, make)
  local over, first = text_of(sweep), make(values_at(sweep, 0))
  local points = core.shard_points(sweep.name, over, first)
  if not points then
    local names = names_of(sweep, first, make)
    local _, by_trials = core.lattice(first)
    local scenes = (by_trials or core.holds_rows(sweep.name)) and all_scenes(sweep, names, make) or {}
    core.plan_shards(sweep.name, over, first, names, scenes)
    points = core.shard_points(sweep.name, over, first)
  end
  local values, scenes = {}, {}
  for i, point in ipairs(points) do
    values[i] = values_at(sweep, point)
    scenes[i] = make(values[i])
  end
  core.run_shard(sweep.name, sweep.names, values, scenes, points, sweep.units)
end

--- True if this process is to run a shard of the sweep, or to plan it.
function shards.runs(name)
  local part = core.part()
  return (part == "shard" or part == "plan") and not core.is_merged(name)
end

return shards
