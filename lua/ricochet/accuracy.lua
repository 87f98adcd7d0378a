-- ricochet.accuracy: what accuracy costs. One scene by many methods and steps against two runs of order 6; a table, a
-- CSV file and work-precision plots.
local core = require "ricochet.core"
local gnuplot = require "ricochet.gnuplot"
local outcomes = require "ricochet.outcomes"
local refine = require "ricochet.refine"
local statistics = require "ricochet.statistics"

local quoted = gnuplot.quoted

-- With more methods than colours the marks tell them apart.
local colours = { table.unpack(gnuplot.colours) }
colours[#colours + 1] = "#000000"
local marks = { 7, 5, 9, 11, 13, 4, 6, 8, 10, 12, 14 }

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
  local specs = extrapolated
    and { { method = "verlet", theta = 0.2 }, { method = "verlet", theta = 0.1 }, { method = "verlet", theta = 0.05 } }
    or { { method = "blanes_moan_srkn14a", theta = 0.7 }, { method = "blanes_moan_srkn11b", theta = 0.5 } }
  -- A contact may be stiffer than the springs: the steps are halved until they are stable there.
  local runs, shorter = core.accuracy_runs(scene, specs, 1), 1
  while shorter < 64 and (runs[1].status == "unstable" or runs[2].status == "unstable") do
    shorter = 2 * shorter
    for _, spec in ipairs(specs) do spec.theta = spec.theta / 2 end
    runs = core.accuracy_runs(scene, specs, 1)
  end
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
      first = runs[3][column] + (runs[3][column] - runs[2][column]) / 3
      second = runs[2][column] + (runs[2][column] - runs[1][column]) / 3
    end
    value[column], floor[column] = first, math.abs(first - second)
  end
  return value, floor, shorter, runs[1]
end

-- What the softness of a contact that the program chose does: 2 |x(xi) - x(2 xi)| by the reference's method. False
-- where the scene gives xi, which is of its model then.
local function softness_of(scene, columns, soft)
  local t = core.given(scene)
  local contact = {}
  for name, value in pairs(t.contact or {}) do contact[name] = value end
  if contact.xi then return false end
  contact.xi = 2 * soft.xi
  t.contact, t.accuracy, t.step, t.theta, t.method = contact, nil, nil, nil, nil
  local harder, spec = core.functions.scene(t), { method = soft.method, theta = soft.theta }
  local hard
  repeat
    spec.theta = spec.theta / 2
    hard = core.accuracy_runs(harder, { spec }, 1)[1]
  until hard.status ~= "unstable" or spec.theta < soft.theta / 64
  if hard.status ~= "finished" then
    core.fail(("with a contact twice as hard the reference run ended %s: %s"):format(hard.status, hard.reason), "scene")
  end
  local error = {}
  for _, column in ipairs(columns) do error[column] = 2 * math.abs(hard[column] - soft[column]) end
  return { xi = soft.xi, error = error }
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
  local header = {
    "method", "step [R/c]", "theta", "status", "evaluations", "seconds [s]", "energy_drift", "momentum_residual",
  }
  for _, column in ipairs(columns) do header[#header + 1] = "error_of_" .. column end
  local lines = { table.concat(header, ",") }
  for _, row in ipairs(rows) do
    local is_told = row.momentum_residual == row.momentum_residual
    local cells = {
      row.method, ("%.17g"):format(row.step), ("%.6g"):format(row.theta), row.status, ("%.0f"):format(row.evaluations),
      ("%.6g"):format(row.wall_seconds), ("%.6g"):format(row.energy_drift),
      is_told and ("%.6g"):format(row.momentum_residual) or "",
    }
    for _, column in ipairs(columns) do cells[#cells + 1] = ("%.6g"):format(row.error[column] or 0 / 0) end
    lines[#lines + 1] = table.concat(cells, ",")
  end
  return table.concat(lines, "\n") .. "\n"
end

-- The cheapest finished run of a list whose error is at most `wanted`, by force evaluations.
local function cheapest(rows, column, wanted)
  local best
  for _, row in ipairs(rows) do
    local is_good = row.status == "finished" and row.error[column] <= wanted
    if is_good and (not best or row.evaluations < best.evaluations) then best = row end
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
    local of = statistics.of_finished(rows, column)
    if of.count < 2 then
      core.fail(("fewer than two of %d impacts finished with %g times the nodes: %s"):format(samples, factor,
        rows[1].reason), "lattices")
    end
    sizes[i] = {
      factor = factor, mean = of.mean, sd = of.sd, se = of.se, count = of.count, seconds = seconds / samples,
    }
    points[i] = { x = factor ^ -0.5, value = of.mean, se = math.max(of.se, 1e-12) }
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

-- What the size of the lattice changes, and the line to an infinitely fine one.
local function add_lattice_panel(script, study)
  local lattice = study.lattice
  script:add "unset logscale\nset format '%g'\nset xtics auto\nset yrange [*:*]\nset offsets graph 0, 0, 0.1, 0.1"
  script:add("set xrange [0:%.9g]", 1.15 * lattice.sizes[1].factor ^ -0.5)
  script:add("set xlabel 'spacing over that of the scene; marks labelled with the factor of the nodes'\nset ylabel %s",
    quoted(("%s, mean of %d lattices"):format(study.columns[1], study.lattice_samples)))
  script:add("plot $lattice using 1:2:3 with yerrorbars pt 7 lw 1.5 lc rgb '%s' title 'mean ± standard error', "
    .. "$lattice using 1:2:4 with labels font ',8' left offset 0.8,0.5 notitle, \\\n"
    .. "     %.9g + %.9g*x with lines dt 2 lc rgb '#888888' title 'fit to infinitely fine'",
    colours[1], lattice.limit, lattice.slope)
end

local function plot(study, script)
  local column, lattice = study.columns[1], study.lattice
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
    local order, uncertainty = fitted_order(study.by_method[method], column, study.floor[column])
    return order and ("%s %.2f ± %.2f"):format(method, order, uncertainty) or method
  end
  local function draw()
    script:add "set lmargin 11\nunset offsets\nunset logscale\nset xrange [*:*]\nset yrange [*:*]"
    script:add "set logscale xy\nset format y '10^{%L}'\nset format x '%g'"
    script:add("set xrange [%.9g:%.9g]", far.t_low * 0.8, far.t_high * 1.6)
    script:add("set yrange [%.9g:%.9g]", math.min(far.e_low, floor or math.huge) / 3, far.e_high * 3)
    script:add("set xtics (%s)", tics(far.t_low, far.t_high))
    add_panel(script, study, { x = 2, y = 3, xlabel = "wall time [s]; marks labelled with the time step [R/c]",
      ylabel = "time-step error of " .. column, labels = true, guides = by_time })
    script:add("set xrange [%.9g:%.9g]", far.x_low * 0.8, far.x_high * 1.25)
    script:add("set xtics (%s)", tics(far.x_low, far.x_high))
    add_panel(script, study, { x = 1, y = 3, xlabel = "time step [R/c]; beside each method its fitted order",
      ylabel = "time-step error of " .. column, title = with_order, guides = by_step })
    script:add "set yrange [*:*]"
    add_panel(script, study, { x = 1, y = 4, xlabel = "time step [R/c]", ylabel = "greatest energy drift" })
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

-- What the size of the lattice changes.
local function print_lattice(lattice, column)
  for _, size in ipairs(lattice.sizes) do
    print(("%5.3g times the nodes: %s = %.4f +- %.4f (sd %.3g, %d lattices), %.3f s an impact"):format(size.factor,
      column, size.mean, size.se, size.sd, size.count, size.seconds))
  end
  local slope, slope_se = math.abs(lattice.slope), lattice.slope_se
  print(("error of %s from the size of the lattice: %.2g +- %.2g against an infinitely fine one%s"):format(column,
    slope, slope_se, slope > 2 * slope_se and "" or ", not told apart from 0 by this many samples"))
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
    print(order
      and ("%-20s %s falls with order %.2f +- %.2f of the step"):format(method, "error of " .. column, order,
        uncertainty)
      or ("%-20s fewer than three steps are above ten times the floor: no order to be seen"):format(method))
  end
  if study.lattice then print_lattice(study.lattice, column) end
  if study.softness then
    print(("error of %s from the softness of the contact: about %.2g (xi = %.4g, chosen by the program, and twice as "
      .. "hard)"):format(column, study.softness.error[column], study.softness.xi))
  end
  print(("floor %.2g: the difference of two references; below ten times that no error is told"):format(
    study.floor[column]))
end

-- The methods that are studied: those named, or all that the scene's effects allow.
local function methods_of(t)
  local methods = {}
  for _, name in ipairs(t.methods or {}) do
    methods[#methods + 1] = method_named(name)
    local conflict = core.conflict(t.scene, name)
    if conflict ~= "" then core.fail("'methods': " .. conflict, "methods") end
  end
  if t.methods then return methods end
  for _, method in ipairs(core.methods()) do
    if core.conflict(t.scene, method.name) == "" then methods[#methods + 1] = method end
  end
  return methods
end

-- What runs: every method at the steps that are named, or at shares of its stability limit, `shorter` times shorter.
local function runs_of(t, methods, shorter)
  for _, step in ipairs(t.steps or {}) do
    if not (step > 0 and step < math.huge) then
      core.fail(("'steps' must be greater than 0, has %g"):format(step), "steps")
    end
  end
  local specs = {}
  for _, method in ipairs(methods) do
    for _, step in ipairs(t.steps or {}) do specs[#specs + 1] = { method = method.name, step = step } end
    for _, share in ipairs(t.steps and {} or shares) do
      specs[#specs + 1] = { method = method.name, theta = share * method.stability_limit / shorter }
    end
  end
  return specs
end

local function check_lattices(lattices)
  if not lattices then return end
  local seen = {}
  for _, factor in ipairs(lattices) do
    if not (factor > 0 and factor <= 64) then
      core.fail(("'lattices' holds factors of the nodes, above 0 and at most 64, not %g"):format(factor), "lattices")
    end
    if seen[factor] then core.fail(("'lattices' names %g twice"):format(factor), "lattices") end
    seen[factor] = true
  end
  if #lattices < 2 then core.fail("'lattices' needs two sizes or more to compare", "lattices") end
end

-- Gives each row its errors against the reference, and puts it to its method's.
local function sort_rows(study)
  for _, row in ipairs(study.rows) do
    row.error = {}
    for _, column in ipairs(study.columns) do
      row.error[column] = row.status == "finished" and math.abs(row[column] - study.reference[column]) or 0 / 0
    end
    table.insert(study.by_method[row.method], row)
  end
end

-- True if some method has two marks, between which a line can be drawn.
local function is_drawable(study)
  for _, name in ipairs(study.methods) do
    local count = 0
    for _, row in ipairs(study.by_method[name]) do count = count + (row.status == "finished" and 1 or 0) end
    if count > 1 then return true end
  end
  return false
end

local function caption_of(t)
  local processor, cores = core.machine()
  local repeats = t.repeats > 1 and ("least of %d runs"):format(t.repeats) or "one run each"
  return ("what accuracy costs: %d nodes on %s (%d cores), %s, one core"):format(core.nodes(t.scene), processor, cores,
    repeats)
end

-- study.cheapest(wanted [, column [, method]]): the row with the fewest force evaluations whose error is at most
-- `wanted`, or nil.
local function cheapest_of(study, wanted, column, method)
  if type(wanted) ~= "number" then
    core.fail(("cheapest takes the wanted error, a number; has %s"):format(type(wanted)))
  end
  column = column or study.columns[1]
  local studied = false
  for _, name in ipairs(study.columns) do studied = studied or name == column end
  if not studied then core.fail(("the study has no errors of '%s'; name it in 'of'"):format(tostring(column))) end
  local rows = study.rows
  if method then
    rows = study.by_method[method]
    local nearest = core.did_you_mean(tostring(method), study.methods)
    if not rows then core.fail(("the study has no method '%s'%s"):format(tostring(method), nearest)) end
  end
  return cheapest(rows, column, wanted)
end

local function accuracy(given)
  local t = core.check("accuracy", given)
  local script = gnuplot.script(t.name)
  local methods = methods_of(t)
  local runs = runs_of(t, methods, 1)
  outcomes.check(t.of, "of")
  check_lattices(t.lattices)
  if core.is_check() then return nil end
  local exact, floor, shorter, soft = reference(t.scene, t.of)
  if shorter > 1 then runs = runs_of(t, methods, shorter) end
  local rows = core.accuracy_runs(t.scene, runs, t.repeats)
  local study = {
    rows = rows, columns = t.of, methods = {}, by_method = {}, reference = exact, floor = floor,
    caption = caption_of(t), lattice_samples = t.lattice_samples,
  }
  study.lattice = t.lattices and lattice_study(t.scene, t.lattices, t.lattice_samples, t.of[1]) or false
  study.softness = softness_of(t.scene, t.of, soft)
  for i, method in ipairs(methods) do
    study.methods[i] = method.name
    study.by_method[method.name] = {}
  end
  sort_rows(study)
  print_table(study)
  core.functions["file.write"](t.name .. ".csv", csv(rows, t.of))
  if is_drawable(study) then plot(study, script) end
  study.cheapest = core.wrap(function(...) return cheapest_of(study, ...) end)
  return core.strict(study, "the study")
end

return { accuracy = accuracy }
