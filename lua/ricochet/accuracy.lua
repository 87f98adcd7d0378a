-- ricochet.accuracy: what accuracy costs. One scene by many methods and steps against two runs of order 6; a table, a
-- CSV file and work-precision plots.
local core = require "ricochet.core"
local gnuplot = require "ricochet.gnuplot"
local outcomes = require "ricochet.outcomes"
local picture = require "ricochet.accuracy_picture"
local refine = require "ricochet.refine"
local statistics = require "ricochet.statistics"
local text = require "ricochet.accuracy_text"

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

-- { slope =, se = } of log error against log step, over points well above the floor; nil of fewer than three.
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
  return { slope = slope, se = math.sqrt(rest / (n - 2) / xx) }
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

-- Mean and standard error of a column over samples of the scene's lattices or meshes at several sizes, and the limit of
-- infinitely fine ones.
local function lattice_study(scene, given, samples, column)
  local sizes, points, factors, scatters = {}, {}, { table.unpack(given) }, false
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
    points[i] = { x = factor ^ -0.5, value = of.mean, se = of.se }
    scatters = scatters or of.se > 0
  end
  local slope, slope_se, limit = refine.fitted_line(points)
  return { sizes = sizes, slope = slope, slope_se = slope_se, limit = limit, scatters = scatters }
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

-- Gives each row its errors against the reference, puts it to its method's, and fits the methods' orders.
local function sort_rows(study)
  for _, row in ipairs(study.rows) do
    row.error = {}
    for _, column in ipairs(study.columns) do
      row.error[column] = row.status == "finished" and math.abs(row[column] - study.reference[column]) or 0 / 0
    end
    table.insert(study.by_method[row.method], row)
  end
  local column = study.columns[1]
  for _, method in ipairs(study.methods) do
    study.order[method] = fitted_order(study.by_method[method], column, study.floor[column])
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
    caption = caption_of(t), lattice_samples = t.lattice_samples, division = refine.division { t.scene }, order = {},
    time_unit = core.columns(core.given(t.scene).units).step,
  }
  study.lattice = t.lattices and lattice_study(t.scene, t.lattices, t.lattice_samples, t.of[1]) or false
  study.softness = softness_of(t.scene, t.of, soft)
  for i, method in ipairs(methods) do
    study.methods[i] = method.name
    study.by_method[method.name] = {}
  end
  sort_rows(study)
  text.print(study)
  core.functions["file.write"](t.name .. ".csv", text.csv(rows, t.of, study.time_unit))
  if is_drawable(study) then picture.draw(study, script) end
  study.cheapest = core.wrap(function(...) return cheapest_of(study, ...) end)
  return core.strict(study, "the study")
end

return { accuracy = accuracy }
