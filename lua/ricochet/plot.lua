-- ricochet.plot: means with standard errors, drawn by gnuplot; the script it used stays beside the picture.
local core = require "ricochet.core"
local summarise = require("ricochet.rows").summarise

-- Colours that the colour-blind can tell apart [Okabe & Ito 2008].
local colours = { "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9" }
local greek = { mu = "μ", beta = "β", psi1 = "Ψ_1", psi2 = "Ψ_2", tan_alpha = "tan α", e_alpha = "e_α", theta = "θ", omega = "ω" }

-- In single quotes: within double ones gnuplot runs what stands in backquotes as a shell command.
local function quoted(text)
  return "'" .. text:gsub("'", "''"):gsub("%c", " ") .. "'"
end

local function label(column)
  local unit = core.columns()[column]
  return (greek[column] or column:gsub("_", "\\_")) .. (unit and unit ~= "" and (" [" .. unit .. "]") or "")
end

-- The rows of each value of column `by`, in rising order, with a name; all of them if no column is given.
local function series_of(rows, by)
  if not by then return { { rows = rows } } end
  local list = {}
  for _, group in ipairs(summarise(rows, by, {}, { by = "by" })) do
    local value = group[by]
    local name = type(value) == "string" and value or ("%s = %s"):format(greek[by] or by, type(value) == "number" and ("%.6g"):format(value) or tostring(value))
    list[#list + 1] = { rows = rows:where { [by] = value }, name = name }
  end
  return list
end

local function plot(given)
  local t = core.check("plot", given)
  if not t.name:match "^[%w_%-]+$" then core.fail(("'name' must be letters, digits, _ and -, is '%s'"):format(t.name), "name") end
  for column, f in pairs(t.theory) do
    if type(f) ~= "function" then core.fail(("'theory' takes column = function (x), '%s' is a %s"):format(tostring(column), type(f)), "theory") end
    local drawn = false
    for _, name in ipairs(t.y) do drawn = drawn or name == column end
    if not drawn then core.fail(("'theory' has a curve for '%s', which is not among 'y'"):format(tostring(column)), "theory") end
  end
  local list = series_of(t.rows, t.by)
  for _, series in ipairs(list) do series.summary = summarise(series.rows, t.x, t.y, { by = "x", of = "y" }) end
  if core.is_check() then return end
  if #list == 0 or #list[1].summary == 0 then core.fail "there are no rows to plot" end
  if type(list[1].summary[1][t.x]) ~= "number" then core.fail(("'x' must be a column of numbers, '%s' is not"):format(t.x), "x") end
  local lines = {}
  local finished, failed, samples = 0, 0, 0
  local ranges, first, last = {}, math.huge, -math.huge
  local function widen(i, low, high)
    local range = ranges[i] or { low = math.huge, high = -math.huge }
    ranges[i] = { low = math.min(range.low, low), high = math.max(range.high, high) }
  end
  for k, series in ipairs(list) do
    lines[#lines + 1] = ("$data%d << END"):format(k)
    for _, row in ipairs(series.summary) do
      local cells = { ("%.17g"):format(row[t.x]) }
      first, last = math.min(first, row[t.x]), math.max(last, row[t.x])
      for i, column in ipairs(t.y) do
        local s = row[column]
        local se = s.count > 1 and s.se or 0
        cells[#cells + 1] = s.count > 0 and ("%.17g"):format(s.mean) or "NaN"
        cells[#cells + 1] = ("%.17g"):format(se)
        if s.count > 0 then
          local log = t.log:find "y"
          if log and s.mean > 0 then widen(i, math.max(s.mean - se, s.mean / 2), s.mean + se) end
          if not log then widen(i, s.mean - se, s.mean + se) end
        end
        samples = math.max(samples, s.count)
      end
      finished, failed = finished + row.count, failed + row.failed
      lines[#lines + 1] = table.concat(cells, " ")
    end
    lines[#lines + 1] = "END"
  end
  if t.log:find "x" and first <= 0 then core.fail(("'log' along x needs values above 0, %s goes down to %g"):format(t.x, first), "log") end
  for i, column in ipairs(t.y) do
    if t.log:find "y" and not ranges[i] then core.fail(("'log' along y needs values above 0, and %s has none"):format(column), "log") end
    if t.theory[column] then
      lines[#lines + 1] = ("$theory%d << END"):format(i)
      for k = 0, 200 do
        local x = t.log:find "x" and first * (last / first) ^ (k / 200) or first + (last - first) * k / 200
        local y = t.theory[column](x)
        if type(y) ~= "number" then core.fail(("the theory of '%s' must return a number, returned a %s at x = %g"):format(column, type(y), x), "theory") end
        -- Where theory diverges it leaves the picture: the range is that of the impacts and a little more.
        lines[#lines + 1] = ("%.17g %.17g"):format(x, y)
      end
      lines[#lines + 1] = "END"
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
  -- Along a logarithmic axis of less than three decades 1, 2 and 5 of each are marked; gnuplot's own ticks might be one or none.
  local function log_tics(axis, low, high)
    if not t.log:find(axis) then return "" end
    if high / low > 1e3 then return ("\nset %stics autofreq"):format(axis) end
    local tics = {}
    local steps = high / low > 4 and { 1, 2, 5 } or { 1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9 }
    if high / low < 1.3 then steps = {} for k = 20, 199 do steps[#steps + 1] = k / 20 end end
    for decade = math.floor(math.log(low, 10)) - 1, math.floor(math.log(high, 10)) + 1 do
      for _, step in ipairs(steps) do tics[#tics + 1] = ("%.6g"):format(step * 10 ^ decade) end
    end
    return ("\nset %stics (%s)"):format(axis, table.concat(tics, ", "))
  end
  local height = 110 + 300 * #t.y
  local what = samples > 1 and "mean and standard error of %d impacts, %d failed" or "%d impacts, one a point, %d failed"
  local caption = what:format(finished, failed)
  local title = t.title and quoted(t.title) .. '."\\n".' .. quoted(caption) or quoted(caption)
  local function panels()
    lines[#lines + 1] = ("set multiplot layout %d,1 title %s noenhanced"):format(#t.y, title)
    for i, column in ipairs(t.y) do
      -- The same margins and range along x in every panel.
      local range = ranges[i] or { low = 0, high = 1 }
      lines[#lines + 1] = ("set lmargin 11\nset xrange %s\nset yrange %s"):format(roomy(first, last, 0.04, t.log:find "x"), roomy(range.low, range.high, 0.08, t.log:find "y")) .. log_tics("x", first, last) .. log_tics("y", range.low, range.high)
      lines[#lines + 1] = ("set xlabel %s%s"):format(i == #t.y and quoted(t.xlabel or label(t.x)) or "''", t.xlabel and " noenhanced" or " enhanced")
      lines[#lines + 1] = ("set ylabel %s"):format(quoted(label(column)))
      local parts = {}
      for k, series in ipairs(list) do
        local colour = quoted(colours[((t.by and k or i) - 1) % #colours + 1])
        local shape = t.by and ({ 7, 5, 9, 11, 13, 15 })[(k - 1) % 6 + 1] or 7  -- filled shapes, beside colour
        parts[#parts + 1] = ("$data%d using 1:%d:%d with yerrorbars pt %d ps 0.8 lw 1.5 lc rgb %s %s"):format(k, 2 * i, 2 * i + 1, shape, colour, series.name and i == 1 and "title " .. quoted(series.name) .. " noenhanced" or "notitle")
        parts[#parts + 1] = ("$data%d using 1:%d with lines lw 1 lc rgb %s notitle"):format(k, 2 * i, colour)
      end
      if t.theory[column] then parts[#parts + 1] = ("$theory%d using 1:2 with lines dt 2 lw 2 lc rgb '#555555' title %s noenhanced"):format(i, quoted(t.theory_name)) end
      lines[#lines + 1] = "plot " .. table.concat(parts, ", \\\n     ")
    end
    lines[#lines + 1] = "unset multiplot"
  end
  lines[#lines + 1] = "set encoding utf8\nset grid lt 1 lw 0.5 lc rgb \"#cccccc\"\nset tics nomirror\nset border 3\nset key outside top right horizontal"
  if t.log ~= "none" then lines[#lines + 1] = "set logscale " .. t.log .. "\nset format " .. t.log .. " '%g'" end
  for _, terminal in ipairs { { "pngcairo size 800,%d font \"DejaVu Sans,12\"", "png" }, { "svg size 800,%d font \"DejaVu Sans,12\" background \"white\"", "svg" } } do
    lines[#lines + 1] = "set terminal " .. terminal[1]:format(height)
    lines[#lines + 1] = ("set output %s"):format(quoted(t.name .. "." .. terminal[2]))
    panels()
  end
  core.gnuplot(t.name, table.concat(lines, "\n") .. "\n")
end

return { plot = plot }
