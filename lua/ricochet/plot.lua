-- ricochet.plot: means with standard errors, lines of theory and published points, drawn by gnuplot; the script it used
-- stays beside the picture.
local core = require "ricochet.core"
local gnuplot = require "ricochet.gnuplot"
local rows_module = require "ricochet.rows"
local summarise, known_column = rows_module.summarise, rows_module.known_column

local colours, quoted = gnuplot.colours, gnuplot.quoted
local greek = {
  mu = "μ", beta = "β", psi1 = "Ψ_1", psi2 = "Ψ_2", tan_alpha = "tan α", e_alpha = "e_α", theta = "θ", omega = "ω",
  cot_gamma = "cot γ",
}
-- Lines of theory: shades that also differ in their dashes; published points: open marks.
local dashes = { { "#555555", 2 }, { "#000000", 1 }, { "#882255", 4 }, { "#44AA99", 3 }, { "#999933", 5 } }
local open_marks = { 6, 4, 8, 12, 10 }

-- At most `width` characters a line.
local function wrapped(text, width)
  local lines, line = {}, ""
  for word in text:gmatch "%S+" do
    if line ~= "" and utf8.len(line) + utf8.len(word) >= width then lines[#lines + 1], line = line, "" end
    line = line == "" and word or line .. " " .. word
  end
  lines[#lines + 1] = line
  return lines
end

-- Rows of a series have no status: they are drawn in their order, as a line.
local function is_series(rows) return rows and #rows > 0 and rawget(rows[1], "status") == nil end

-- That which the column has in these rows.
local function unit_of(column, rows)
  if not is_series(rows) then return core.columns(rows and rows[1] and rawget(rows[1], "units"))[column] end
  for _, quantity in ipairs(core.quantities(rawget(rows[1], "units"))) do
    if quantity.name == column then return quantity.unit end
  end
end

local function label(column, rows)
  local unit = unit_of(column, rows)
  return (greek[column] or column:gsub("_", "\\_")) .. (unit and unit ~= "" and (" [" .. unit .. "]") or "")
end

-- The rows of each value of column `by`, in rising order, with a name; all of them if no column is given.
local function series_of(rows, by)
  if not by then return { { rows = rows } } end
  local list = {}
  for _, group in ipairs(summarise(rows, by, {}, { by = "by" })) do
    local value = group[by]
    local shown = type(value) == "number" and ("%.6g"):format(value) or tostring(value)
    local name = type(value) == "string" and value or ("%s = %s"):format(greek[by] or by, shown)
    list[#list + 1] = { rows = rows:where { [by] = value }, name = name }
  end
  return list
end

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

-- A list of { name =, f = } or { name =, points = } for each column of `t[field]`. A function or a list of points alone
-- is one entry.
local function entries_of(t, field, initial_name)
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

-- A range {low, high} of the user's.
local function given_range(range, field, ...)
  local is_pair = type(range) == "table" and type(range[1]) == "number" and type(range[2]) == "number"
  if not is_pair or range[1] >= range[2] then core.fail(("'%s' takes { from, to }"):format(field), field, ...) end
  return { low = range[1], high = range[2] }
end

local function widen(range, low, high) range.low, range.high = math.min(range.low, low), math.max(range.high, high) end

-- The data of simulated series as gnuplot's $data1, $data2 ...; widens the ranges. Returns how many impacts finished
-- and failed, and the most at one point.
local function write_series(t, list, script, xs, ys)
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

-- The data of lines and marks, as $theory1_2 (column 1, entry 2) and so on. They widen the range along y, by no more
-- than `most` of it on either side.
local function write_entries(t, kind, entries, script, xs, ys, most)
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
      local lines = {}
      local function put(x, y)
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

-- Room around the first and last point, also where there is only one.
local function roomy(low, high, share, log)
  if log then
    local factor = high > low and (high / low) ^ share or 2
    return ("[%.17g:%.17g]"):format(low / factor, high * factor)
  end
  local room = high > low and share * (high - low) or math.max(0.5, math.abs(low) / 2)
  return ("[%.17g:%.17g]"):format(low - room, high + room)
end

-- Along a logarithmic axis of less than three decades 1, 2 and 5 of each are marked; gnuplot's own ticks might be one
-- or none.
local function log_tics(log, axis, low, high)
  if not log:find(axis) then return "" end
  if high / low > 1e3 then return ("\nset %stics autofreq"):format(axis) end
  local tics = {}
  local steps = high / low > 4 and { 1, 2, 5 } or { 1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9 }
  if high / low < 1.3 then steps = {} for k = 20, 199 do steps[#steps + 1] = k / 20 end end
  for decade = math.floor(math.log(low, 10)) - 1, math.floor(math.log(high, 10)) + 1 do
    for _, step in ipairs(steps) do tics[#tics + 1] = ("%.6g"):format(step * 10 ^ decade) end
  end
  return ("\nset %stics (%s)"):format(axis, table.concat(tics, ", "))
end

-- What gnuplot plots in panel i.
local function parts_of(t, i, list, theory, published)
  local parts, column = {}, t.y[i]
  local function title(name) return name and "title " .. quoted(name) .. " noenhanced" or "notitle" end
  for k, entry in ipairs(theory[column] or {}) do
    local colour, dash = table.unpack(dashes[(k - 1) % #dashes + 1])
    parts[#parts + 1] = ("$theory%d_%d using 1:2 with lines dt %d lw 2 lc rgb '%s' %s"):format(i, k, dash, colour,
      title(entry.name))
  end
  for k, series in ipairs(list) do
    local colour = quoted(colours[((t.by and k or i) - 1) % #colours + 1])
    if is_series(t.rows) then
      parts[#parts + 1] = ("$data%d using 1:%d with lines lw 1.5 lc rgb %s %s"):format(k, 2 * i, colour,
        title(i == 1 and series.name or nil))
      goto continue
    end
    local shape = t.by and ({ 7, 5, 9, 11, 13, 15 })[(k - 1) % 6 + 1] or 7  -- filled shapes, beside colour
    local bars = ("$data%d using 1:%d:%d with yerrorbars pt %d ps 0.8 lw 1.5"):format(k, 2 * i, 2 * i + 1, shape)
    parts[#parts + 1] = ("%s lc rgb %s %s"):format(bars, colour, title(i == 1 and series.name or nil))
    if not theory[column] or t.by then
      parts[#parts + 1] = ("$data%d using 1:%d with lines lw 1 lc rgb %s notitle"):format(k, 2 * i, colour)
    end
    ::continue::
  end
  for k, entry in ipairs(published[column] or {}) do
    local mark = open_marks[(k - 1) % #open_marks + 1]
    local points = ("$published%d_%d using 1:2 with points pt %d ps 1.2 lw 1.5"):format(i, k, mark)
    parts[#parts + 1] = ("%s lc rgb '#000000' %s"):format(points, title(entry.name))
  end
  return table.concat(parts, ", \\\n     ")
end

-- Tables by column name only columns that are drawn.
local function check_columns(t)
  for field, table_of in pairs { yrange = t.yrange, ylabel = t.ylabel } do
    for column in pairs(table_of) do
      local drawn = false
      for _, name in ipairs(t.y) do drawn = drawn or name == column end
      if not drawn then
        core.fail(("'%s' names '%s', which is not among 'y'"):format(field, tostring(column)), field)
      end
    end
  end
  if t.by and not t.rows then core.fail("'by' groups rows, and there are none", "by") end
end

-- The range along x: that of rows and points, unless it is given.
local function finish_xrange(t, xs, published, theory)
  for _, entries in ipairs(t.rows and { published } or { published, theory }) do
    for _, column in pairs(entries) do
      for _, entry in ipairs(column) do
        for _, point in ipairs(entry.points or {}) do widen(xs, point[1], point[1]) end
      end
    end
  end
  if t.xrange then xs = given_range(t.xrange, "xrange") end
  if xs.low > xs.high then core.fail "has neither rows nor points; give xrange = { from, to } for the functions" end
  if t.log:find "x" and xs.low <= 0 then
    core.fail(("'log' along x needs values above 0, %s goes down to %g"):format(t.x, xs.low), "log")
  end
  return xs
end

local function finish_yranges(t, ys)
  for i, column in ipairs(t.y) do
    if t.yrange[column] then ys[i] = given_range(t.yrange[column], "yrange", column) end
    if t.log:find "y" and (ys[i].low > ys[i].high or ys[i].low <= 0) then
      core.fail(("'log' along y needs values above 0, and %s has none"):format(column), "log")
    end
    if ys[i].low > ys[i].high then ys[i] = { low = 0, high = 1 } end
  end
end

-- The lines above the panels.
local function titles_of(t, finished, failed, samples)
  local titles = {}
  if t.title then titles[1] = quoted(t.title) end
  for _, line in ipairs(t.caption and wrapped(t.caption, 92) or {}) do titles[#titles + 1] = quoted(line) end
  local impacts = samples > 1 and "mean and standard error of %d impacts, %d failed"
    or "%d impacts, one a point, %d failed"
  if t.rows and not is_series(t.rows) then titles[#titles + 1] = quoted(impacts:format(finished, failed)) end
  return titles
end

-- The most entries of a key; it stands above its panel.
local function most_entries(t, list, theory, published)
  local most = 1
  for i, column in ipairs(t.y) do
    local series = i == 1 and t.by and #list or 0
    most = math.max(most, #(theory[column] or {}) + #(published[column] or {}) + series)
  end
  return most
end

-- Panel i, of one column. The same margins and range along x in every panel.
local function add_panel(script, t, i, xs, y, margin, parts)
  local column = t.y[i]
  local xroom, yroom = t.xrange and 0 or 0.04, t.yrange[column] and 0 or 0.08
  script:add("set lmargin %d\nset xrange %s", margin, roomy(xs.low, xs.high, xroom, t.log:find "x"))
  script:add("set yrange %s%s%s", roomy(y.low, y.high, yroom, t.log:find "y"), log_tics(t.log, "x", xs.low, xs.high),
    log_tics(t.log, "y", y.low, y.high))
  local xlabel = i == #t.y and quoted(t.xlabel or label(t.x, t.rows)) or "''"
  script:add("set xlabel %s%s", xlabel, t.xlabel and " noenhanced" or " enhanced")
  local ylabel = quoted(t.ylabel[column] or label(column, t.rows))
  script:add("set ylabel %s%s", ylabel, t.ylabel[column] and " noenhanced" or " enhanced")
  script:add("plot " .. parts)
end

-- The points of a series, in their order, each as a group of its own.
local function points_of(rows, x, y)
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

local function plot(given)
  local t = core.check("plot", given)
  local script = gnuplot.script(t.name)
  local theory, published = entries_of(t, "theory", t.theory_name), entries_of(t, "published", "published")
  check_columns(t)
  local list = t.rows and series_of(t.rows, t.by) or {}
  for _, series in ipairs(list) do
    series.summary = is_series(t.rows) and points_of(series.rows, t.x, t.y)
      or summarise(series.rows, t.x, t.y, { by = "x", of = "y" })
  end
  if core.is_check() then return end
  if t.rows and (#list == 0 or #list[1].summary == 0) then core.fail "there are no rows to plot" end
  if t.rows and type(list[1].summary[1][t.x]) ~= "number" then
    core.fail(("'x' must be a column of numbers, '%s' is not"):format(t.x), "x")
  end
  local xs, ys = { low = math.huge, high = -math.huge }, {}
  for i in ipairs(t.y) do ys[i] = { low = math.huge, high = -math.huge } end
  local finished, failed, samples = write_series(t, list, script, xs, ys)
  xs = finish_xrange(t, xs, published, theory)
  -- Where theory diverges it leaves the picture: beside rows, the range is that of the impacts and published points and
  -- at most half as much on either side.
  write_entries(t, "published", published, script, xs, ys, math.huge)
  write_entries(t, "theory", theory, script, xs, ys, t.rows and 0.5 or math.huge)
  finish_yranges(t, ys)
  local titles = titles_of(t, finished, failed, samples)
  local margin = 11  -- of characters; ticks that differ in the fourth digit or later need more
  for _, y in ipairs(ys) do
    if math.max(math.abs(y.low), math.abs(y.high)) > 100 * (y.high - y.low) and y.high > y.low then margin = 15 end
  end
  script:panels {
    count = #t.y, width = 800, font = 12, key = "outside top right horizontal",
    height = 70 + 20 * #titles + (285 + 18 * most_entries(t, list, theory, published)) * #t.y,
    title = #titles > 0 and table.concat(titles, '."\\n".') or "''",
    axes = t.log ~= "none" and "set logscale " .. t.log .. "\nset format " .. t.log .. " '%g'" or nil,
    draw = function()
      for i in ipairs(t.y) do add_panel(script, t, i, xs, ys[i], margin, parts_of(t, i, list, theory, published)) end
    end,
  }
  script:draw()
end

return { plot = plot }
