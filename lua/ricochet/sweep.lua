-- ricochet.sweep: scenes over every combination of some values.
local core = require "ricochet.core"
local designs = require "ricochet.designs"
local long_sweep = require "ricochet.long_sweep"
local outcomes = require "ricochet.outcomes"
local points = require "ricochet.points"
local rounds = require "ricochet.rounds"
local rows_of = require("ricochet.rows").rows_of
local shards = require "ricochet.shards"

local methods = {}
local Sweep = { __name = "sweep", __metatable = false }
Sweep.__index = function(_, name)
  if name == "summary" or type(name) == "number" then
    core.fail_here "this sweep has not run: rows come from sweep:run()"
  end
  return methods[name] or core.unknown("a sweep", name, { "run", "at", "record" })
end
Sweep.__newindex = function() core.fail_here "a sweep takes no new fields" end

-- What each sweep holds, where no script can change it: { name =, scene =, over =, factors =, names =, units = }, of
-- which points.lua makes its points.
local held = setmetatable({}, { __mode = "k" })
local function contents(sweep) return core.is(sweep, Sweep) and held[sweep] or nil end

-- Names that a parameter must not take, because a row's outcome would be hidden.
local outcome = core.columns()
for _, name in ipairs { "status", "reason", "scene_hash", "wall_seconds" } do outcome[name] = "" end
for _, name in ipairs(outcomes.shared) do
  outcome[name], outcome["over_" .. name], outcome["outcome_" .. name] = nil, "", ""
end

local most_combinations = 1e7

-- The names in order; every combination of the factors' values is a point, the last factor fastest.
local function checked_names(over, factors, counts)
  local names = {}
  for name, values in pairs(over) do
    if name == "" or name == "." or name:find "[%c/]" then
      core.fail(("over: '%s' cannot name a column of results; use letters, digits and _"):format(name:gsub("%c", "?")),
        "over")
    end
    if counts and (name == "sample" or name == "mirrored" or name == "pair") then
      core.fail(("over.%s: samples = \"by_error\" makes that column itself; leave it out"):format(name), "over", name)
    end
    if outcome[name] then
      core.fail(("over.%s: '%s' is a column of the outcome; take another name"):format(name, name), "over", name)
    end
    if type(values) ~= "table" or #values == 0 then
      core.fail(("over.%s must be a list of values that is not empty, is %s"):format(name,
        type(values) == "table" and "an empty table" or tostring(values)), "over", name)
    end
    if name == "count" or name == "failed" then
      core.fail(("over.%s: '%s' is a column of summaries; take another name"):format(name, name), "over", name)
    end
    for i = 1, #values do
      local value = values[i]
      local kind = type(value)
      if value == nil then
        core.fail(("over.%s has nothing (nil) at place %d; leave that place out"):format(name, i), "over", name)
      end
      if kind ~= "number" and kind ~= "string" and kind ~= "boolean" then
        core.fail(("over.%s: value %d is a %s; numbers, strings and booleans are accepted"):format(name, i, kind),
          "over", name)
      end
      if kind ~= type(values[1]) then
        core.fail(("over.%s mixes a %s and a %s"):format(name, type(values[1]), kind), "over", name)
      end
      if value ~= value then core.fail(("over.%s: value %d is not a number (nan)"):format(name, i), "over", name) end
    end
    names[#names + 1] = name
  end
  local count = 1
  for _, factor in ipairs(factors) do count = count * #over[factor.names[1]] end
  if count > most_combinations then
    core.fail(("'over' has %.3g combinations; a sweep takes at most %.0g of them: give shorter lists, or several " ..
      "sweeps"):format(count, most_combinations), "over")
  end
  if #names == 0 and not counts then core.fail("'over' is empty; give at least one name = list of values", "over") end
  table.sort(names)
  return names
end

-- A misspelt at.name is an error, not nil.
local function strict(point, names)
  return setmetatable({}, {
    __index = function(_, key)
      local value = point[key]
      if value == nil then core.unknown("'over'", key, names) end
      return value
    end,
  })
end

-- "sample = 1, psi1 = 0.5" for messages.
local function place(point, names)
  local parts = {}
  for i, name in ipairs(names) do
    parts[i] = ("%s = %s"):format(name, type(point[name]) == "string" and "'" .. point[name] .. "'"
      or tostring(point[name]))
  end
  return table.concat(parts, ", ")
end

-- The scene at some values of `over`.
local function scene_at(sweep, point)
  local scene = core.make_scene(sweep.scene, strict(point, sweep.names), place(point, sweep.names))
  if not core.is_scene(scene) then
    core.fail_in(sweep.scene, "scene",
      scene == nil and "the function returned nothing; it must return a scene (is a 'return' missing?)"
      or ("the function must return a scene (from ricochet.scene), returned a %s%s"):format(type(scene),
        type(scene) == "table" and "; write: return ricochet.scene { ... }" or ""))
  end
  return scene
end

--- The scene at some values of `over`.
methods.at = core.wrap(function(self, point)
  local sweep = contents(self) or core.fail "is a method of a sweep: write sweep:at { ... }, with a colon"
  if type(point) ~= "table" then core.fail "takes the values of 'over': sweep:at { name = value }" end
  return scene_at(sweep, core.plain(point))
end)

methods.run = core.wrap(function(self)
  local sweep = contents(self) or core.fail "is a method of a sweep: write sweep:run(), with a colon"
  if sweep.by_error then
    local own = { name = sweep.name, names = sweep.names, points = points.list(sweep), units = sweep.units }
    local names = { table.unpack(sweep.names) }
    names[#names + 1] = "sample"
    local given = { scene = sweep.scene, names = names }
    function own.make(point) return scene_at(given, point) end
    sweep.rows = rows_of(rounds.run(own, sweep.by_error), { names = names, units = sweep.units })
    return sweep.rows
  end
  local function make(point) return scene_at(sweep, point) end
  if shards.runs(sweep.name) then shards.run(sweep, make) end
  if long_sweep.is_long(sweep, make) then
    local is_part = core.part() == "shard" or core.part() == "plan"
    sweep.rows = rows_of(is_part and long_sweep.merged(sweep, make) or long_sweep.run(sweep, make), sweep)
    return sweep.rows
  end
  local list, scenes = points.list(sweep), {}
  for i, point in ipairs(list) do scenes[i] = make(point) end
  local rows = rows_of(core.run_sweep(sweep.name, sweep.names, list, scenes, "whole", sweep.units), sweep)
  sweep.rows = rows
  return rows
end)

-- The hashes of rows, given as rows or as their numbers.
local function hashes_of(sweep, rows)
  local hashes = {}
  for i = 1, #rows do
    local row = rows[i]
    if math.type(row) == "integer" then
      if row < 1 or row > #sweep.rows then
        core.fail(("there is no row %d; the rows are 1 to %d"):format(row, #sweep.rows), "rows")
      end
      row = sweep.rows[row]
    end
    if type(row) ~= "table" or type(core.peek(row, "scene_hash")) ~= "string" then
      core.fail("takes rows of the sweep, or their numbers", "rows")
    end
    hashes[i] = row.scene_hash
  end
  return hashes
end

--- Records rows' own scenes, with the method and step that their sweep has chosen.
methods.record = core.wrap(function(self, given)
  local sweep = contents(self) or core.fail "is a method of a sweep: write sweep:record { ... }, with a colon"
  local t = core.check("sweep:record", given)
  if not sweep.rows then core.fail "this sweep has not run; call sweep:run() first" end
  if (t.rows == nil) == (t.replay == nil) then
    core.fail("give rows, or replay = \"typical\" or \"extremes\"", "rows")
  end
  return core.record_rows(sweep.name, t.rows and hashes_of(sweep, t.rows) or t.replay, t.frames)
end)

local function sweep(given)
  local t = core.check("sweep", given)
  if not t.name:match "^[%w_%-]+$" then
    core.fail(("'name' must be letters, digits, _ and -, is '%s'"):format(t.name), "name")
  end
  local over, factors = designs.of(t.over)
  local names = checked_names(over, factors, t.samples)
  for name, unit in pairs(t.units) do
    if not over[name] then
      core.fail(("'units' names '%s', which is not among 'over'"):format(tostring(name)), "units")
    end
    if type(unit) ~= "string" then core.fail(("units.%s must be a text, is a %s"):format(name, type(unit)), "units") end
  end
  local self = setmetatable({}, Sweep)
  held[self] = { name = t.name, scene = t.scene, over = over, factors = factors, names = names, units = t.units,
    by_error = rounds.checked(t) }
  return self
end

return { sweep = sweep, contents = contents, scene_at = scene_at }
