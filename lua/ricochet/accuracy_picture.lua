-- The picture of ricochet.accuracy: errors against time and step, energy drift, and what the size of the lattice or
-- mesh changes.
local gnuplot = require "ricochet.gnuplot"

local quoted = gnuplot.quoted

-- With more methods than colours the marks tell them apart.
local colours = { table.unpack(gnuplot.colours) }
colours[#colours + 1] = "#000000"
local marks = { 7, 5, 9, 11, 13, 4, 6, 8, 10, 12, 14 }

-- 1, 2 and 5 of every decade.
local function tics(low, high)
  local list = {}
  for decade = math.floor(math.log(low, 10)), math.ceil(math.log(high, 10)) do
    for _, digit in ipairs { 1, 2, 5 } do list[#list + 1] = ("%.9g"):format(digit * 10.0 ^ decade) end
  end
  return table.concat(list, ", ")
end

-- The marks of every method (step, seconds, error, drift, label) as $m1, $m2 ...; returns how far they reach.
local function write_marks(study, script)
  local column = study.columns[1]
  local far = { t_low = math.huge, t_high = 0, x_low = math.huge, x_high = 0, e_low = math.huge, e_high = 0 }
  for i, method in ipairs(study.methods) do
    local drawn, lines = {}, {}
    for _, row in ipairs(study.by_method[method]) do
      if row.status == "finished" then drawn[#drawn + 1] = row end
    end
    for k, row in ipairs(drawn) do
      local error = math.max(row.error[column], 1e-16)
      -- With many methods, only the ends of each line are labelled.
      local label = (#study.methods <= 4 or k == 1 or k == #drawn) and ("%.2g"):format(row.step) or '""'
      local drift = math.max(row.energy_drift, 1e-16)
      lines[k] = ("%.9g %.9g %.9g %.9g %s"):format(row.step, row.wall_seconds, error, drift, label)
      far.t_low, far.t_high = math.min(far.t_low, row.wall_seconds), math.max(far.t_high, row.wall_seconds)
      far.x_low, far.x_high = math.min(far.x_low, row.step), math.max(far.x_high, row.step)
      far.e_low, far.e_high = math.min(far.e_low, error), math.max(far.e_high, error)
    end
    script:data("m" .. i, lines)
  end
  return far
end

-- Dashed lines of an order, through the corner where all methods begin (a power law is straight here), and the floor:
-- what a panel of errors plots beside the marks. Returns those against time, and those against the step.
local function write_guides(script, far, floor)
  local count = 0
  local function line(x1, y1, x2, y2, style)
    count = count + 1
    script:data("guide" .. count, { ("%.9g %.9g"):format(x1, y1), ("%.9g %.9g"):format(x2, y2) })
    return ("$guide%d using 1:2 with lines %s"):format(count, style)
  end
  local function slope(order, from, to, at, sign)
    local function power(x) return far.e_high * (x / at) ^ (sign * order) end
    local style = ("dt %d lw 1 lc rgb '#888888' title 'order %d'"):format(order == 2 and 2 or 4, order)
    return line(from, power(from), to, power(to), style)
  end
  local by_time = { slope(2, far.t_low, far.t_high, far.t_low, -1), slope(4, far.t_low, far.t_high, far.t_low, -1) }
  local by_step = { slope(2, far.x_low, far.x_high, far.x_high, 1), slope(4, far.x_low, far.x_high, far.x_high, 1) }
  if floor then
    local style = "dt 3 lw 1.5 lc rgb '#000000' title 'floor'"
    by_time[3] = line(far.t_low * 0.8, floor, far.t_high * 1.6, floor, style)
    by_step[3] = line(far.x_low * 0.8, floor, far.x_high * 1.25, floor, style)
  end
  return by_time, by_step
end

-- Plots columns of all methods' marks against each other; `title` gives a method's name in the key.
local function add_panel(script, study, t)
  local parts = {}
  for i, method in ipairs(study.methods) do
    local colour, mark = colours[(i - 1) % #colours + 1], marks[(i - 1) % #marks + 1]
    local title = quoted(t.title and t.title(method) or method)
    local points = ("$m%d using %d:%d with linespoints pt %d ps 0.9 lw 1.5"):format(i, t.x, t.y, mark)
    parts[#parts + 1] = ("%s lc rgb '%s' title %s noenhanced"):format(points, colour, title)
    if t.labels then
      local style = ("font ',8' left offset 0.6,0.5 tc rgb '%s' notitle"):format(colour)
      parts[#parts + 1] = ("$m%d using 2:3:5 with labels %s"):format(i, style)
    end
  end
  for _, guide in ipairs(t.guides or {}) do parts[#parts + 1] = guide end
  script:add("set xlabel %s\nset ylabel %s", quoted(t.xlabel), quoted(t.ylabel))
  script:add("plot %s", table.concat(parts, ", \\\n     "))
end

-- What the size of the lattice or mesh changes, and the line to an infinitely fine one.
local function add_lattice_panel(script, study)
  local lattice = study.lattice
  local low, high = lattice.limit, lattice.limit
  for _, size in ipairs(lattice.sizes) do
    low, high = math.min(low, size.mean - size.se), math.max(high, size.mean + size.se)
  end
  local room = math.max(0.1 * (high - low), 1e-9)
  script:add "unset logscale\nset format '%g'\nset xtics auto"
  script:add("set yrange [%.12g:%.12g]", low - room, high + room)
  script:add("set xrange [0:%.9g]", 1.15 * lattice.sizes[1].factor ^ -0.5)
  script:add("set xlabel 'spacing over that of the scene; marks labelled with the factor of the nodes'\nset ylabel %s",
    quoted(("%s, mean of %d %s"):format(study.columns[1], study.lattice_samples, study.division.many)))
  script:add("plot $lattice using 1:2:3 with yerrorbars pt 7 lw 1.5 lc rgb '%s' title 'mean ± standard error', "
    .. "$lattice using 1:2:4 with labels font ',8' left offset 0.8,0.5 notitle, \\\n"
    .. "     %.9g + %.9g*x with lines dt 2 lc rgb '#888888' title 'fit to infinitely fine'",
    colours[1], lattice.limit, lattice.slope)
end

--- Draws a study by a script of gnuplot.
local function draw_study(study, script)
  local column, lattice, step = study.columns[1], study.lattice, ("time step [%s]"):format(study.time_unit)
  local far = write_marks(study, script)
  if lattice then
    local lines = {}
    for i, size in ipairs(lattice.sizes) do
      lines[i] = ("%.9g %.9g %.9g %g"):format(size.factor ^ -0.5, size.mean, size.se, size.factor)
    end
    script:data("lattice", lines)
  end
  local floor = math.max(study.floor[column], 1e-16)
  if floor <= far.e_low / 30 then floor = nil end  -- far below every mark it would only squeeze them
  local by_time, by_step = write_guides(script, far, floor)
  local function with_order(method)
    local order = study.order[method]
    return order and ("%s %.2f ± %.2f"):format(method, order.slope, order.se) or method
  end
  local function draw()
    script:add "set lmargin 11\nunset offsets\nunset logscale\nset xrange [*:*]\nset yrange [*:*]"
    script:add "set logscale xy\nset format y '10^{%L}'\nset format x '%g'"
    script:add("set xrange [%.9g:%.9g]", far.t_low * 0.8, far.t_high * 1.6)
    script:add("set yrange [%.9g:%.9g]", math.min(far.e_low, floor or math.huge) / 3, far.e_high * 3)
    script:add("set xtics (%s)", tics(far.t_low, far.t_high))
    add_panel(script, study, { x = 2, y = 3, xlabel = "wall time [s]; marks labelled with the " .. step,
      ylabel = "time-step error of " .. column, labels = true, guides = by_time })
    script:add("set xrange [%.9g:%.9g]", far.x_low * 0.8, far.x_high * 1.25)
    script:add("set xtics (%s)", tics(far.x_low, far.x_high))
    add_panel(script, study, { x = 1, y = 3, xlabel = step .. "; beside each method its fitted order",
      ylabel = "time-step error of " .. column, title = with_order, guides = by_step })
    script:add "set yrange [*:*]"
    add_panel(script, study, { x = 1, y = 4, xlabel = step, ylabel = "greatest energy drift" })
    if lattice then add_lattice_panel(script, study) end
  end
  local count = lattice and 4 or 3
  script:panels {
    count = count, width = 960, font = 11, title = quoted(study.caption), draw = draw,
    -- As high as the key beside it, which would else stand in two columns, the first over the lines.
    height = count * math.max(lattice and 400 or 416, 90 + 19 * (#study.methods + 3)),
    key = "outside right top Left reverse samplen 1 maxcols 1 spacing 1.3 font ',9'", axes = "set rmargin 31",
  }
  script:draw()
end

return { draw = draw_study }
