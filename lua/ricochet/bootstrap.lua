-- Errors by drawing the numbers that one has again and again: of any statistic, and of where a mean is greatest.
-- [Efron 1979, Ann. Statist. 7, 1]
local core = require "ricochet.core"
local statistics = require "ricochet.statistics"

local bootstrap = {}

local function mean(values) return statistics.of(values).mean end

local nothing = { value = 0 / 0, se = 0 / 0, low = 0 / 0, high = 0 / 0 }

--- statistic(list) of `values`, with its standard error and interval by resamples of as many: { value =, se =, low =,
--- high =, count =, reason = }. Values that are undefined are left out.
function bootstrap.of(values, statistic, resamples, seed, share)
  local given = {}
  for _, value in ipairs(values) do
    if value == value then given[#given + 1] = value end
  end
  local result = { count = #given, reason = "" }
  for name, value in pairs(nothing) do result[name] = value end
  if #given > 0 then result.value = statistic(given) end
  if #given < 2 then
    result.reason = ("%d values have no scatter to draw from"):format(#given)
    return result
  end
  local draw, places, drawn, list = core.draws(seed), {}, {}, {}
  for k = 1, resamples do
    draw(places, #given)
    for i, place in ipairs(places) do list[i] = given[place] end
    drawn[k] = statistic(list)
    if type(drawn[k]) ~= "number" or drawn[k] ~= drawn[k] then
      result.reason = "the statistic is undefined (nan) in a resample"
      return result
    end
  end
  table.sort(drawn)
  result.se = statistics.of(drawn).sd
  result.low, result.high = statistics.quantile(drawn, (1 - share) / 2), statistics.quantile(drawn, (1 + share) / 2)
  return result
end

-- [unit][place] mean of the column over the rows of a unit at a value of x, nil without; values of x in rising order.
local function table_of(rows, x, of, unit)
  local places, at, units, list = {}, {}, {}, {}
  for _, row in ipairs(rows) do
    if statistics.is_data(row) and row[of] == row[of] then
      local place, key = row[x], row[unit]
      if not at[place] then places[#places + 1], at[place] = place, {} end
      if not units[key] then
        units[key] = {}
        list[#list + 1] = units[key]
      end
      table.insert(at[place], row)
    end
  end
  table.sort(places)
  for k, place in ipairs(places) do
    local means = statistics.unit_means(at[place], of, function(row) return row[unit] end)
    for key, value in pairs(means) do units[key][k] = value end
  end
  return list, places
end

-- Means that differ by no more than their rounding are equal.
local function exceeds(a, b) return a - b > 1e-12 * math.max(math.abs(a), math.abs(b)) end

-- Place and mean of the greatest mean over the units that `draw(i)` names, and all means; nothing where none is.
local function greatest(units, count, draw)
  local best, best_mean, means
  means = {}
  for k = 1, count do
    local sum, n = 0, 0
    for i = 1, #units do
      local value = units[draw(i)][k]
      if value then sum, n = sum + value, n + 1 end
    end
    means[k] = n > 0 and sum / n or 0 / 0
    if n > 0 and (not best or exceeds(means[k], best_mean)) then best, best_mean = k, means[k] end
  end
  return best, best_mean, means
end

--- Where the mean of a column is greatest over x, by resamples of whole units: see rows:peak.
function bootstrap.peak(rows, x, of, unit, resamples, seed, share)
  local units, places = table_of(rows, x, of, unit)
  local result = { at = 0 / 0, value = 0 / 0, low = 0 / 0, high = 0 / 0, inside = 0 / 0, units = #units, reason = "",
    shares = {} }
  if #units < 2 or #places < 2 then
    result.reason = ("%d units at %d values of %s tell of no peak"):format(#units, #places, x)
    return result
  end
  local best, value, means = greatest(units, #places, function(i) return i end)
  result.value = value
  for k = best + 1, #places do
    if means[k] == means[k] and not exceeds(value, means[k]) then
      result.reason = ("the means at %s = %g and %g are equal: no place is the greatest"):format(x, places[best],
        places[k])
      return result
    end
  end
  result.at = places[best]
  local draw, named, drawn, times = core.draws(seed), {}, {}, {}
  for k = 1, resamples do
    draw(named, #units)
    local place = greatest(units, #places, function(i) return named[i] end)
    drawn[k], times[place] = places[place], (times[place] or 0) + 1
  end
  table.sort(drawn)
  -- A place is none of those between: the outermost that hold the share.
  local left = math.floor((1 - share) / 2 * resamples)
  result.low, result.high = drawn[left + 1], drawn[resamples - left]
  result.inside = 1 - ((times[1] or 0) + (times[#places] or 0)) / resamples
  for k, at in ipairs(places) do
    result.shares[k] = { [x] = at, mean = means[k], share = (times[k] or 0) / resamples }
  end
  return result
end

--- ricochet.bootstrap
function bootstrap.call(given)
  local t = core.check("bootstrap", given)
  local values = {}
  for i = 1, #t.values do
    if type(t.values[i]) ~= "number" then
      core.fail(("'values' must be numbers, element %d is a %s"):format(i, type(t.values[i])), "values")
    end
    values[i] = t.values[i]
  end
  local function statistic(list)
    local value = t.of(list)
    if type(value) ~= "number" then
      core.fail(("'of' must return a number, returned a %s"):format(type(value)), "of")
    end
    return value
  end
  return core.strict(bootstrap.of(values, t.of and statistic or mean, t.resamples, t.seed, t.share),
    "the table of a bootstrap")
end

return bootstrap
