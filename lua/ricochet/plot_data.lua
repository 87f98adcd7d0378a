-- What ricochet.plot draws: the means of rows, single impacts, and curves of theory or published points, as gnuplot's
-- tables.
local core = require "ricochet.core"
local known_column = require("ricochet.rows").known_column
local widen = require("ricochet.axes").widen

local plot_data = {}

local function is_points(v) return type(v) == "table" and type(v[1]) == "table" and type(v[1][1]) == "number" end

-- What a curve must hold; bad() tells the mistake.
local function check_entry(entry, i, field, bad)
  if type(entry) ~= "table" or type(entry.name) ~= "string" then
    bad(("must be a list of { name =, f = or points = }; entry %d has no name"):format(i))
  end
  if (type(entry.f) == "function") == is_points(entry.points) then
    bad(("needs f = function (x) or points = { {x, y}, ... } for '%s'"):format(entry.name))
  end
  if field == "published" and entry.f then bad(("takes points, and '%s' is a function"):format(entry.name)) end
  for _, point in ipairs(entry.points or {}) do
    if type(point[1]) ~= "number" or type(point[2]) ~= "number" then
      bad(("holds a point of '%s' that is not {x, y}"):format(entry.name))
    end
  end
end

--- A list of { name =, f = } or { name =, points = } for each column of `t[field]`. A function or a list of points
--- alone is one entry.
function plot_data.entries_of(t, field, initial_name)
  local result = {}
  for column, value in pairs(t[field]) do
    local function bad(message) core.fail(("'%s' of '%s' %s"):format(field, tostring(column), message), field) end
    local list = value
    if type(value) == "function" then list = { { name = initial_name, f = value } } end
    if is_points(value) then list = { { name = initial_name, points = value } } end
    if type(list) ~= "table" then
      core.fail(("'%s' takes column = function (x), '%s' is a %s; points { {x, y}, ... } "
        .. "or a list of { name =, f = or points = } will do too"):format(field, tostring(column), type(value)), field)
    end
    local drawn = false
    for _, name in ipairs(t.y) do drawn = drawn or name == column end
    if not drawn then
      core.fail(("'%s' has a curve for '%s', which is not among 'y'"):format(field, tostring(column)), field)
    end
    for i, entry in ipairs(list) do check_entry(entry, i, field, bad) end
    result[column] = list
  end
  return result
end

--- The points of a series, in their order, each as a group of its own.
function plot_data.points_of(rows, x, y)
  local summary = {}
  known_column(rows, x, "x")
  for _, column in ipairs(y) do known_column(rows, column, "y") end
  for i, row in ipairs(rows) do
    summary[i] = { [x] = row[x], count = 1, failed = 0 }
    for _, column in ipairs(y) do
      local value = row[column]
      if type(value) ~= "number" then core.fail(("column '%s' holds no numbers"):format(column), "y") end
      summary[i][column] = { mean = value, se = 0, count = value == value and 1 or 0 }
    end
  end
  return summary
end

--- The data of simulated series as gnuplot's $data1, $data2 ...; widens the ranges. Returns how many impacts finished
--- and failed, and the most at one point.
function plot_data.write_series(t, list, script, xs, ys)
  local finished, failed, samples = 0, 0, 0
  for k, series in ipairs(list) do
    local lines = {}
    for _, row in ipairs(series.summary) do
      local cells = { ("%.17g"):format(row[t.x]) }
      widen(xs, row[t.x], row[t.x])
      for i, column in ipairs(t.y) do
        local s = row[column]
        local se = s.count > 1 and s.se or 0
        cells[#cells + 1] = s.count > 0 and ("%.17g"):format(s.mean) or "NaN"
        cells[#cells + 1] = ("%.17g"):format(se)
        if s.count > 0 then
          local log = t.log:find "y"
          if log and s.mean > 0 then widen(ys[i], math.max(s.mean - se, s.mean / 2), s.mean + se) end
          if not log then widen(ys[i], s.mean - se, s.mean + se) end
        end
        samples = math.max(samples, s.count)
      end
      finished, failed = finished + row.count, failed + row.failed
      lines[#lines + 1] = table.concat(cells, " ")
    end
    script:data("data" .. k, lines)
  end
  return finished, failed, samples
end

--- Every finished impact, as $samples1, $samples2 ...; widens the ranges.
function plot_data.write_samples(t, list, script, ys)
  for k, series in ipairs(list) do
    local lines = {}
    for _, row in ipairs(series.rows) do
      if row.status == "finished" then
        local cells = { ("%.17g"):format(row[t.x]) }
        for i, column in ipairs(t.y) do
          local value = row[column]
          cells[i + 1] = ("%.17g"):format(value)
          if value == value and not (t.log:find "y" and value <= 0) then widen(ys[i], value, value) end
        end
        lines[#lines + 1] = table.concat(cells, " ")
      end
    end
    script:data("samples" .. k, lines)
  end
end

--- The data of lines and marks, as $theory1_2 (column 1, entry 2) and so on, and as `t.curves` for the report. They
--- widen the range along y, by no more than `most` of it on either side.
function plot_data.write_entries(t, kind, entries, script, xs, ys, most)
  for i, column in ipairs(t.y) do
    local low, high = -math.huge, math.huge
    if most < math.huge and ys[i].low <= ys[i].high then
      local room = t.log:find "y" and (ys[i].high / ys[i].low) ^ most or most * (ys[i].high - ys[i].low)
      if t.log:find "y" then
        low, high = ys[i].low / room, ys[i].high * room
      else
        low, high = ys[i].low - room, ys[i].high + room
      end
    end
    for k, entry in ipairs(entries[column] or {}) do
      local lines, curve = {}, { of = column, label = entry.name, marks = kind == "published", x = {}, y = {} }
      t.curves[#t.curves + 1] = curve
      local function put(x, y)
        curve.x[#curve.x + 1], curve.y[#curve.y + 1] = x, y
        local seen = math.max(low, math.min(high, y))
        local is_drawn = y == y and math.abs(seen) < math.huge and not (t.log:find "y" and seen <= 0)
        if is_drawn then widen(ys[i], seen, seen) end
        lines[#lines + 1] = ("%.17g %.17g"):format(x, y)
      end
      for _, point in ipairs(entry.points or {}) do put(point[1], point[2]) end
      for j = 0, entry.f and 200 or -1 do
        local first, last = xs.low, xs.high
        local x = t.log:find "x" and first * (last / first) ^ (j / 200) or first + (last - first) * j / 200
        local y = entry.f(x)
        if type(y) ~= "number" then
          core.fail(("the theory of '%s' must return a number, returned a %s at x = %g"):format(column, type(y), x),
            "theory")
        end
        put(x, y)
      end
      script:data(("%s%d_%d"):format(kind, i, k), lines)
    end
  end
end

return plot_data
