-- ricochet.find: at which value of a parameter the mean of a column is a wanted one, by bisection on common lattices.
-- Every decision follows from the rows alone, so that a resumed run goes the same way.
local core = require "ricochet.core"
local outcomes = require "ricochet.outcomes"
local rows_of = require("ricochet.rows").rows_of
local statistics = require "ricochet.statistics"
local student = require "ricochet.student"
local sweeps = require "ricochet.sweep"

local most_halvings = 50
local told = 4         -- standard errors of a change that counts as a slope
local surely = 0.999   -- that a mean which turns back does so

-- The one name of `over`, and its range.
local function range_of(over)
  local name, range = next(over)
  if type(name) ~= "string" or next(over, name) ~= nil or name == "sample" then
    core.fail("'over' takes one name = { low, high }; sample counts the lattices", "over")
  end
  local numbers = type(range) == "table" and #range == 2 and math.type(range[1]) and math.type(range[2])
  if not numbers or not (range[1] < range[2]) or range[2] - range[1] == math.huge then
    core.fail(("over.%s must be { low, high }, two numbers, the lower first"):format(name), "over", name)
  end
  return name, range[1], range[2]
end

-- Places of the range where all lattices are run: { at =, scenes = }, by rising `at`.
local function with_place(search, at)
  local place = { at = at, scenes = {} }
  for sample = 1, search.samples do
    place.scenes[sample] = sweeps.scene_at(search.sweep, { [search.name] = at, sample = sample })
  end
  local k = 1
  while search.places[k] and search.places[k].at < at do k = k + 1 end
  table.insert(search.places, k, place)
end

local function run(search, stage)
  local points, scenes = {}, {}
  for _, place in ipairs(search.places) do
    for sample, scene in ipairs(place.scenes) do
      points[#points + 1], scenes[#scenes + 1] = { [search.name] = place.at, sample = sample }, scene
    end
  end
  return core.run_sweep(search.sweep.name, search.sweep.names, points, scenes, stage, search.sweep.units)
end

local function has_value(row, column) return row.status == "finished" and row[column] == row[column] end

-- Gives every place its values and their statistics, of the lattices that have one everywhere. Returns how many do.
local function compare(search, rows)
  local places, common = search.places, {}
  for sample = 1, search.samples do
    local everywhere = true
    for k = 0, #places - 1 do
      everywhere = everywhere and has_value(rows[k * search.samples + sample], search.column)
    end
    if everywhere then common[#common + 1] = sample end
  end
  if #common == 0 then
    core.fail(("not one lattice's impact has finished with a value of %s at every %s that was tried: nothing can be " ..
      "compared"):format(search.column, search.name), "column")
  end
  for k, place in ipairs(places) do
    place.values = {}
    for i, sample in ipairs(common) do
      place.values[i] = rows[(k - 1) * search.samples + sample][search.column]
    end
    place.of = statistics.of(place.values)
  end
  return #common
end

-- The change of the mean between two places, whose lattices are the same.
local function change(a, b)
  local changes = {}
  for i, value in ipairs(a.values) do changes[i] = b.values[i] - value end
  return statistics.of(changes)
end

local function refuse_turns(search)
  local places = search.places
  local rise = places[#places].of.mean - places[1].of.mean
  for k = 1, #places - 1 do
    local d = change(places[k], places[k + 1])
    local margin = d.count > 1 and student.quantile(d.count - 1, surely) * d.se or 0
    if d.mean * rise < 0 and math.abs(d.mean) > margin then
      core.fail(("the mean of %s is not monotone: from %s = %g to %g it changes by %.3g, and between %g and %g by " ..
        "%.3g, so that more than one %s may give %g; give a range in which it goes one way"):format(search.column,
        search.name, places[1].at, places[#places].at, rise, places[k].at, places[k + 1].at, d.mean, search.name,
        search.value), "over", search.name)
    end
  end
end

-- Places k and k + 1 between which the mean passes the value: the nearest two, if scatter lets it pass more than once.
local function bracket(search)
  local places, best = search.places, nil
  for k = 1, #places - 1 do
    local passes = (places[k].of.mean - search.value) * (places[k + 1].of.mean - search.value) <= 0
    local width = places[k + 1].at - places[k].at
    if passes and (not best or width < places[best + 1].at - places[best].at) then best = k end
  end
  if best then return best end
  local first, last = places[1], places[#places]
  core.fail(("the mean of %s is %.6g at %s = %g and %.6g at %g: %g does not lie between; give a range that has " ..
    "it"):format(search.column, first.of.mean, search.name, first.at, last.of.mean, last.at, search.value), "over",
    search.name)
end

-- How the mean changes around places k and k + 1: between the nearest two whose change is told from its scatter. Nil
-- if that of no two is.
local function slope_at(search, k)
  local places, nearest, slope = search.places, math.huge, nil
  for i = 1, k do
    for j = k + 1, #places do
      local d, width = change(places[i], places[j]), places[j].at - places[i].at
      local is_told = d.mean ~= 0 and (d.count < 2 or math.abs(d.mean) >= told * d.se)
      if is_told and width < nearest then nearest, slope = width, d.mean / width end
    end
  end
  return slope
end

-- Where the straight line between both sides of the bracket has the value.
local function between(a, b, value)
  if a.of.mean == b.of.mean then return (a.at + b.at) / 2 end
  return a.at + (value - a.of.mean) / (b.of.mean - a.of.mean) * (b.at - a.at)
end

local function found(search, k, count)
  local a, b = search.places[k], search.places[k + 1]
  local result = { at = between(a, b, search.value), count = count, places = #search.places, slope = 0 / 0,
    se = 0 / 0, low = 0 / 0, high = 0 / 0, reason = "", bracket = { a.at, b.at } }
  local slope = slope_at(search, k)
  result.slope = slope or result.slope
  local nearer = math.abs(a.of.mean - search.value) < math.abs(b.of.mean - search.value) and a or b
  if count < 2 then
    result.reason = "one lattice has no scatter"
  elseif not slope then
    result.reason = "the change of the mean over the whole range is not told from its scatter: more samples are needed"
  else
    result.se = nearer.of.se / math.abs(slope)
    local wide = student.quantile(count - 1) * result.se
    result.low, result.high = result.at - wide, result.at + wide
  end
  return result
end

local function tell(search, result)
  local error = result.reason == "" and ("+- %.2g "):format(result.se) or ""
  print(("%s: %s = %.6g %swhere the mean of %s is %g (%d lattices at %d values, the last two %.2g apart)%s"):format(
    search.sweep.name, search.name, result.at, error, search.column, search.value, result.count, result.places,
    result.bracket[2] - result.bracket[1], result.reason == "" and "" or "; no error: " .. result.reason))
  if result.count < search.samples then
    print(("  %d lattices are left out: their impacts did not all finish with a value"):format(
      search.samples - result.count))
  end
end

--- Where the mean of a column is the wanted one.
local function find(given)
  local t = core.check("find", given)
  outcomes.check({ t.column }, "column")
  local name, low, high = range_of(t.over)
  if t.tolerance < (high - low) / 2 ^ most_halvings then
    core.fail(("'tolerance' is less than what %d halvings of the range leave"):format(most_halvings), "tolerance")
  end
  local samples = {}
  for k = 1, t.samples do samples[k] = k end
  local sweep = sweeps.contents(sweeps.sweep { name = t.name, scene = t.scene, units = t.units,
    over = { [name] = { low, high }, sample = samples } })
  local search = { sweep = sweep, name = name, column = t.column, value = t.value, samples = t.samples, places = {} }
  with_place(search, low)
  with_place(search, high)
  if core.is_check() then
    return core.strict({ at = (low + high) / 2, se = 0, low = low, high = high, slope = 0, count = 0, places = 2,
      bracket = { low, high }, reason = "", rows = rows_of(run(search), sweep) }, "the table of a value that was found")
  end
  local k, count
  while true do
    count = compare(search, run(search, "round"))
    k = bracket(search)
    refuse_turns(search)
    local a, b = search.places[k], search.places[k + 1]
    local middle = (a.at + b.at) / 2
    if b.at - a.at <= t.tolerance or a.of.mean == t.value or b.of.mean == t.value then break end
    if middle <= a.at or middle >= b.at then break end
    with_place(search, middle)
  end
  local result = found(search, k, count)
  result.rows = rows_of(run(search, "last"), sweep)
  tell(search, result)
  return core.strict(result, "the table of a value that was found")
end

return { find = find }
