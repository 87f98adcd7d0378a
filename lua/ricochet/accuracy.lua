-- ricochet.accuracy: what accuracy costs. One scene by many methods and steps against a far finer run; a table, a CSV file and
-- work-precision plots.
local core = require "ricochet.core"

-- Colours that the colour-blind can tell apart [Okabe & Ito 2008]; with more methods than colours the marks tell them apart.
local colours = { "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000" }

-- Steps of a method when none are given: from 0.9 of its stability limit down, by the square root of 2.
local shares = { 0.9, 0.64, 0.45, 0.32, 0.22, 0.16 }

local function method_named(name)
  local names = {}
  for _, method in ipairs(core.methods()) do
    if method.name == name then return method end
    names[#names + 1] = method.name
  end
  core.fail(("no method is called '%s'%s"):format(name, core.did_you_mean(name, names)), "methods")
end

-- The reference: two methods of order 6 at short steps. Their difference is the smallest error that can be told.
local function reference(scene, columns)
  local pair = core.accuracy_runs(scene, { { method = "blanes_moan_srkn14a", theta = 0.7 }, { method = "blanes_moan_srkn11b", theta = 0.5 } }, 1)
  for _, row in ipairs(pair) do
    if row.status ~= "finished" then core.fail(("the reference run ended %s: %s"):format(row.status, row.reason), "scene") end
  end
  local value, floor = {}, {}
  for _, column in ipairs(columns) do value[column], floor[column] = pair[1][column], math.abs(pair[1][column] - pair[2][column]) end
  return value, floor
end

-- Slope and its standard error of log error against log step, over points well above the floor.
local function fitted_order(rows, column, floor)
  local points = {}
  for _, row in ipairs(rows) do
    local error = row.error[column]
    if row.status == "finished" and error > 10 * floor then points[#points + 1] = { math.log(row.step), math.log(error) } end
  end
  local n = #points
  if n < 3 then return nil end
  local mx, my = 0, 0
  for _, p in ipairs(points) do mx, my = mx + p[1] / n, my + p[2] / n end
  local xx, xy = 0, 0
  for _, p in ipairs(points) do xx, xy = xx + (p[1] - mx) ^ 2, xy + (p[1] - mx) * (p[2] - my) end
  local slope, rest = xy / xx, 0
  for _, p in ipairs(points) do rest = rest + (p[2] - my - slope * (p[1] - mx)) ^ 2 end
  return slope, math.sqrt(rest / (n - 2) / xx)
end

local function csv(rows, columns)
  local header = { "method", "step [R/c]", "theta", "status", "evaluations", "seconds [s]", "energy_drift", "momentum_residual" }
  for _, column in ipairs(columns) do header[#header + 1] = "error_of_" .. column end
  local lines = { table.concat(header, ",") }
  for _, row in ipairs(rows) do
    local cells = { row.method, ("%.17g"):format(row.step), ("%.6g"):format(row.theta), row.status, ("%.0f"):format(row.evaluations), ("%.6g"):format(row.wall_seconds),
      ("%.6g"):format(row.energy_drift), ("%.6g"):format(row.momentum_residual) }
    for _, column in ipairs(columns) do cells[#cells + 1] = ("%.6g"):format(row.error[column] or 0 / 0) end
    lines[#lines + 1] = table.concat(cells, ",")
  end
  return table.concat(lines, "\n") .. "\n"
end

-- The cheapest finished run of a list whose error is at most `wanted`, by force evaluations.
local function cheapest(rows, column, wanted)
  local best
  for _, row in ipairs(rows) do
    if row.status == "finished" and row.error[column] <= wanted and (not best or row.evaluations < best.evaluations) then best = row end
  end
  return best
end

local function plot(study, name)
  local lines = {}
  local function add(text, ...) lines[#lines + 1] = select("#", ...) > 0 and text:format(...) or text end
  local column = study.columns[1]
  for i, method in ipairs(study.methods) do
    add("$m%d << END", i)
    for _, row in ipairs(study.by_method[method]) do
      if row.status == "finished" then
        add("%.9g %.9g %.9g %.9g %.9g", row.step, row.wall_seconds, math.max(row.error[column], 1e-16), math.max(row.energy_drift, 1e-16), row.evaluations)
      end
    end
    add "END"
  end
  add "set encoding utf8\nset grid lt 1 lw 0.5 lc rgb '#cccccc'\nset tics nomirror\nset border 3\nset logscale xy\nset format '10^{%L}'\nset key outside right top samplen 1"
  -- x column, y column, label of x, label of y, order guides
  local function panel(x, y, xlabel, ylabel, guides)
    local parts = {}
    for i, method in ipairs(study.methods) do
      local colour, mark = colours[(i - 1) % #colours + 1], ({ 7, 5, 9, 11, 13, 4, 6, 8, 10, 12, 14 })[(i - 1) % 11 + 1]
      parts[#parts + 1] = ("$m%d using %d:%d with linespoints pt %d ps 0.9 lw 1.5 lc rgb '%s' title '%s' noenhanced"):format(i, x, y, mark, colour, method)
    end
    for _, guide in ipairs(guides) do parts[#parts + 1] = guide end
    add("set xlabel '%s'\nset ylabel '%s'", xlabel, ylabel)
    add("plot %s", table.concat(parts, ", \\\n     "))
  end
  local x_low, x_high, e_high = math.huge, 0, 0
  for _, row in ipairs(study.rows) do
    if row.status == "finished" then x_low, x_high, e_high = math.min(x_low, row.step), math.max(x_high, row.step), math.max(e_high, row.error[column]) end
  end
  local function slope(order)
    return ("[%.9g:%.9g] %.9g*(x/%.9g)**%d with lines dt 2 lw 1 lc rgb '#888888' title 'order %d'"):format(x_low, x_high, e_high, x_high, order, order)
  end
  for _, terminal in ipairs { { "pngcairo size 900,1250 font 'DejaVu Sans,11'", "png" }, { "svg size 900,1250 font 'DejaVu Sans,11' background 'white'", "svg" } } do
    add("set terminal %s\nset output '%s.%s'", terminal[1], name, terminal[2])
    add("set multiplot layout 3,1 title '%s' noenhanced", study.caption)
    add("set lmargin 10\nunset xrange")
    panel(2, 3, "wall time [s]", "error of " .. column, {})
    add("set xrange [%.9g:%.9g]", x_low * 0.8, x_high * 1.25)
    panel(1, 3, "time step [R/c]", "error of " .. column, { slope(2), slope(4), ("%.9g with lines dt 3 lw 1.5 lc rgb '#000000' title 'floor'"):format(math.max(study.floor[column], 1e-16)) })
    panel(1, 4, "time step [R/c]", "greatest energy drift", {})
    add "unset multiplot"
  end
  core.gnuplot(name, table.concat(lines, "\n") .. "\n")
end

local function print_table(study)
  local column = study.columns[1]
  print(study.caption)
  print(("%-20s %11s %6s %10s %9s %11s %11s"):format("method", "step [R/c]", "theta", "force eval", "time [s]", "error of " .. column, "energy drift"))
  for _, row in ipairs(study.rows) do
    if row.status == "finished" then
      print(("%-20s %11.4g %6.2f %10.0f %9.3f %11.2g %11.2g"):format(row.method, row.step, row.theta, row.evaluations, row.wall_seconds, row.error[column], row.energy_drift))
    else
      print(("%-20s %11.4g   %s: %s"):format(row.method, row.step, row.status, row.reason))
    end
  end
  for _, method in ipairs(study.methods) do
    local order, uncertainty = fitted_order(study.by_method[method], column, study.floor[column])
    print(order and ("%-20s %s falls with order %.2f +- %.2f of the step"):format(method, "error of " .. column, order, uncertainty)
      or ("%-20s fewer than three steps are above ten times the floor: no order to be seen"):format(method))
  end
  print(("floor %.2g: the difference of two references of order 6; below ten times that no error is told"):format(study.floor[column]))
end

local function accuracy(given)
  local t = core.check("accuracy", given)
  if not t.name:match "^[%w_%-]+$" then core.fail(("'name' must be letters, digits, _ and -, is '%s'"):format(t.name), "name") end
  local methods, specs = {}, {}
  if t.methods then
    for _, name in ipairs(t.methods) do methods[#methods + 1] = method_named(name) end
  else
    methods = core.methods()
  end
  for _, method in ipairs(methods) do
    if t.steps then
      for _, step in ipairs(t.steps) do specs[#specs + 1] = { method = method.name, step = step } end
    else
      for _, share in ipairs(shares) do specs[#specs + 1] = { method = method.name, theta = share * method.stability_limit } end
    end
  end
  local known = core.columns()
  for _, column in ipairs(t.of) do
    if not known[column] then
      local names = {}
      for name in pairs(known) do names[#names + 1] = name end
      core.fail(("an outcome has no '%s'%s"):format(column, core.did_you_mean(column, names)), "of")
    end
  end
  if core.is_check() then return nil end
  local exact, floor = reference(t.scene, t.of)
  local rows = core.accuracy_runs(t.scene, specs, t.repeats)
  local processor, cores = core.machine()
  local study = { rows = rows, columns = t.of, methods = {}, by_method = {}, reference = exact, floor = floor,
    caption = ("what accuracy costs on %s (%d cores), least of %d runs, one core"):format(processor, cores, t.repeats) }
  for _, method in ipairs(methods) do study.methods[#study.methods + 1], study.by_method[method.name] = method.name, {} end
  for _, row in ipairs(rows) do
    local errors = {}
    for _, column in ipairs(t.of) do errors[column] = row.status == "finished" and math.abs(row[column] - exact[column]) or 0 / 0 end
    row.error = errors
    table.insert(study.by_method[row.method], row)
  end
  print_table(study)
  core.file_write(t.name .. ".csv", csv(rows, t.of))
  local drawable = false
  for _, name in ipairs(study.methods) do drawable = drawable or #study.by_method[name] > 1 end
  if drawable then plot(study, t.name) end
  --- study.cheapest(wanted [, column]): the row with the fewest force evaluations whose error is at most `wanted`, or nil.
  study.cheapest = function(wanted, column) return cheapest(rows, column or t.of[1], wanted) end
  return study
end

return { accuracy = accuracy }
