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

local function plot(given)
  local t = core.check("plot", given)
  if not t.name:match "^[%w_%-]+$" then core.fail(("'name' must be letters, digits, _ and -, is '%s'"):format(t.name), "name") end
  local summary = summarise(t.rows, t.x, t.y, { by = "x", of = "y" })
  if core.is_check() then return end
  if #summary == 0 then core.fail "there are no rows to plot" end
  if type(summary[1][t.x]) ~= "number" then core.fail(("'x' must be a column of numbers, '%s' is not"):format(t.x), "x") end
  local lines = { "$data << END" }
  local finished, failed, samples = 0, 0, 0
  local ranges = {}
  for _, row in ipairs(summary) do
    local cells = { ("%.17g"):format(row[t.x]) }
    for i, column in ipairs(t.y) do
      local s = row[column]
      local se = s.count > 1 and s.se or 0
      cells[#cells + 1] = s.count > 0 and ("%.17g"):format(s.mean) or "NaN"
      cells[#cells + 1] = ("%.17g"):format(se)
      if s.count > 0 then
        local range = ranges[i] or { low = math.huge, high = -math.huge }
        ranges[i] = { low = math.min(range.low, s.mean - se), high = math.max(range.high, s.mean + se) }
      end
      samples = math.max(samples, s.count)
    end
    finished, failed = finished + row.count, failed + row.failed
    lines[#lines + 1] = table.concat(cells, " ")
  end
  lines[#lines + 1] = "END"
  -- Room around the first and last point, also where there is only one.
  local function roomy(low, high, share)
    local room = high > low and share * (high - low) or math.max(0.5, math.abs(low) / 2)
    return ("[%.17g:%.17g]"):format(low - room, high + room)
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
      lines[#lines + 1] = ("set lmargin 11\nset xrange %s\nset yrange %s"):format(roomy(summary[1][t.x], summary[#summary][t.x], 0.04), roomy(range.low, range.high, 0.08))
      lines[#lines + 1] = ("set xlabel %s%s"):format(i == #t.y and quoted(t.xlabel or label(t.x)) or "''", t.xlabel and " noenhanced" or " enhanced")
      lines[#lines + 1] = ("set ylabel %s"):format(quoted(label(column)))
      lines[#lines + 1] = ("plot $data using 1:%d:%d with yerrorbars pt 7 ps 0.8 lw 1.5 lc rgb %s notitle, \\"):format(2 * i, 2 * i + 1, quoted(colours[(i - 1) % #colours + 1]))
      lines[#lines + 1] = ("     $data using 1:%d with lines lw 1 lc rgb %s notitle"):format(2 * i, quoted(colours[(i - 1) % #colours + 1]))
    end
    lines[#lines + 1] = "unset multiplot"
  end
  lines[#lines + 1] = "set encoding utf8\nset grid lt 1 lw 0.5 lc rgb \"#cccccc\"\nset tics nomirror\nset border 3"
  for _, terminal in ipairs { { "pngcairo size 800,%d font \"DejaVu Sans,12\"", "png" }, { "svg size 800,%d font \"DejaVu Sans,12\" background \"white\"", "svg" } } do
    lines[#lines + 1] = "set terminal " .. terminal[1]:format(height)
    lines[#lines + 1] = ("set output %s"):format(quoted(t.name .. "." .. terminal[2]))
    panels()
  end
  core.gnuplot(t.name, table.concat(lines, "\n") .. "\n")
end

return { plot = plot }
