-- What ricochet.dem writes: tables as CSV and JSON, and the lines of each code.
local dem_lines = {}

-- The damping alpha = gamma/sqrt(m k) of a Hertzian contact that returns e, whose force is that of the spring and the
-- dashpot until the overlap is 0. [Antypov & Elliott 2011, EPL 94, 50004]
local function damping_of(e)
  local l = math.log(e)
  return -math.sqrt(5) * l / math.sqrt(l ^ 2 + math.pi ^ 2)
end

-- What LAMMPS makes of the number that it calls e. [LAMMPS, pair_style granular, damping tsuji]
local function damping_of_lammps(e)
  return 1.2728 - 4.2783 * e + 11.087 * e ^ 2 - 22.348 * e ^ 3 + 27.467 * e ^ 4 - 18.022 * e ^ 5 + 4.8218 * e ^ 6
end

--- The number to give LAMMPS so that e comes out: its polynomial's damping at 0.9, say, returns 0.928. By bisection; 1
--- where no damping is wanted. [here]
function dem_lines.lammps_e(e)
  local low, high, wanted = 0, 1, damping_of(e)
  if wanted <= damping_of_lammps(1) then return 1 end
  for _ = 1, 60 do
    local middle = (low + high) / 2
    if damping_of_lammps(middle) > wanted then low = middle else high = middle end
  end
  return (low + high) / 2
end

local function number(value) return ("%.6g"):format(value) end

-- What a constant e is there beside what was measured, if it was.
local function missed(change, where)
  return change == change and ("%s it is %+.4f off"):format(where, change) or where .. " nothing was measured"
end

-- One impact alone has no error.
local function with_error(value, se)
  return se == se and ("%.4f +- %.4f"):format(value, se) or ("%.4f, by one impact, without an error"):format(value)
end

-- What every file says at its head, a line each.
local function head(study)
  local c, f = study.constant, study.friction
  local list = {
    ("These codes take one e for all speeds: %s, that at a normal speed of %s m/s."):format(with_error(c.e, c.e_se),
      number(c.v)),
    missed(c.third, "At a third of that speed") .. "; " .. missed(c.triple, "at three times that speed") .. ".",
  }
  if f.reason then
    list[3] = "mu and beta0 are not known: " .. f.reason .. "."
  else
    list[3] = ("mu = %.4f +- %.4f, beta0 = %.3f +- %.3f of Walton's impact, by %d oblique impacts."):format(f.mu,
      f.mu_se, f.beta0, f.beta0_se, f.count)
    list[4] = "beta0 is no parameter of a Mindlin spring, whose stiffness decides it: compare it with what comes out."
  end
  if study.over_yield > 0 then
    list[#list + 1] = ("%d of %d impacts press beyond a yield stress of a body that no effect lets yield: their e is "
      .. "too high."):format(study.over_yield, study.impacts)
  end
  if not study.is_of_materials then
    list[#list + 1] = "The rows are of another run: whether their bodies were of these materials is not known."
  end
  if study.pair.rigid then list[#list + 1] = "The target is rigid: 1e4 times as stiff as the other." end
  return list
end

local function commented(study, sign)
  local list = {}
  for i, line in ipairs(head(study)) do list[i] = sign .. " " .. line end
  return table.concat(list, "\n") .. "\n"
end

-- An equal pair of this E has the pair's E*. [LAMMPS, pair_style granular, hertz/material]
local function lammps(study)
  local nu = study.pair.projectile.nu
  local given = number(dem_lines.lammps_e(study.constant.e))
  local model = ("hertz/material %s %s %s"):format(number(2 * (1 - nu ^ 2) * study.pair.E), given, number(nu))
  local friction = study.friction.reason and " tangential linear_nohistory 0.0 0.0"  -- some model must be named
    or (" tangential mindlin NULL 1.0 %s"):format(number(study.friction.mu))
  return commented(study, "#")
    .. "# LAMMPS, SI units. `damping tsuji` turns the second number into a damping by a polynomial that returns\n"
    .. ("# another e than that number: %s stands here so that %.4f comes out.\n"):format(given, study.constant.e)
    .. ("# density of the spheres: %s\n"):format(number(study.pair.projectile.density))
    .. "pair_style granular\n"
    .. ("pair_coeff * * %s%s damping tsuji\n"):format(model, friction)
    .. ("fix dem_wall all wall/gran granular %s%s damping tsuji zplane 0.0 NULL\n"):format(model, friction)
end

-- [YADE, Ip2_FrictMat_FrictMat_MindlinPhys, FrictMat]
local function yade(study)
  local mu = study.friction.reason and 0 or study.friction.mu
  local function material(name)
    local m = study.pair[name]
    return ("O.materials.append(FrictMat(young=%s, poisson=%s, density=%s, frictionAngle=atan(%s), label='%s'))\n")
      :format(number(m.E), number(m.nu), number(m.density), number(mu), name)
  end
  return commented(study, "#") .. "# YADE, SI units: for the InteractionLoop of O.engines.\nfrom math import atan\n"
    .. material "projectile" .. material "target"
    .. ("dem_physics = Ip2_FrictMat_FrictMat_MindlinPhys(en=%s, es=%s)\n"):format(number(study.constant.e),
      number(study.constant.e))
    .. "dem_law = Law2_ScGeom_MindlinPhys_Mindlin()\n"
end

-- [MercuryDPM, HertzianViscoelasticMindlinSpecies]
local function mercury(study)
  local friction = study.friction.reason and ""
    or ("species.setEffectiveShearModulus(%s);\nspecies.setSlidingFrictionCoefficient(%s);\n"):format(
      number(study.pair.G), number(study.friction.mu))
  return commented(study, "//")
    .. "// MercuryDPM, SI units. Not run: written from its documentation.\n"
    .. "HertzianViscoelasticMindlinSpecies species;\n"
    .. ("species.setDensity(%s);\n"):format(number(study.pair.projectile.density))
    .. ("species.setEffectiveElasticModulusAndRestitutionCoefficient(%s, %s);\n"):format(number(study.pair.E),
      number(study.constant.e))
    .. friction
end

local function csv(study)
  local list = { "v [m/s],e,e_se,impacts" }
  for _, point in ipairs(study.e) do
    local se = point.e_se == point.e_se and ("%.3g"):format(point.e_se) or ""
    list[#list + 1] = ("%.9g,%.9g,%s,%d"):format(point.v, point.e, se, point.count)
  end
  return commented(study, "#") .. table.concat(list, "\n") .. "\n"
end

-- JSON knows no NaN.
local function json_number(value) return value == value and ("%.9g"):format(value) or "null" end

local function json(study)
  local function object(fields)
    local parts = {}
    for i = 1, #fields, 2 do parts[#parts + 1] = ('"%s": %s'):format(fields[i], fields[i + 1]) end
    return "{ " .. table.concat(parts, ", ") .. " }"
  end
  local function numbers(...)
    local fields = { ... }
    for i = 2, #fields, 2 do fields[i] = json_number(fields[i]) end
    return object(fields)
  end
  local points, c, f = {}, study.constant, study.friction
  for i, p in ipairs(study.e) do points[i] = numbers("v", p.v, "e", p.e, "e_se", p.e_se, "impacts", p.count) end
  local function material(m) return numbers("E", m.E, "nu", m.nu, "density", m.density) end
  return ("{\n  %s\n}\n"):format(table.concat({
    '"units": "SI"',
    '"projectile": ' .. material(study.pair.projectile),
    '"target": ' .. material(study.pair.target),
    '"e": [ ' .. table.concat(points, ",\n         ") .. " ]",
    '"constant_e": ' .. numbers("v", c.v, "e", c.e, "e_se", c.e_se, "exceeds_at_a_third", c.third,
      "exceeds_at_three_times", c.triple),
    '"mu": ' .. numbers("value", f.mu, "se", f.mu_se),
    '"beta0": ' .. numbers("value", f.beta0, "se", f.beta0_se),
  }, ",\n  "))
end

--- The files by what is added to the name.
function dem_lines.of(study)
  return {
    ["_dem.csv"] = csv(study), ["_dem.json"] = json(study), ["_dem.lammps"] = lammps(study),
    ["_dem_yade.py"] = yade(study), ["_dem_mercury.cpp"] = mercury(study),
  }
end

--- What is printed.
function dem_lines.summary(study)
  local list = { ("%12s %10s %10s %8s"):format("v [m/s]", "e", "se", "impacts") }
  for _, p in ipairs(study.e) do
    local se = p.e_se == p.e_se and ("%.2g"):format(p.e_se) or "-"
    list[#list + 1] = ("%12.4g %10.4f %10s %8d"):format(p.v, p.e, se, p.count)
  end
  for _, line in ipairs(head(study)) do list[#list + 1] = line end
  return table.concat(list, "\n")
end

return dem_lines
