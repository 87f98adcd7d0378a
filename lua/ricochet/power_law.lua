-- The exponent of a power law, with the standard error of a jackknife over lattices.
local core = require "ricochet.core"
local statistics = require "ricochet.statistics"
local student = require "ricochet.student"

local sums_of = { "n", "x", "y", "xx", "xy" }

-- Logarithms of two columns by the values of a third, where y is defined: { { x =, y = }, ... } by unit, and how many.
local function logarithms(rows, x, y, unit)
  local units, of, count = {}, {}, 0
  for _, row in ipairs(rows) do
    local place = {}
    for _, column in ipairs { x, y } do
      local value = row[column]
      if type(value) ~= "number" then core.fail(("column '%s' holds no numbers"):format(column)) end
      if value ~= value and column == x then
        core.fail(("'%s' is undefined (nan) in a row, so that row has no place in a power law"):format(x), "x")
      end
      if value <= 0 then
        core.fail(("a power law needs values above 0, '%s' is %s in a row"):format(column, tostring(value)))
      end
      place[column] = math.log(value)
    end
    if row[y] == row[y] then
      local key = row[unit]
      if not of[key] then
        of[key] = {}
        units[#units + 1] = of[key]
      end
      table.insert(of[key], { x = place[x], y = place[y] })
      count = count + 1
    end
  end
  return units, count
end

local function middle(units, count)
  local x, y = 0, 0
  for _, unit in ipairs(units) do
    for _, p in ipairs(unit) do x, y = x + p.x / count, y + p.y / count end
  end
  return x, y
end

-- Sums over a unit, about the middle of all.
local function sums(unit, x, y)
  local s = { n = 0, x = 0, y = 0, xx = 0, xy = 0 }
  for _, p in ipairs(unit) do
    local dx, dy = p.x - x, p.y - y
    s.n, s.x, s.y, s.xx, s.xy = s.n + 1, s.x + dx, s.y + dy, s.xx + dx * dx, s.xy + dx * dy
  end
  return s
end

-- Least squares; nothing of rows that are all at one x. `scale`: the sum of squares of x of all rows.
local function slope_of(s, scale)
  if s.n < 2 then return nil end
  local xx, xy = s.xx - s.x * s.x / s.n, s.xy - s.x * s.y / s.n
  return xx > 1e-12 * scale and xy / xx or nil
end

-- The standard error of the slope, or why there is none.
local function jackknife(parts, all)
  if #parts < 2 then return nil, "all rows share one lattice: nothing tells how another would differ" end
  local others = {}
  for i, part in ipairs(parts) do
    local rest = {}
    for _, name in ipairs(sums_of) do rest[name] = all[name] - part[name] end
    others[i] = slope_of(rest, all.xx)
    if not others[i] then return nil, "the exponent hangs on one lattice, without which all rows have one x" end
  end
  return statistics.jackknife(others)
end

--- y = factor x^exponent by least squares of the logarithms of rows: { exponent =, se =, freedom =, low =, high =,
--- factor =, count =, reason = }.
local function power_law(rows, x, y, unit)
  if core.is_check() then
    return { exponent = 1, se = 0, freedom = 0, low = 1, high = 1, factor = 1, count = 0, reason = "" }
  end
  local units, count = logarithms(rows, x, y, unit)
  local mean_x, mean_y = middle(units, count)
  local parts, all = {}, { n = 0, x = 0, y = 0, xx = 0, xy = 0 }
  for i, of in ipairs(units) do
    parts[i] = sums(of, mean_x, mean_y)
    for _, name in ipairs(sums_of) do all[name] = all[name] + parts[i][name] end
  end
  local exponent = count >= 3 and slope_of(all, all.xx)
  if not exponent then
    core.fail(("a power law needs three rows or more of different '%s', there are %d"):format(x, count))
  end
  local se, reason = jackknife(parts, all)
  -- Units of a row each are known no better than the line that they share.
  local freedom = math.max(1, math.min(#parts - 1, count - 2))
  local wide = se and student.quantile(freedom) * se or 0 / 0
  return {
    exponent = exponent, se = se or 0 / 0, freedom = freedom, low = exponent - wide, high = exponent + wide,
    factor = math.exp(mean_y - exponent * mean_x), count = count, reason = reason or "",
  }
end

return power_law
