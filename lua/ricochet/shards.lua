-- A sweep in shards, each a process of its own: only the scenes of its own points are made.
local core = require "ricochet.core"

local shards = {}

-- Where shards are run or merged, nothing may depend on what has come out so far.
function shards.refuse_rounds()
  core.fail("samples = \"by_error\" decides by rows how many samples to run, which no shard has: give the numbers " ..
    "of samples in over.sample, as an earlier run found them", "samples")
end

-- The values of `over` at a point, counted from 0: the last name is the fastest.
local function values_at(sweep, point)
  local values = {}
  for k = #sweep.names, 1, -1 do
    local list = sweep.over[sweep.names[k]]
    values[sweep.names[k]] = list[point % #list + 1]
    point = point // #list
  end
  return values
end

-- All values, exactly.
local function text_of(sweep)
  local lines = {}
  for _, name in ipairs(sweep.names) do
    local values = {}
    for k, value in ipairs(sweep.over[name]) do values[k] = ("%q"):format(value) end
    lines[#lines + 1] = name .. " = " .. table.concat(values, ", ")
  end
  return table.concat(lines, "\n")
end

-- A list of { name =, values =, changes_lattice = }: does another value of the name alone make another lattice? Where
-- this is wrong, shards take longer, and come to the same.
local function names_of(sweep, first, make)
  local group, _, hash = core.lattice(first)
  local names = {}
  for i, name in ipairs(sweep.names) do
    local list = sweep.over[name]
    local changes = false
    for _, k in ipairs { 2, #list } do
      if list[k] ~= nil and list[k] ~= list[1] then
        local values = values_at(sweep, 0)
        values[name] = list[k]
        changes = changes or core.lattice(make(values)) ~= group
      end
    end
    names[i] = { name = name, values = #list, changes_lattice = changes }
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
    core.plan_shards(sweep.name, over, first, names, by_trials and all_scenes(sweep, names, make) or {})
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
