-- ricochet.plot: means with standard errors, lines of theory and published points, drawn by gnuplot; the script it used
-- stays beside the picture.
local core = require "ricochet.core"
local gnuplot = require "ricochet.gnuplot"
local outcomes = require "ricochet.outcomes"
local rows_module = require "ricochet.rows"
local summarise = rows_module.summarise

local colours, quoted = gnuplot.colours, gnuplot.quoted
local plot_data = require "ricochet.plot_data"
local words = require "ricochet.words"
local axes = require "ricochet.axes"
local given_range, widen, roomy = axes.given_range, axes.widen, axes.roomy
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
local function is_series(rows) return rows and #rows > 0 and core.peek(rows[1], "status") == nil end

-- That which the column has in these rows.
local function unit_of(column, rows)
  if not is_series(rows) then return outcomes.units(rows and rows[1] and core.peek(rows[1], "units"))[column] end
  for _, quantity in ipairs(core.quantities(core.peek(rows[1], "units"))) do
    if quantity.name == column then return quantity.unit end
  end
end

local function unit_in(column, rows)
  return unit_of(column, rows) or rows and rows_module.unit_of(rows, column) or ""
end

-- `power`: of ten, in which the axis is told.
local function label(column, rows, log, power)
  local unit = axes.scaled_unit((unit_in(column, rows):gsub("m0", "m_0")), power or 0)
  return words.label(column) .. (unit ~= "" and (" [" .. unit .. "]") or "") .. (log and " (log)" or "")
end

-- The power of ten in which the axis of a column is told, and what stands behind a number of it that is told so.
local function power_of(column, rows, low, high, log)
  local unit = unit_in(column, rows)
  local power = axes.power_of(low, high, unit, log)
  return power, axes.told_unit(unit, power)
end

-- "μ = 0.3", or a text as it is.
local function value_named(by, value)
  if type(value) == "string" then return value end
  return ("%s = %s"):format(words.symbol(by), type(value) == "number" and ("%.6g"):format(value) or tostring(value))
end

-- The rows of each combination of values of the columns `by`, in rising order, with a name; all of them without any.
local function series_of(rows, by)
  if not by then return { { rows = rows } } end
  local list = {}
  for _, group in ipairs(summarise(rows, by, {}, { by = "by" })) do
    local wanted, names = {}, {}
    for i, column in ipairs(by) do
      wanted[column] = group[column]
      names[i] = value_named(column, group[column])
    end
    list[#list + 1] = { rows = rows:where(wanted), name = table.concat(names, ", ") }
  end
  return list
end

-- How far points of series k stand from their x, where several series have one at the same x and lie on each other:
-- { k = text of x as gnuplot has it }.
local function dodged(t, list, xs, ys)
  local places, crowded = {}, false
  for k, series in ipairs(list) do
    for _, row in ipairs(series.summary) do
      local there = places[row[t.x]] or {}
      places[row[t.x]] = there
      for i, column in ipairs(t.y) do
        local s, height = row[column], t.log:find "y" and math.log or function(y) return y end
        local span, bar = height(ys[i].high) - height(ys[i].low), s.count > 1 and s.se or 0
        local low, high = height(s.mean - bar) - 0.015 * span, height(s.mean + bar) + 0.015 * span
        if t.log:find "y" and s.mean - bar <= 0 then low = -math.huge end
        for _, other in ipairs(there) do
          crowded = crowded or other.i == i and other.k ~= k and low < other.high and other.low < high
        end
        there[#there + 1] = { i = i, k = k, low = low, high = high }
      end
    end
  end
  local sorted, along, share = {}, t.log:find "x" and function(x) return math.log(x) end or function(x) return x end,
    0.012
  for x in pairs(places) do sorted[#sorted + 1] = along(x) end
  table.sort(sorted)
  local range = along(xs.high) - along(xs.low)
  for i = 2, #sorted do share = math.min(share, 0.6 * (sorted[i] - sorted[i - 1]) / range / #list) end
  local texts, side = {}, crowded and range > 0 and (#list - 1) / 2 * share * range or 0
  if not t.xrange then
    if t.log:find "x" then widen(xs, xs.low / math.exp(side), xs.high * math.exp(side))
    else widen(xs, xs.low - side, xs.high + side) end
  end
  for k in ipairs(list) do
    local shift = crowded and range > 0 and (k - (#list + 1) / 2) * share * range or 0
    texts[k] = shift == 0 and "1" or t.log:find "x" and ("($1*%.8g)"):format(math.exp(shift))
      or ("($1%+.8g)"):format(shift)
  end
  return texts, crowded and range > 0
end

-- What tells series k from the others: colour, then filled or open marks, then another mark of the colour. The key
-- shows no dashes.
local function look_of(k, by)
  local round = (k - 1) // #colours
  local filled, open = { 7, 5, 9, 11, 13, 15 }, { 4, 8, 6, 12, 14, 10 }
  local marks = round % 2 == 0 and filled or open
  local shape = marks[(k - 1 + round // 2) % #marks + 1]
  return quoted(colours[(k - 1) % #colours + 1]), by and shape or 7, round % 5 + 1
end

-- What gnuplot plots in panel i.
local function parts_of(t, i, list, theory, published, at)
  local parts, column = {}, t.y[i]
  local function title(name) return name and "title " .. quoted(name) .. " noenhanced" or "notitle" end
  for k, entry in ipairs(theory[column] or {}) do
    local colour, dash = table.unpack(dashes[(k - 1) % #dashes + 1])
    parts[#parts + 1] = ("$theory%d_%d using 1:2 with lines dt %d lw 2 lc rgb '%s' %s"):format(i, k, dash, colour,
      title(entry.name))
  end
  for k, series in ipairs(list) do
    local colour, shape, dash = look_of(t.by and k or i, t.by)
    if is_series(t.rows) then
      parts[#parts + 1] = ("$data%d using 1:%d with lines dt %d lw 1.5 lc rgb %s %s"):format(k, 2 * i, dash, colour,
        title(i == 1 and series.name or nil))
      goto continue
    end
    if t.samples then
      parts[#parts + 1] = ("$samples%d using 1:%d with points pt 7 ps 0.35 lc rgb '#a0a0a8' %s"):format(k, i + 1,
        title(i == 1 and k == 1 and "single impacts" or nil))
    end
    local bars = ("$data%d using %s:%d:%d with yerrorbars pt %d ps 0.8 lw 1.5"):format(k, at[k], 2 * i, 2 * i + 1,
      shape)
    parts[#parts + 1] = ("%s lc rgb %s %s"):format(bars, colour, title(i == 1 and series.name or nil))
    if not theory[column] or t.by then
      parts[#parts + 1] = ("$data%d using %s:%d with lines dt %d lw 1 lc rgb %s notitle"):format(k, at[k], 2 * i,
        dash, colour)
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
    if t.nothing then ys[i] = { low = 1, high = 10 } end
    if t.log:find "y" and (ys[i].low > ys[i].high or ys[i].low <= 0) then
      core.fail(("'log' along y needs values above 0, and %s has none"):format(column), "log")
    end
    if ys[i].low > ys[i].high then ys[i] = { low = 0, high = 1 } end
  end
end

-- The line above the panels, and those below them.
local function texts_of(t, finished, failed, samples, side_by_side)
  local below = t.caption and wrapped(t.caption, 100) or {}
  local function add(text) for _, line in ipairs(wrapped(text, 100)) do below[#below + 1] = line end end
  local impacts = samples > 1 and "mean and standard error of %d impacts, %d failed"
    or "%d impacts, one a point, %d failed"
  if t.rows and not is_series(t.rows) then
    local over = rows_module.averaged(t.rows, { t.x, table.unpack(t.by or {}) })
    add(impacts:format(finished, failed) .. (samples > 1 and over ~= "" and "; averaged over " .. over or "")
      .. (side_by_side and "; points of the same x stand side by side" or ""))
  end
  return t.title, below
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

-- An axis of a panel: its range, ticks and label. own: a label of the user's.
local function add_axis(script, t, axis, column, range, room, own)
  local log = t.log:find(axis) ~= nil
  local low, high = roomy(range.low, range.high, room, log)
  local power = power_of(column, t.rows, range.low, range.high, log)
  script:add("set %srange [%.17g:%.17g]", axis, low, high)
  script:add(log and axes.log_tics(axis, range.low, range.high, power) or axes.tics(axis, low, high, power))
  local text = own and gnuplot.text(own) .. axes.marks_in(power) or label(column, t.rows, log, power)
  script:add("set %slabel %s %s", axis, quoted(text), own and "noenhanced" or "enhanced")
end

-- Panel i, of one column. The same margins and range along x in every panel.
local function add_panel(script, t, i, xs, y, margin, parts)
  local column = t.y[i]
  script:add("set lmargin %d", margin)
  add_axis(script, t, "x", t.x, xs, t.xrange and 0 or 0.04, t.xlabel)
  if i < #t.y then script:add "set xlabel ''" end
  add_axis(script, t, "y", column, y, t.yrange[column] and 0 or 0.08, t.ylabel[column])
  local none = t.nothing or t.rows and t.empty[column]
  if none then script:add("set label 2 %s at graph 0.5,0.5 center font ',14'", quoted(none)) end
  if t.nothing then script:add "unset ytics" end
  script:add("plot " .. (t.nothing and "NaN notitle" or parts))
  if none then script:add "unset label 2\nset ytics nomirror" end
end

local function plot(given)
  local t = core.check("plot", given)
  if type(t.by) == "string" then t.by = { t.by } end
  local script = gnuplot.script(t.name)
  local theory = plot_data.entries_of(t, "theory", t.theory_name)
  local published = plot_data.entries_of(t, "published", "published")
  check_columns(t)
  local list = t.rows and series_of(t.rows, t.by) or {}
  for _, series in ipairs(list) do
    series.summary = is_series(t.rows) and plot_data.points_of(series.rows, t.x, t.y)
      or summarise(series.rows, { t.x }, t.y, { by = "x", of = "y" })
  end
  if core.is_check() then return end
  if t.rows and (#list == 0 or #list[1].summary == 0) then core.fail "there are no rows to plot" end
  if t.rows and type(list[1].summary[1][t.x]) ~= "number" then
    core.fail(("'x' must be a column of numbers, '%s' is not"):format(t.x), "x")
  end
  local xs, ys = { low = math.huge, high = -math.huge }, {}
  for i in ipairs(t.y) do ys[i] = { low = math.huge, high = -math.huge } end
  local finished, failed, samples = plot_data.write_series(t, list, script, xs, ys)
  t.samples = t.samples and t.rows and not is_series(t.rows) or false
  if t.samples then plot_data.write_samples(t, list, script, ys) end
  if t.rows and finished == 0 then
    t.nothing = ("no finished row: of %d impacts %d failed"):format(failed, failed)
    xs = finish_xrange(t, xs, {}, {})
    theory, published = {}, {}
  end
  t.empty = {}
  for i, column in ipairs(t.y) do
    if ys[i].low > ys[i].high then t.empty[column] = "no row has a number above 0, or any, here" end
  end
  xs = finish_xrange(t, xs, published, theory)
  t.curves = {}
  -- Where theory diverges it leaves the picture: beside rows, the range is that of the impacts and published points and
  -- at most half as much on either side.
  plot_data.write_entries(t, "published", published, script, xs, ys, math.huge)
  plot_data.write_entries(t, "theory", theory, script, xs, ys, t.rows and 0.5 or math.huge)
  finish_yranges(t, ys)
  -- Rows that a script made itself belong to no scene.
  local hash = t.rows and not is_series(t.rows) and core.peek(t.rows[1], "scene_hash")
  if hash then core.plotted(hash, t.x, t.y, t.curves) end
  local at, side_by_side = {}, false
  if t.by and not is_series(t.rows) and not t.nothing then
    at, side_by_side = dodged(t, list, xs, ys)
  else
    for k in ipairs(list) do at[k] = "1" end
  end
  local title, below = texts_of(t, finished, failed, samples, side_by_side)
  local margin = 11  -- of characters; ticks that differ in the fourth digit or later need more
  for _, y in ipairs(ys) do
    if math.max(math.abs(y.low), math.abs(y.high)) > 100 * (y.high - y.low) and y.high > y.low then margin = 15 end
  end
  -- Many lines have their key at the side, a line each.
  local entries, longest = most_entries(t, list, theory, published), 0
  for _, series in ipairs(list) do longest = math.max(longest, utf8.len(series.name or "") or 0) end
  local beside = t.by and #list > 6
  local each = beside and math.max(285, 110 + 19 * entries) or 285 + 18 * entries
  script:panels {
    count = #t.y, width = beside and 860 + 8 * longest or 800, font = 12,
    key = beside and ("outside right top vertical Left reverse samplen 2\nset rmargin %d"):format(longest + 8)
      or "outside top left horizontal Left reverse samplen 2",
    panel = each, title = title and quoted(title) or "''", has_title = title ~= nil, below = below,
    axes = t.log ~= "none" and "set logscale " .. t.log .. "\nset format " .. t.log .. " '%g'" or nil,
    draw = function(place)
      for i in ipairs(t.y) do
        place(i)
        add_panel(script, t, i, xs, ys[i], margin, parts_of(t, i, list, theory, published, at))
      end
    end,
  }
  script:draw()
end

-- What other pictures of rows share.
return { plot = plot, wrapped = wrapped, label = label, power_of = power_of, groups = series_of }
