-- What changes between two values of a parameter, over the lattices that both have.
local core = require "ricochet.core"
local statistics = require "ricochet.statistics"
local student = require "ricochet.student"

-- The means of a column over each unit's rows where `by` is `value`.
local function means(rows, by, value, column, unit)
  local some = {}
  for _, row in ipairs(rows) do
    if row[by] == value then some[#some + 1] = row end
  end
  if #some == 0 then core.fail(("no row has %s = %s"):format(by, tostring(value)), "at") end
  return (statistics.unit_means(some, column, function(row) return row[unit] end))
end

--- of at at[2] less of at at[1]: { change =, se =, units =, freedom =, low =, high =, is_seen =, gain = }.
local function paired(rows, by, column, at, unit)
  if core.is_check() then
    return { change = 0, se = 0, units = 0, freedom = 0, low = 0, high = 0, is_seen = false, gain = 1 }
  end
  local first, second = means(rows, by, at[1], column, unit), means(rows, by, at[2], column, unit)
  local keys, changes, one, other = {}, {}, {}, {}
  for key in pairs(first) do
    if second[key] then keys[#keys + 1] = key end
  end
  table.sort(keys)
  for i, key in ipairs(keys) do one[i], other[i], changes[i] = first[key], second[key], second[key] - first[key] end
  if #keys < 2 then
    core.fail(("only %d lattices have both %s = %s and %s"):format(#keys, by, tostring(at[1]), tostring(at[2])), "at")
  end
  local of, freedom = statistics.of(changes), #keys - 1
  local wide = student.quantile(freedom) * of.se
  return {
    change = of.mean, se = of.se, units = #keys, freedom = freedom, low = of.mean - wide, high = of.mean + wide,
    is_seen = student.is_seen(of.mean, of.se, freedom),
    gain = (statistics.of(one).sd ^ 2 + statistics.of(other).sd ^ 2) / of.sd ^ 2,
  }
end

return paired
