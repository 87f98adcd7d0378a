-- Means and deviations, as everything in this library takes them.
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

--- The same of a column of the finished rows.
function statistics.of_finished(rows, column)
  local values = {}
  for _, row in ipairs(rows) do
    if row.status == "finished" then values[#values + 1] = row[column] end
  end
  return statistics.of(values)
end

return statistics
