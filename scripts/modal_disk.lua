-- e and contact time of a smooth elastic disk on a hard wall, head on, by the disk's vibrations: no lattice and no
-- simulation, only the theory of Gerl & Zippelius 1999. c is c_P = sqrt(E / (rho (1 - nu^2))), plane stress. Beside the
-- contact time Hayakawa & Kuninaka 2003, section II B, eq. t_c, and Johnson's disk on a plane integrated.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  nu         = { { 0.1, 0.33, 0.45 }, min = 0, max = 0.5, doc = "Poisson's ratios" },
  speed      = { { 0.005, 0.2 }, unit = "c", min = 1e-4, max = 0.3, doc = "from and to" },
  samples    = { 20, int = true, min = 2, doc = "speeds for each nu" },
  omega_most = { 50, unit = "c/R", min = 10, max = 160, doc = "all modes below it" },
  hardness   = { 500, min = 20, doc = "of the wall: alpha R is this over the square root of the speed" },
}

local theory = ricochet.theory
local function speeds()
  local list, from, to = {}, p.speed[1], p.speed[2]
  for i = 0, p.samples - 1 do list[#list + 1] = from * (to / from) ^ (i / (p.samples - 1)) end
  return list
end

-- The three modes that keep most, as "n,l share".
local function leading(impact)
  local order = {}
  for i = 1, #impact.n do order[i] = i end
  table.sort(order, function(a, b) return impact.energy[a] > impact.energy[b] end)
  local words, kept = {}, 1 - impact.e ^ 2
  for i = 1, 3 do
    local mode = order[i]
    words[i] = ("(%d,%d) %.2f"):format(impact.n[mode], impact.l[mode], impact.energy[mode] / kept)
  end
  return table.concat(words, ", ")
end

local e_lines, t_lines, worst = {}, {}, { modes = 0, alpha = 0, step = 0 }
for i, nu in ipairs(p.nu) do
  local name = ("ν = %g"):format(nu)
  e_lines[i], t_lines[i] = { name = name, points = {} }, { name = name, points = {} }
  for _, v in ipairs(speeds()) do
    local impact = theory.modal_disk { nu = nu, speed = v, alpha = p.hardness / math.sqrt(v),
      omega_most = p.omega_most }
    table.insert(e_lines[i].points, { v, impact.e })
    table.insert(t_lines[i].points, { v, impact.contact_time })
    for what in pairs(worst) do worst[what] = math.max(worst[what], impact["error_" .. what]) end
    print(("nu = %.2f, v = %.4f c: e = %.4f, t_c c/R = %.3f, most energy in %s"):format(nu, v, impact.e,
      impact.contact_time, leading(impact)))
  end
end
print(("largest change of e: %.1e by half omega_most, %.1e by half alpha, %.1e by twice the step"):format(worst.modes,
  worst.alpha, worst.step))

table.insert(t_lines, { name = "eq. t_c", f = function(v)
  return theory.disk_log_law { R = 1, E = 1, nu = 0, rho = 1, v = v }.t_c
end })
table.insert(t_lines, { name = "Johnson's law integrated", f = function(v)
  return theory.disk_impact { R = 1, E = 1, nu = 0, rho = 1, v = v }.t_c
end })
ricochet.plot {
  x = "v", y = { "e", "t_c" }, name = "modal_disk", log = "x", xrange = p.speed,
  xlabel = "v / c_P", ylabel = { e = "e", t_c = "t_c c_P / R" },
  theory = { e = e_lines, t_c = t_lines },
  title = "Smooth elastic disk on a hard wall, head on, by its modes",
  caption = ("All modes with ωR/c_P < %g, wall exp(−αy) with αR = %g sqrt(c_P/v). Theory only."):format(p.omega_most,
    p.hardness),
}
