-- ricochet.accuracy: what accuracy costs. One scene by many methods and steps against two runs of order 6; a table, a
-- CSV file and work-precision plots.
local core = require "ricochet.core"
local refine = require "ricochet.refine"
local quoted = require("ricochet.plot").quoted

-- Colours that the colour-blind can tell apart [Okabe & Ito 2008]; with more methods than colours the marks tell them
-- apart.
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

-- The reference: two methods of order 6 at short steps; beside effects that lower orders, verlet at three short steps,
-- extrapolated. The difference of two references is the smallest error that can be told.
local function reference(scene, columns)
  local extrapolated = core.conflict(scene, "blanes_moan_srkn14a") ~= ""
  local specs = extrapolated and { { method = "verlet", theta = 0.2 }, { method = "verlet", theta = 0.1 },
    { method = "verlet", theta = 0.05 } }
    or { { method = "blanes_moan_srkn14a", theta = 0.7 }, { method = "blanes_moan_srkn11b", theta = 0.5 } }
  local runs = core.accuracy_runs(scene, specs, 1)
  for _, row in ipairs(runs) do
    if row.status ~= "finished" then
      core.fail(("the reference run ended %s: %s"):format(row.status, row.reason), "scene")
    end
  end
  local value, floor = {}, {}
  for _, column in ipairs(columns) do
    if runs[1][column] ~= runs[1][column] then
      core.fail(("%s is not defined in this impact; name another outcome"):format(column), "of")
    end
    local first, second = runs[1][column], runs[2][column]
    if extrapolated then
      first, second = runs[3][column] + (runs[3][column] - runs[2][column]) / 3,
        runs[2][column] + (runs[2][column] - runs[1][column]) / 3
    end
    value[column], floor[column] = first, math.abs(first - second)
  end
  return value, floor
end

-- Slope and its standard error of log error against log step, over points well above the floor.
local function fitted_order(rows, column, floor)
  local points = {}
  for _, row in ipairs(rows) do
    local error = row.error[column]
    if row.status == "finished" and error > 10 * floor then
      points[#points + 1] = { math.log(row.step), math.log(error) }
    end
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
  local header = { "method", "step [R/c]", "theta", "status", "evaluations", "seconds [s]", "energy_drift",
    "momentum_residual" }
  for _, column in ipairs(columns) do header[#header + 1] = "error_of_" .. column end
  local lines = { table.concat(header, ",") }
  for _, row in ipairs(rows) do
    local cells = { row.method, ("%.17g"):format(row.step), ("%.6g"):format(row.theta), row.status,
      ("%.0f"):format(row.evaluations), ("%.6g"):format(row.wall_seconds),
      ("%.6g"):format(row.energy_drift), row.momentum_residual == row.momentum_residual
        and ("%.6g"):format(row.momentum_residual) or "" }
    for _, column in ipairs(columns) do cells[#cells + 1] = ("%.6g"):format(row.error[column] or 0 / 0) end
    lines[#lines + 1] = table.concat(cells, ",")
  end
  return table.concat(lines, "\n") .. "\n"
end

-- The cheapest finished run of a list whose error is at most `wanted`, by force evaluations.
local function cheapest(rows, column, wanted)
  local best
  for _, row in ipairs(rows) do
    if row.status == "finished" and row.error[column] <= wanted
        and (not best or row.evaluations < best.evaluations) then
          best = row
        end
  end
  return best
end

-- Mean and standard error of a column over samples of the scene's lattices at several sizes, and the limit of an
-- infinitely fine one.
local function lattice_study(scene, given, samples, column)
  local sizes, points, factors = {}, {}, { table.unpack(given) }
  table.sort(factors)
  for i, factor in ipairs(factors) do
    local scenes = {}
    for k = 1, samples do scenes[k] = refine.refined(scene, factor, k - 1) end
    local rows, seconds = core.pilot(scenes)
    local n, mean, square = 0, 0, 0
    for _, row in ipairs(rows) do
      if row.status == "finished" and row[column] == row[column] then
        n = n + 1
        local delta = row[column] - mean
        mean, square = mean + delta / n, square + delta * (row[column] - mean - delta / n)
      end
    end
    if n < 2 then
      core.fail(("fewer than two of %d impacts finished with %g times the nodes: %s"):format(samples, factor,
        rows[1].reason), "lattices")
    end
    sizes[i] = { factor = factor, mean = mean, sd = math.sqrt(square / (n - 1)), se = math.sqrt(square / (n - 1) / n),
      count = n, seconds = seconds / samples }
    points[i] = { x = factor ^ -0.5, value = mean, se = math.max(sizes[i].se, 1e-12) }
  end
  local slope, slope_se, limit = refine.fitted_line(points)
  return { sizes = sizes, slope = slope, slope_se = slope_se, limit = limit }
end

-- 1, 2 and 5 of every decade.
local function tics(low, high)
  local list = {}
  for decade = math.floor(math.log(low, 10)), math.ceil(math.log(high, 10)) do
    for _, digit in ipairs { 1, 2, 5 } do list[#list + 1] = ("%.9g"):format(digit * 10.0 ^ decade) end
  end
  return table.concat(list, ", ")
end

local function plot(study, name)
  local lines = {}
  local function add(text, ...) lines[#lines + 1] = select("#", ...) > 0 and text:format(...) or text end
  local column = study.columns[1]
  local t_low, t_high, x_low, x_high, e_low, e_high = math.huge, 0, math.huge, 0, math.huge, 0
  for i, method in ipairs(study.methods) do
    local drawn = {}
    for _, row in ipairs(study.by_method[method]) do
      if row.status == "finished" then drawn[#drawn + 1] = row end
    end
    add("$m%d << END", i)
    for k, row in ipairs(drawn) do
      local error = math.max(row.error[column], 1e-16)
      -- With many methods, only the ends of each line are labelled.
      local label = (#study.methods <= 4 or k == 1 or k == #drawn) and ("%.2g"):format(row.step) or '""'
      add("%.9g %.9g %.9g %.9g %s", row.step, row.wall_seconds, error, math.max(row.energy_drift, 1e-16), label)
      t_low, t_high = math.min(t_low, row.wall_seconds), math.max(t_high, row.wall_seconds)
      x_low, x_high, e_low, e_high = math.min(x_low, row.step), math.max(x_high, row.step), math.min(e_low, error),
        math.max(e_high, error)
    end
    add "END"
  end
  local lattice = study.lattice
  if lattice then
    add "$lattice << END"
    for _, size in ipairs(lattice.sizes) do
      add("%.9g %.9g %.9g %g", size.factor ^ -0.5, size.mean, size.se, size.factor)
    end
    add "END"
  end
  add("set encoding utf8\nset grid lt 1 lw 0.5 lc rgb '#cccccc'\nset tics nomirror\nset border 3\n" ..
    "set key outside right top Left reverse samplen 1 maxcols 1 spacing 1.3 font ',9'\nset rmargin 31")
  local function panel(x, y, xlabel, ylabel, title, guides)
    local parts = {}
    for i, method in ipairs(study.methods) do
      local colour, mark = colours[(i - 1) % #colours + 1], ({ 7, 5, 9, 11, 13, 4, 6, 8, 10, 12, 14 })[(i - 1) % 11 + 1]
      parts[#parts + 1] = ("$m%d using %d:%d with linespoints pt %d ps 0.9 lw 1.5 lc rgb '%s' title %s " ..
        "noenhanced"):format(i, x, y, mark, colour, quoted(title(method)))
      if x == 2 then
        parts[#parts + 1] = ("$m%d using 2:3:5 with labels font ',8' left offset 0.6,0.5 tc rgb '%s' notitle"):format(
          i, colour)
      end
    end
    for _, guide in ipairs(guides) do parts[#parts + 1] = guide end
    add("set xlabel %s\nset ylabel %s", quoted(xlabel), quoted(ylabel))
    add("plot %s", table.concat(parts, ", \\\n     "))
  end
  -- Dashed lines of an order, through the corner where all methods begin; a power law is straight here.
  local guides = 0
  local function line(x1, y1, x2, y2, style)
    guides = guides + 1
    add("$guide%d << END\n%.9g %.9g\n%.9g %.9g\nEND", guides, x1, y1, x2, y2)
    return ("$guide%d using 1:2 with lines %s"):format(guides, style)
  end
  local function slope(order, from, to, at, sign)
    local function power(x) return e_high * (x / at) ^ (sign * order) end
    return line(from, power(from), to, power(to),
      ("dt %d lw 1 lc rgb '#888888' title 'order %d'"):format(order == 2 and 2 or 4, order))
  end
  local by_time, by_step = { slope(2, t_low, t_high, t_low, -1), slope(4, t_low, t_high, t_low, -1) },
    { slope(2, x_low, x_high, x_high, 1), slope(4, x_low, x_high, x_high, 1) }
  local floor = math.max(study.floor[column], 1e-16)
  -- A floor far below every mark would only squeeze them.
  local floor_shown = floor > e_low / 30
  if floor_shown then
    by_time[3] = line(t_low * 0.8, floor, t_high * 1.6, floor, "dt 3 lw 1.5 lc rgb '#000000' title 'floor'")
    by_step[3] = line(x_low * 0.8, floor, x_high * 1.25, floor, "dt 3 lw 1.5 lc rgb '#000000' title 'floor'")
  end
  local function plain(method) return method end
  local function with_order(method)
    local order, uncertainty = fitted_order(study.by_method[method], column, study.floor[column])
    return order and ("%s %.2f ± %.2f"):format(method, order, uncertainty) or method
  end
  -- As high as the key beside it, which would else stand in two columns, the first over the lines.
  local height = (lattice and 4 or 3) * math.max(lattice and 400 or 416, 90 + 19 * (#study.methods + 3))
  for _, terminal in ipairs { { "pngcairo size 960,%d font 'DejaVu Sans,11'", "png" },
      { "svg size 960,%d font 'DejaVu Sans,11' background 'white'", "svg" } } do
    add("set terminal %s\nset output %s", terminal[1]:format(height), quoted(name .. "." .. terminal[2]))
    add("set multiplot layout %d,1 title %s noenhanced", lattice and 4 or 3, quoted(study.caption))
    add("set lmargin 11\nunset logscale\nset xrange [*:*]\nset yrange [*:*]\nset logscale xy\n" ..
      "set format y '10^{%%L}'\nset format x '%%g'\nset xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]", t_low * 0.8,
      t_high * 1.6, (floor_shown and math.min(e_low, floor) or e_low) / 3, e_high * 3)
    add("set xtics (%s)", tics(t_low, t_high))
    panel(2, 3, "wall time [s]; marks labelled with the time step [R/c]", "time-step error of " .. column, plain,
      by_time)
    add("set xrange [%.9g:%.9g]\nset xtics (%s)", x_low * 0.8, x_high * 1.25, tics(x_low, x_high))
    panel(1, 3, "time step [R/c]; beside each method its fitted order", "time-step error of " .. column, with_order,
      by_step)
    add "set yrange [*:*]"
    panel(1, 4, "time step [R/c]", "greatest energy drift", plain, {})
    if lattice then
      add "unset logscale\nset format '%g'\nset xtics auto\nset yrange [*:*]\nset offsets graph 0, 0, 0.1, 0.1"
      add("set xrange [0:%.9g]", 1.15 * lattice.sizes[1].factor ^ -0.5)
      add("set xlabel 'spacing over that of the scene; marks labelled with the factor of the nodes'\nset ylabel %s",
        quoted(("%s, mean of %d lattices"):format(column, study.lattice_samples)))
      add("plot $lattice using 1:2:3 with yerrorbars pt 7 lw 1.5 lc rgb '%s' title 'mean ± standard error', " ..
        "$lattice using 1:2:4 with labels font ',8' left offset 0.8,0.5 notitle, \\\n"
        .. "     %.9g + %.9g*x with lines dt 2 lc rgb '#888888' title 'fit to infinitely fine'", colours[1],
          lattice.limit, lattice.slope)
    end
    add "unset multiplot\nunset offsets"
  end
  core.gnuplot(name, table.concat(lines, "\n") .. "\n")
end

local function print_table(study)
  local column = study.columns[1]
  print(study.caption)
  print(("%-20s %11s %6s %10s %9s %11s %11s"):format("method", "step [R/c]", "theta", "force eval", "time [s]",
    "error of " .. column, "energy drift"))
  for _, row in ipairs(study.rows) do
    if row.status == "finished" then
      print(("%-20s %11.4g %6.2f %10.0f %9.3f %11.2g %11.2g"):format(row.method, row.step, row.theta, row.evaluations,
        row.wall_seconds, row.error[column], row.energy_drift))
    else
      print(("%-20s %11.4g   %s: %s"):format(row.method, row.step, row.status, row.reason))
    end
  end
  for _, method in ipairs(study.methods) do
    local order, uncertainty = fitted_order(study.by_method[method], column, study.floor[column])
    print(order and ("%-20s %s falls with order %.2f +- %.2f of the step"):format(method, "error of " .. column, order,
      uncertainty)
      or ("%-20s fewer than three steps are above ten times the floor: no order to be seen"):format(method))
  end
  local lattice = study.lattice
  if lattice then
    for _, size in ipairs(lattice.sizes) do
      print(("%5.3g times the nodes: %s = %.4f +- %.4f (sd %.3g, %d lattices), %.3f s an impact"):format(size.factor,
        column, size.mean, size.se, size.sd, size.count, size.seconds))
    end
    print(("error of %s from the size of the lattice: %.2g +- %.2g against an infinitely fine one%s"):format(column,
      math.abs(lattice.slope), lattice.slope_se,
      math.abs(lattice.slope) > 2 * lattice.slope_se and "" or ", not told apart from 0 by this many samples"))
  end
  print(("floor %.2g: the difference of two references; below ten times that no error is told"):format(
    study.floor[column]))
end

local function accuracy(given)
  local t = core.check("accuracy", given)
  if not t.name:match "^[%w_%-]+$" then
    core.fail(("'name' must be letters, digits, _ and -, is '%s'"):format(t.name), "name")
  end
  local methods, specs = {}, {}
  if t.methods then
    for _, name in ipairs(t.methods) do
      methods[#methods + 1] = method_named(name)
      local conflict = core.conflict(t.scene, name)
      if conflict ~= "" then core.fail("'methods': " .. conflict, "methods") end
    end
  else
    -- Those that the scene's effects allow.
    for _, method in ipairs(core.methods()) do
      if core.conflict(t.scene, method.name) == "" then methods[#methods + 1] = method end
    end
  end
  for _, method in ipairs(methods) do
    if t.steps then
      for _, step in ipairs(t.steps) do specs[#specs + 1] = { method = method.name, step = step } end
    else
      for _, share in ipairs(shares) do
        specs[#specs + 1] = { method = method.name, theta = share * method.stability_limit }
      end
    end
  end
  for _, step in ipairs(t.steps or {}) do
    if not (step > 0 and step < math.huge) then
      core.fail(("'steps' must be greater than 0, has %g"):format(step), "steps")
    end
  end
  if #specs == 0 then
    core.fail(("'%s' is empty"):format(t.methods and #t.methods == 0 and "methods" or "steps"),
      t.methods and #t.methods == 0 and "methods" or "steps")
  end
  if #t.of == 0 then core.fail("'of' is empty; name an outcome", "of") end
  local known = core.columns()
  for _, column in ipairs(t.of) do
    if not known[column] then
      local names = {}
      for name in pairs(known) do names[#names + 1] = name end
      core.fail(("an outcome has no '%s'%s"):format(column, core.did_you_mean(column, names)), "of")
    end
  end
  for _, factor in ipairs(t.lattices or { 1, 2 }) do
    if not (factor > 0 and factor <= 64) then
      core.fail(("'lattices' holds factors of the nodes, above 0 and at most 64, not %g"):format(factor), "lattices")
    end
  end
  local seen = {}
  for _, factor in ipairs(t.lattices or {}) do
    if seen[factor] then core.fail(("'lattices' names %g twice"):format(factor), "lattices") end
    seen[factor] = true
  end
  if t.lattices and #t.lattices < 2 then core.fail("'lattices' needs two sizes or more to compare", "lattices") end
  if core.is_check() then return nil end
  local exact, floor = reference(t.scene, t.of)
  local rows = core.accuracy_runs(t.scene, specs, t.repeats)
  local processor, cores = core.machine()
  local study = { rows = rows, columns = t.of, methods = {}, by_method = {}, reference = exact, floor = floor,
    caption = ("what accuracy costs: %d nodes on %s (%d cores), %s, one core"):format(core.nodes(t.scene), processor,
      cores, t.repeats > 1 and ("least of %d runs"):format(t.repeats) or "one run each") }
  study.lattice = t.lattices and lattice_study(t.scene, t.lattices, t.lattice_samples, t.of[1]) or false
  study.lattice_samples = t.lattice_samples
  for _, method in ipairs(methods) do
    study.methods[#study.methods + 1], study.by_method[method.name] = method.name, {}
  end
  for _, row in ipairs(rows) do
    local errors = {}
    for _, column in ipairs(t.of) do
      errors[column] = row.status == "finished" and math.abs(row[column] - exact[column]) or 0 / 0
    end
    row.error = errors
    table.insert(study.by_method[row.method], row)
  end
  print_table(study)
  core.file_write(t.name .. ".csv", csv(rows, t.of))
  local drawable = false
  for _, name in ipairs(study.methods) do
    local count = 0
    for _, row in ipairs(study.by_method[name]) do count = count + (row.status == "finished" and 1 or 0) end
    drawable = drawable or count > 1
  end
  if drawable then plot(study, t.name) end
  --- study.cheapest(wanted [, column [, method]]): the row with the fewest force evaluations whose error is at most
  --- `wanted`, or nil.
  study.cheapest = core.wrap(function(wanted, column, method)
    if type(wanted) ~= "number" then
      core.fail(("cheapest takes the wanted error, a number; has %s"):format(type(wanted)))
    end
    column = column or t.of[1]
    local studied = false
    for _, name in ipairs(t.of) do studied = studied or name == column end
    if not studied then core.fail(("the study has no errors of '%s'; name it in 'of'"):format(tostring(column))) end
    if method and not study.by_method[method] then
      core.fail(("the study has no method '%s'%s"):format(tostring(method),
        core.did_you_mean(tostring(method), study.methods)))
    end
    return cheapest(method and study.by_method[method] or rows, column, wanted)
  end)
  return core.strict(study, "the study")
end

return { accuracy = accuracy }
