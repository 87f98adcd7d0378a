-- ricochet.dem: what a code of discrete elements needs of a pair of materials: e(v), mu and beta0 with errors, and the
-- lines that LAMMPS, YADE and MercuryDPM read.
local core = require "ricochet.core"
local lines = require "ricochet.dem_lines"
local statistics = require "ricochet.statistics"
local walton_fit = require "ricochet.walton_fit"

-- Rigid, for codes that know no such body: so much stiffer than the other.
local rigid_over_elastic = 1e4

local function is_head_on(row) return math.abs(row.psi1) < 1e-9 end

-- "E = 2.05e+11 Pa, nu = 0.29, 7850 kg/m^3".
local function told(m)
  return m and ("E = %.4g Pa, nu = %.4g and %.4g kg/m^3"):format(m.E, m.nu, m.density) or "rigid"
end

local function is_same(one, other)
  if not one or not other then return not one == not other end
  for _, name in ipairs { "E", "nu", "density" } do
    if math.abs(one[name] - other[name]) > 1e-6 * math.abs(other[name]) then return false end
  end
  return true
end

-- What the codes compute with is what the impacts were of. True where all rows are of this run, whose scenes are known.
local function check_materials(t)
  local known = true
  for _, rows in ipairs { t.rows, t.oblique } do
    for k = 1, #rows, math.max(1, #rows // 200) do
      local hash = core.peek(rows[k], "scene_hash")
      local projectile, target = nil, nil
      if hash then projectile, target = core.materials_of(hash) end
      known = known and projectile ~= nil
      if projectile and not is_same(projectile, t.projectile) then
        core.fail(("the projectiles of the rows are of %s, and 'projectile' is of %s; name the rows' material"):format(
          told(projectile), told(t.projectile)), "projectile")
      end
      if projectile and not is_same(target, t.target) then
        core.fail(("the targets of the rows are %s%s, and 'target' is %s; %s"):format(target and "of " or "",
          told(target), t.target and "of " .. told(t.target) or "not given, which is rigid",
          target and "name the rows' material" or "leave it out"), "target")
      end
    end
  end
  return known
end

-- Finished rows whose e is told, with the speed `v` at which the surfaces met.
local function measured(t)
  local list = {}
  for _, rows in ipairs { t.rows, t.oblique } do
    for _, row in ipairs(rows) do
      if core.peek(row, "units") ~= "SI" then
        core.fail("the rows are in the paper's units, and these codes take m, kg and s; give the scenes "
          .. "units = \"SI\" and their bodies materials", "rows")
      end
      if row.status == "finished" and row.e == row.e and row.e > 0 then
        list[#list + 1] = { row = row, v = row.vn / row.e }
      end
    end
  end
  return list
end

-- e at each speed of the head-on impacts, rising: { { v =, e =, e_se =, count = }, ... }.
local function table_of_e(impacts)
  local groups, list = {}, {}
  for _, impact in ipairs(impacts) do
    if is_head_on(impact.row) then
      local key = ("%.6g"):format(impact.v)
      groups[key] = groups[key] or { v = impact.v, values = {} }
      table.insert(groups[key].values, impact.row.e)
    end
  end
  for _, group in pairs(groups) do
    local of = statistics.of(group.values)
    list[#list + 1] = { v = group.v, e = of.mean, e_se = of.se, count = of.count }
  end
  if #list == 0 then core.fail("no head-on impact (psi1 = 0) has finished; they are what e(v) is of", "rows") end
  table.sort(list, function(a, b) return a.v < b.v end)
  return list
end

-- e at a speed, between those of the table in the logarithm of the speed; NaN outside of it.
local function e_at(list, v)
  for i, point in ipairs(list) do
    local before = list[i - 1]
    if math.abs(v / point.v - 1) < 1e-6 then return point.e, point.e_se end
    if before and before.v < v and v < point.v then
      local share = math.log(v / before.v) / math.log(point.v / before.v)
      return before.e + share * (point.e - before.e),
        math.sqrt(((1 - share) * before.e_se) ^ 2 + (share * point.e_se) ^ 2)
    end
  end
  return 0 / 0, 0 / 0
end

-- The speed of the table that is nearest to the middle of it, in its logarithm.
local function middle(list)
  local wanted, best = math.sqrt(list[1].v * list[#list].v), list[1].v
  for _, point in ipairs(list) do
    if math.abs(math.log(point.v / wanted)) < math.abs(math.log(best / wanted)) then best = point.v end
  end
  return best
end

-- mu and beta0 of the oblique impacts, or NaN and the reason.
local function friction_of(impacts)
  local columns, inertia = { psi1 = {}, psi2 = {}, e = {}, sample = {} }, {}
  for i, impact in ipairs(impacts) do
    local row = impact.row
    if row.psi1 > 1e-9 and row.psi2 == row.psi2 then
      for _, name in ipairs { "psi1", "psi2", "e" } do table.insert(columns[name], row[name]) end
      table.insert(columns.sample, core.peek(row, "sample") or i)
      inertia[#inertia + 1] = 1 + 1 / row.inertia
    end
  end
  local unknown = { mu = 0 / 0, mu_se = 0 / 0, beta0 = 0 / 0, beta0_se = 0 / 0, count = #columns.psi1 }
  if #columns.psi1 == 0 then
    unknown.reason = "no oblique impacts (psi1 > 0) were given"
    return unknown
  end
  local whole, fit = pcall(walton_fit, columns, statistics.of(inertia).mean)
  if not whole then
    unknown.reason = "the oblique impacts do not tell sticking from sliding: take psi1 on either side of where they "
      .. "begin to slide"
    return unknown
  end
  return { mu = fit.mu, mu_se = fit.mu_se, beta0 = fit.beta0, beta0_se = fit.beta0_se, count = #columns.psi1 }
end

-- The materials as numbers; a rigid target is one that hardly gives.
local function pair_of(t)
  local function numbers(material) return { E = material.E, nu = material.nu, density = material.density } end
  local projectile = numbers(t.projectile)
  local target = t.target and numbers(t.target)
    or { E = rigid_over_elastic * projectile.E, nu = projectile.nu, density = projectile.density }
  local function shear(m) return m.E / (2 * (1 + m.nu)) end
  return {
    projectile = projectile, target = target, rigid = not t.target,
    E = 1 / ((1 - projectile.nu ^ 2) / projectile.E + (1 - target.nu ^ 2) / target.E),
    G = 1 / ((2 - projectile.nu) / shear(projectile) + (2 - target.nu) / shear(target)),
  }
end

-- The constant e, and what it misses at a third and at three times its speed.
local function constant_of(list, at)
  local v = at or middle(list)
  local e, e_se = e_at(list, v)
  if e ~= e then
    core.fail(("e was measured from %.4g to %.4g m/s, not at %.4g; name a speed between"):format(list[1].v,
      list[#list].v, v), "at")
  end
  if e > 1 then
    core.fail(("e = %.4g at %.4g m/s: these codes take no e above 1; name another speed"):format(e, v), "at")
  end
  return { v = v, e = e, e_se = e_se, third = e - e_at(list, v / 3), triple = e - e_at(list, 3 * v) }
end

local function dem(given)
  local t = core.check("dem", given)
  if core.is_check() then return nil end
  local impacts = measured(t)
  local is_of_materials = check_materials(t)
  local list = table_of_e(impacts)
  local over_yield = 0
  for _, impact in ipairs(impacts) do
    if core.peek(impact.row, "over_yield") == 1 then over_yield = over_yield + 1 end
  end
  local study = { e = list, impacts = #impacts, over_yield = over_yield, friction = friction_of(impacts),
    pair = pair_of(t), constant = constant_of(list, t.at), is_of_materials = is_of_materials }
  for extension, text in pairs(lines.of(study)) do core.functions["file.write"](t.name .. extension, text) end
  print(lines.summary(study))
  return core.strict({
    e = list, mu = study.friction.mu, mu_se = study.friction.mu_se, beta0 = study.friction.beta0,
    beta0_se = study.friction.beta0_se, at = study.constant.v, e_at = study.constant.e,
    e_lammps = lines.lammps_e(study.constant.e),
  }, "the table for DEM")
end

return { dem = dem }
