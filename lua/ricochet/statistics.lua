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

--- The value below which a share of sorted numbers lies, between two of them in proportion.
function statistics.quantile(sorted, share)
  local place = 1 + share * (#sorted - 1)
  local below = math.floor(place)
  local low, high = sorted[below], sorted[math.min(below + 1, #sorted)]
  return low + (place - below) * (high - low)
end

--- The standard error of a statistic by what it is without each unit in turn. [Efron & Stein 1981]
function statistics.jackknife(others)
  local mean, square = 0, 0
  for _, other in ipairs(others) do mean = mean + other / #others end
  for _, other in ipairs(others) do square = square + (other - mean) ^ 2 end
  return #others > 1 and math.sqrt((#others - 1) / #others * square) or 0 / 0
end

--- Whether a row counts: one that finished, or that is of a series, whose rows have no status.
function statistics.is_data(row)
  local status = core.peek(row, "status")
  return status == nil or status == "finished"
end

--- The means of a column over the rows that count of each unit, by key_of(row, i): { [key] = mean }; the keys in their
--- order; how many rows.
function statistics.unit_means(rows, column, key_of)
  local sums, keys, count = {}, {}, 0
  for i, row in ipairs(rows) do
    local value = row[column]
    if value == value and statistics.is_data(row) then
      local key = key_of(row, i)
      if not sums[key] then
        sums[key] = { 0, 0 }
        keys[#keys + 1] = key
      end
      sums[key][1], sums[key][2], count = sums[key][1] + value, sums[key][2] + 1, count + 1
    end
  end
  local means = {}
  for key, sum in pairs(sums) do means[key] = sum[2] == 1 and sum[1] or sum[1] / sum[2] end
  return means, keys, count
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
  if not has_pairs(rows) then
    local of = statistics.of_finished(rows, column)
    of.units = of.count
    return of
  end
  local function pair_of(row, i) return core.peek(row, "pair") or -i end
  local means, keys, count = statistics.unit_means(rows, column, pair_of)
  local values = {}
  for i, key in ipairs(keys) do values[i] = means[key] end
  local of = statistics.of(values)
  of.count, of.units = count, of.count
  return of
end

--- The same of a column of the finished rows.
function statistics.of_finished(rows, column)
  local values = {}
  for _, row in ipairs(rows) do
    if statistics.is_data(row) then values[#values + 1] = row[column] end
  end
  return statistics.of(values)
end

return statistics
