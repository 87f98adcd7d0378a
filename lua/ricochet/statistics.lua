-- Means and deviations, as everything in this library takes them.
local core = require "ricochet.core"

local statistics = {}

--- Mean, sample standard deviation, standard error and count of numbers; undefined ones (nan) are left out.
--- [Welford 1962]
function statistics.of(values)
  local n, mean, square = 0, 0, 0
  for _, value in ipairs(values) do
    if value == value then
      n = n + 1
      local delta = value - mean
      mean = mean + delta / n
      square = square + delta * (value - mean)
    end
  end
  if n == 0 then return { mean = 0 / 0, sd = 0 / 0, se = 0 / 0, count = 0 } end
  local sd = n > 1 and math.sqrt(square / (n - 1)) or 0 / 0
  return { mean = mean, sd = sd, se = sd / math.sqrt(n), count = n }
end

local function has_pairs(rows)
  for _, row in ipairs(rows) do
    if core.peek(row, "pair") ~= nil then return true end
  end
  return false
end

--- The same of a column of finished rows, in which a lattice struck from both sides (equal `pair`) is one unit, its
--- mean: `count` impacts, `units`, and the deviation and standard error of those.
function statistics.of_units(rows, column)
  local sums, order, count = {}, {}, 0
  if not has_pairs(rows) then
    local of = statistics.of_finished(rows, column)
    of.units = of.count
    return of
  end
  for i, row in ipairs(rows) do
    local value, status = row[column], core.peek(row, "status")
    if value == value and (status == nil or status == "finished") then
      local key = core.peek(row, "pair") or -i
      if not sums[key] then
        sums[key] = { 0, 0 }
        order[#order + 1] = key
      end
      sums[key][1], sums[key][2], count = sums[key][1] + value, sums[key][2] + 1, count + 1
    end
  end
  local values = {}
  for i, key in ipairs(order) do values[i] = sums[key][2] == 1 and sums[key][1] or sums[key][1] / sums[key][2] end
  local of = statistics.of(values)
  of.count, of.units = count, of.count
  return of
end

--- The same of a column of the finished rows; those of a series have no status.
function statistics.of_finished(rows, column)
  local values = {}
  for _, row in ipairs(rows) do
    local status = core.peek(row, "status")
    if status == nil or status == "finished" then values[#values + 1] = row[column] end
  end
  return statistics.of(values)
end

return statistics
