-- ricochet.histogram: how a column of finished rows is spread, a panel for each value of another.
local core = require "ricochet.core"
local axes = require "ricochet.axes"
local gnuplot = require "ricochet.gnuplot"
local rows_module = require "ricochet.rows"
local plot = require "ricochet.plot"
local statistics = require "ricochet.statistics"
local quantile = statistics.quantile

local most_bins = 200

-- What a panel shows of its rows: rising values, how many have none and how many failed.
local function values_of(rows, column)
  local panel = { values = {}, undefined = 0, failed = 0 }
  for _, row in ipairs(rows) do
    local status, value = core.peek(row, "status"), row[column]
    if status ~= nil and status ~= "finished" then
      panel.failed = panel.failed + 1
    elseif type(value) ~= "number" then
      core.fail(("column '%s' holds no numbers"):format(column), "of")
    elseif value ~= value or math.abs(value) == math.huge then
      panel.undefined = panel.undefined + 1
    else
      panel.values[#panel.values + 1] = value
    end
  end
  table.sort(panel.values)
  return panel
end

-- Width of a bin: twice the range of the middle half over the cube root of the count. [Freedman & Diaconis 1981]
local function width_of(sorted)
  return 2 * (quantile(sorted, 0.75) - quantile(sorted, 0.25)) / (#sorted) ^ (1 / 3)
end

-- Where the bins of all panels lie, and the rule they are of: { first =, width =, count =, rule = }.
local function bins_of(t, panels)
  local low, high, widths = math.huge, -math.huge, {}
  for _, panel in ipairs(panels) do
    local values = panel.values
    if #values > 0 then
      low, high = math.min(low, values[1]), math.max(high, values[#values])
      widths[#widths + 1] = width_of(values)
    end
  end
  if #widths == 0 then return { first = 0, width = 1, count = 1, rule = "" } end
  if high == low then
    local width = math.max(math.abs(low) / 50, 1e-9)
    return { first = low - width / 2, width = width, count = 1, rule = "all values are the same" }
  end
  if t.bins then
    return { first = low, width = (high - low) / t.bins, count = t.bins, rule = ("%d bins"):format(t.bins) }
  end
  table.sort(widths)
  local width, rule = quantile(widths, 0.5), "by the rule of Freedman & Diaconis"
    .. (#widths > 1 and ", the median of the panels" or "")
  if width == 0 then width, rule = (high - low) / 10, "10 bins: half of the values or more are the same" end
  if (high - low) / width > most_bins then
    width, rule = (high - low) / most_bins, ("%d bins: the rule of Freedman & Diaconis asks for more"):format(most_bins)
  end
  -- Of e no bin holds values on both sides of 1.
  local edge = t.of == "e" and 1 or 0
  local first = edge + width * math.floor((low - edge) / width)
  return { first = first, width = width, count = math.floor((high - first) / width) + 1, rule = rule }
end

-- How many values each bin holds. One on an edge belongs to the bin above it, but for the last edge.
local function counts_of(values, bins)
  local counts = {}
  for k = 1, bins.count do counts[k] = 0 end
  for _, value in ipairs(values) do
    local k = math.min(bins.count, math.floor((value - bins.first) / bins.width) + 1)
    counts[k] = counts[k] + 1
  end
  return counts
end

-- "Ψ1 = 3: n = 98, 2 failed; mean 0.95 ± 0.03", in a power of ten.
local function told(panel, power, unit)
  local s, text = panel.mean, (panel.name and panel.name .. ":  " or "") .. ("n = %d, %d failed"):format(
    #panel.values, panel.failed)
  if panel.undefined > 0 then text = text .. (", %d without a value"):format(panel.undefined) end
  if s.count == 0 then return text end
  local mean, se = s.mean / 10 ^ power, s.se / 10 ^ power
  if not (se > 0) then return text .. ("; mean %.4g"):format(mean) .. unit end
  local places = 1 - math.floor(math.log(se, 10))  -- two digits of the error
  local number = places >= 0 and places < 10 and ("%%.%df"):format(places) or "%.4g"
  return text .. ("; mean " .. number .. " ± " .. number):format(mean, se) .. unit
end

local function add_panel(script, t, panel, k, last)
  local low, high, top = t.shown.low, t.shown.high, math.max(1, 1.08 * panel.most)
  script:add("set xrange [%.17g:%.17g]\nset yrange [0:%.17g]", low, high, top)
  local power, unit = plot.power_of(t.of, t.rows, low, high)
  script:add(axes.tics("x", low, high, power))
  script:add("set xlabel %s enhanced\nset ylabel 'impacts'",
    last and gnuplot.quoted(plot.label(t.of, t.rows, false, power)) or "''")
  script:add("set label 2 %s at graph 0,1.07 left enhanced", gnuplot.quoted(told(panel, power, unit)))
  if #panel.values == 0 then
    script:add("set label 3 'no finished row' at graph 0.5,0.5 center font ',14'\nplot NaN notitle\nunset label 3")
    return
  end
  local s, parts, first = panel.mean, {}, k == t.first_full
  parts[1] = ("$panel%d using 1:2 with boxes lc rgb '#56B4E9' fs solid 0.6 border notitle"):format(k)
  local function mark(name, value, title, style)
    script:data(name .. k, { ("%.17g 0"):format(value), ("%.17g %.17g"):format(value, top) })
    parts[#parts + 1] = ("$%s%d using 1:2 with lines %s %s"):format(name, k, style,
      first and ("title '%s'"):format(title) or "notitle")
  end
  if t.of == "e" and low <= 1 and 1 <= high then mark("one", 1, "e = 1", "dt 2 lw 2 lc rgb '#000000'") end
  mark("mean", s.mean, "mean", "lw 2.5 lc rgb '#D55E00'")
  script:add("plot " .. table.concat(parts, ", \\\n     "))
end

local function draw(t, panels, bins)
  local script = gnuplot.script(t.name)
  local room, shown = 0.04 * bins.count * bins.width, { low = bins.first, high = bins.first + bins.count * bins.width }
  -- 1 is in the picture of e, unless nothing comes near it.
  if t.of == "e" and shown.high < 1 and 1 - shown.high < shown.high - shown.low then shown.high = 1 end
  t.shown = { low = shown.low - room, high = shown.high + room }
  local finished, failed = 0, 0
  for k, panel in ipairs(panels) do
    local lines, counts = {}, counts_of(panel.values, bins)
    panel.most = math.max(table.unpack(counts))
    for i, count in ipairs(counts) do lines[i] = ("%.17g %d"):format(bins.first + (i - 0.5) * bins.width, count) end
    script:data("panel" .. k, lines)
    finished, failed = finished + #panel.values + panel.undefined, failed + panel.failed
    if not t.first_full and #panel.values > 0 then t.first_full = k end
  end
  local below = t.caption and plot.wrapped(t.caption, 100) or {}
  local power, unit = plot.power_of(t.of, t.rows, t.shown.low, t.shown.high)
  local bins_text = bins.rule ~= "" and ("; bins of %.3g%s (%s)"):format(bins.width / 10 ^ power, unit, bins.rule) or ""
  local over = rows_module.averaged(t.rows, t.by or {})
  if over ~= "" then over = "; over " .. over end
  for _, line in ipairs(plot.wrapped(("%d impacts, %d failed%s%s"):format(finished, failed, bins_text, over), 100)) do
    below[#below + 1] = line
  end
  script:panels {
    count = #panels, width = 800, font = 12, key = "outside top right horizontal Left reverse samplen 2",
    panel = #panels > 1 and 215 or 400, title = t.title and gnuplot.quoted(t.title) or "''", has_title = t.title ~= nil,
    below = below, axes = ("set boxwidth %.17g\nset lmargin 11"):format(0.96 * bins.width),
    draw = function(place)
      for k, panel in ipairs(panels) do
        place(k)
        add_panel(script, t, panel, k, k == #panels)
      end
    end,
  }
  script:draw()
end

local function histogram(given)
  local t = core.check("histogram", given)
  if type(t.by) == "string" then t.by = { t.by } end
  gnuplot.script(t.name)  -- refuses a name that is none
  rows_module.known_column(t.rows, t.of, "of")
  local panels = {}
  for i, group in ipairs(plot.groups(t.rows, t.by)) do
    panels[i] = values_of(group.rows, t.of)
    panels[i].name, panels[i].mean = group.name, statistics.of(panels[i].values)
  end
  if core.is_check() then return end
  if #t.rows == 0 then core.fail "there are no rows to draw" end
  draw(t, panels, bins_of(t, panels))
end

return { histogram = histogram }
