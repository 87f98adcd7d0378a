-- Errors by drawing the numbers that one has again and again: of any statistic, and of where a mean is greatest.
-- [Efron 1979, Ann. Statist. 7, 1]
local core = require "ricochet.core"

local bootstrap = {}

-- The value below which a share of sorted numbers lies, between two of them in proportion.
local function quantile(sorted, share)
  local place = 1 + share * (#sorted - 1)
  local low = math.min(math.floor(place), #sorted - 1)
  if low < 1 then return sorted[1] end
  return sorted[low] + (place - low) * (sorted[low + 1] - sorted[low])
end

local function mean(values)
  local sum = 0
  for _, value in ipairs(values) do sum = sum + value end
  return sum / #values
end

local nothing = { value = 0 / 0, se = 0 / 0, low = 0 / 0, high = 0 / 0 }

-- Mean square about the mean, and the quantiles that leave (1 - share)/2 on either side.
local function spread(drawn, share)
  local middle, square = mean(drawn), 0
  for _, value in ipairs(drawn) do square = square + (value - middle) ^ 2 end
  table.sort(drawn)
  return math.sqrt(square / (#drawn - 1)), quantile(drawn, (1 - share) / 2), quantile(drawn, (1 + share) / 2)
end

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
  local draws, drawn, list = core.draws(seed, resamples * #given, #given), {}, {}
  for k = 1, resamples do
    for i = 1, #given do list[i] = given[draws[(k - 1) * #given + i]] end
    drawn[k] = statistic(list)
    if type(drawn[k]) ~= "number" or drawn[k] ~= drawn[k] then
      result.reason = "the statistic is undefined (nan) in a resample"
      return result
    end
  end
  result.se, result.low, result.high = spread(drawn, share)
  return result
end

-- [unit][place] mean of the column over the finished rows of a unit at a value of x, nil without; values of x in rising
-- order.
local function table_of(rows, x, of, unit)
  local places, seen, units, keys = {}, {}, {}, {}
  for _, row in ipairs(rows) do
    if row.status == "finished" and row[of] == row[of] then
      local key, at = row[unit], row[x]
      if not seen[at] then places[#places + 1], seen[at] = at, true end
      if not units[key] then keys[#keys + 1], units[key] = key, {} end
      local sum = units[key][at] or { 0, 0 }
      units[key][at], sum[1], sum[2] = sum, sum[1] + row[of], sum[2] + 1
    end
  end
  table.sort(places)
  local list = {}
  for i, key in ipairs(keys) do
    list[i] = {}
    for k, at in ipairs(places) do list[i][k] = units[key][at] and units[key][at][1] / units[key][at][2] end
  end
  return list, places
end

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
    if n > 0 and (not best or means[k] > best_mean) then best, best_mean = k, means[k] end
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
  result.at, result.value = places[best], value
  local draws, drawn, times = core.draws(seed, resamples * #units, #units), {}, {}
  for k = 1, resamples do
    local place = greatest(units, #places, function(i) return draws[(k - 1) * #units + i] end)
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
