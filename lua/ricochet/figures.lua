-- What the scripts of the paper's figures share: the scene of its section V, the moduli of its lattice, tables of means
-- for the theories, and published points.
local ricochet = require "ricochet"
local walton_fit = require "ricochet.walton_fit"

local figures = {}

--- The contact of the paper's scenes, which its text leaves open: ours. A node weighs m0 (mass = 1).
figures.contact = { V0 = 150, xi = 300, reach = 0.067, sides = "one" }

--- The parameters of a figure: those all share, and the script's own, which come first.
function figures.parameters(own)
  local shared = {
    psi1      = { { 0, 0.5, 1, 2, 3, 4, 5, 6, 7, 8 }, min = 0, doc = "tangents of the incident angle, rising" },
    samples   = { 100, int = true, min = 1, doc = "random lattices per angle" },
    standard_error = { 0, min = 0, doc = "wanted of the mean e at every angle, instead of `samples`; 0: none" },
    seeds     = { 0, int = true, min = 0, doc = "added to every sample's seed: other lattices of the same kind" },
    nodes     = { 800, int = true, min = 40, doc = "of the disk; the wall has five times as many" },
    speed     = { 0.1, unit = "c", min = 1e-6, doc = "impact speed" },
    roughness = { 0.03, unit = "R", min = 0, max = 0.2, doc = "standard deviation of the rims" },
    placement = { "poisson_disk", choices = { "poisson_disk", "uniform" }, doc = "how the nodes are placed" },
    method    = { "auto", choices = { "auto", "pefrl", "forest_ruth", "verlet" },
      doc = "integrator; the paper's is forest_ruth" },
    step      = { 0, unit = "R/c", min = 0, doc = "time step; 0 chooses one (the paper's is 0.001)" },
    accuracy  = { 1e-3, min = 0, max = 0.1, doc = "wanted error of e from the time step, which chooses method and " ..
      "step; 0: none" },
  }
  for name, parameter in pairs(own or {}) do shared[name] = parameter or nil end
  return shared
end

--- Hayakawa & Kuninaka's section V: a rough disk strikes a rough wall five times as large, `ratio` times as stiff. p:
--- the parameters above. `at`: sample and launch; nodes, if not p's; mass of a node [m0], if not 1.
function figures.scene(p, ratio, at)
  local nodes, mass = at.nodes or p.nodes, at.mass or 1
  local seed = at.sample + (p.seeds or 0)
  local timed = p.step == 0 and p.accuracy > 0 and p.method == "auto"
  return ricochet.scene {
    projectile = ricochet.disk { nodes = nodes, mass = mass, stiffness = 1e4, placement = p.placement,
      roughness = p.roughness, seed = seed },
    target = ricochet.wall { nodes = 5 * nodes, mass = mass, stiffness = 1e4 * ratio, placement = p.placement,
      roughness = p.roughness, seed = seed },
    launch = at.launch,
    contact = figures.contact,
    method = p.method,
    step = p.step > 0 and p.step or nil,
    accuracy = timed and p.accuracy or nil,
  }
end

--- The sweep of such scenes over samples and angles, at the same speed or, with `normal_speed`, at the same normal
--- speed; with p.standard_error as many samples of each angle as that takes.
function figures.sweep(p, name, ratio, normal_speed)
  local wanted = (p.standard_error or 0) > 0 and p.standard_error or nil
  return ricochet.sweep {
    name = name,
    over = { sample = not wanted and ricochet.range(p.samples) or nil, psi1 = p.psi1 },
    samples = wanted and "by_error", standard_error = wanted,
    scene = function(at)
      local launch = normal_speed and { normal_speed = normal_speed, tangential_speed = normal_speed * at.psi1 }
        or { speed = p.speed, psi1 = at.psi1 }
      return figures.scene(p, ratio, { sample = at.sample, launch = launch })
    end,
  }
end

--- Young's modulus, Poisson's ratio and density of the disk's lattice, from bands of the same density. A lattice in the
--- plane has the moduli of plane stress: E is its E* against a rigid wall, and the plane-strain formulas of the
--- theories take nu_strain = nu/(1 + nu).
function figures.material(p, nodes, stiffness, bands)
  local density, E, nu = (nodes or p.nodes) / math.pi, 0, 0
  local w, h = 1.5, 6
  for sample = 1, bands or 4 do
    local band = ricochet.body { outline = { { 0, 0 }, { w, 0 }, { w, h }, { 0, h } },
      nodes = math.ceil(density * w * h), stiffness = stiffness or 1e4, placement = p.placement, seed = sample }
    local moduli = ricochet.elasticity { body = band }
    E, nu = E + moduli.E / (bands or 4), nu + moduli.nu / (bands or 4)
  end
  return { E = E, nu = nu, nu_strain = nu / (1 + nu), rho = density }
end

--- A column of all finished rows in which each of the columns is a number.
function figures.columns(rows, names)
  local lists = {}
  for _, name in ipairs(names) do lists[name] = {} end
  for _, row in ipairs(rows) do
    local whole = row.status == "finished"
    for _, name in ipairs(names) do whole = whole and row[name] == row[name] end
    if whole then
      for _, name in ipairs(names) do table.insert(lists[name], row[name]) end
    end
  end
  return lists
end

--- The means of columns at each value of `by`, in rising order, where each has one.
function figures.means(rows, by, names)
  local lists = { [by] = {} }
  for _, name in ipairs(names) do lists[name] = {} end
  for _, line in ipairs(rows:summary { by = by, of = names }) do
    local whole = true
    for _, name in ipairs(names) do whole = whole and line[name].count > 0 end
    if whole then
      table.insert(lists[by], line[by])
      for _, name in ipairs(names) do table.insert(lists[name], line[name].mean) end
    end
  end
  return lists
end

--- 1 + M R^2/I of the rows' own projectiles, on average: 3 of a homogeneous disk.
function figures.beta_x(rows)
  local sum, count = 0, 0
  for _, row in ipairs(rows) do
    if row.status == "finished" then sum, count = sum + 1 + 1 / row.inertia, count + 1 end
  end
  return sum / count
end

--- The run's own tilted-surface curves: the chain of section V C from its mean mu, |x_c - x_a|, e and Psi2. e_alpha is
--- that of the mean velocities against the normal turned by the theory's own tan(alpha): v_c' = (Psi2, e), v_c = (Psi1,
--- -1) along (-tan(alpha), 1). (The column e_alpha of a row is against the chord of its own rough contact, whose slope
--- scatters so much that its mean is undefined at grazing angles.) Returns lists of points: as printed; with the
--- friction angle turned with the surface; as printed with the e_alpha of the first angle throughout, as in Kuninaka &
--- Hayakawa 2004. `at`: functions of the same, of the run's angles, and tan_alpha.
function figures.tilted(rows, nu_strain)
  local theory = ricochet.theory
  local m = figures.means(rows, "psi1", { "mu", "centre_offset", "e", "psi2" })
  if #m.psi1 < 2 then return nil end
  local beta_x = figures.beta_x(rows)
  local offset, e_alpha, first_e_alpha, slope = {}, {}, {}, {}
  for i, psi1 in ipairs(m.psi1) do
    offset[i] = math.min(m.centre_offset[i], 2)
    slope[psi1] = theory.tilted_surface { psi1 = psi1, mu = m.mu[i], e_alpha = 1, offset = offset[i],
      nu = nu_strain, beta_x = beta_x }.tan_alpha
    e_alpha[i] = (m.e[i] - m.psi2[i] * slope[psi1]) / (1 + psi1 * slope[psi1])
    first_e_alpha[i] = e_alpha[1]
  end
  local places, first, last = {}, m.psi1[1], m.psi1[#m.psi1]
  for k = 0, 100 do places[k + 1] = math.min(last, first + (last - first) * k / 100) end
  local result = { e_alpha = e_alpha, at = { tan_alpha = function(psi1) return slope[psi1] end } }
  for name, variant in pairs { printed = { e_alpha, "e" }, rotated = { e_alpha, "e_rotated" },
      constant = { first_e_alpha, "e" } } do
    local given = { psi1 = m.psi1, mu = m.mu, e_alpha = variant[1], offset = offset, nu = nu_strain, beta_x = beta_x,
      at = places }
    local curve, points, there = theory.tilted_curve(given)[variant[2]], {}, {}
    for k, x in ipairs(places) do points[k] = { x, curve[k] } end
    given.at = m.psi1
    for k, e in ipairs(theory.tilted_curve(given)[variant[2]]) do there[m.psi1[k]] = e end
    result[name], result.at[name] = points, function(psi1) return there[psi1] end
  end
  return result
end

--- Walton's parameters of the rows, printed with their standard errors, those of a jackknife over samples.
function figures.fit(rows)
  local columns = figures.columns(rows, { "psi1", "psi2", "e", "sample" })
  local fit = walton_fit(columns, figures.beta_x(rows))
  print(("fit of %d impacts: e = %.4f +- %.4f, mu = %.4f +- %.4f, beta0 = %.3f +- %.3f; " ..
    "sliding from Psi1 = %.2f on"):format(
    #columns.psi1, fit.e, fit.e_se, fit.mu, fit.mu_se, fit.beta0, fit.beta0_se, fit.psi1_0))
  return fit
end

--- Prints how far a theory is from the means of a column: at each value of `by`, and the root of the mean square,
--- absolute and in standard errors.
function figures.compare(rows, by, column, name, theory)
  local square, scaled, n, worst, where = 0, 0, 0, 0, nil
  for _, line in ipairs(rows:summary { by = by, of = { column } }) do
    local value, s = theory(line[by]), line[column]
    if value and value == value and s.count > 0 then
      local off = value - s.mean
      n, square = n + 1, square + off * off
      if s.count > 1 and s.se > 0 then scaled = scaled + (off / s.se) ^ 2 end
      if math.abs(off) > math.abs(worst) then worst, where = off, line[by] end
    end
  end
  if n > 0 then
    where = where or 0 / 0  -- every one is met exactly
    print(("%s against %s: root mean square %.3g (%.2g standard errors) at %d values of %s, " ..
      "greatest %+.3g at %.4g"):format(name, column, math.sqrt(square / n), math.sqrt(scaled / n), n, by, worst, where))
  end
end

--- "rims of 0.03 R, 800 + 4000 nodes, ..." for captions.
function figures.caption(p, ratio)
  local by_error = (p.standard_error or 0) > 0
  local samples = by_error and ("as many lattices an angle as e ± %g takes"):format(p.standard_error)
    or ("%d lattices an angle"):format(p.samples)
  return ("Stiffness of the wall %g of the disk's, rims of %g R, %d + %d nodes (%s), %s."):format(ratio, p.roughness,
    p.nodes, 5 * p.nodes, p.placement, samples)
end

-- Finite elements: sphere, mu = 0.3, nu = 0.3, e = 1; {v_ct/(mu v_n), v_ct'/(mu v_n)}. [Chung & Ooi 2011, test 5]
figures.finite_elements = { { 0.586, -0.027 }, { 1.190, -0.213 }, { 1.915, -0.627 }, { 2.785, -1.253 },
  { 3.970, -1.720 }, { 5.758, -1.200 }, { 9.118, 2.147 } }
-- 5 mm Al2O3 sphere on glass, 3.9 m/s, mu = 0.092, against the incident angle in degrees, digitised: v_t'/v_t of the
-- centre; spin in rad/s; angle of the contact point's rebound, tan = v_ct'/v_n', in degrees. By spin = (5/2) v_t (1 -
-- e_t)/R the columns agree to 8 % in spin and to 0.9 degrees up to 30; from 50 on that of the contact point is 1 to 3
-- degrees above what the others say (scripts/kharaz.lua). rebound: the angle at which the centre leaves, tan =
-- v_t'/v_n', of another reading of the same figures, as e_t at 60 degrees is; by it the other columns differ by 0.003,
-- 7 rad/s and 0.6 degrees of incidence. [Kharaz, Gorham & Salman 2001]
figures.kharaz = {
  e_t = { { 2.24, 0.797 }, { 4.22, 0.746 }, { 9.84, 0.675 }, { 20.22, 0.599 }, { 30.36, 0.690 }, { 39.54, 0.774 },
    { 49.60, 0.848 }, { 60.02, 0.901 }, { 71.07, 0.937 }, { 79.23, 0.970 }, { 85.17, 0.979 } },
  spin = { { 5.90, 134.9 }, { 10.87, 261.2 }, { 21.12, 573.7 }, { 31.14, 612.2 }, { 38.95, 595.1 }, { 50.24, 449.5 },
    { 60.10, 375.7 }, { 69.96, 243.0 }, { 78.56, 142.4 }, { 84.32, 70.6 } },
  contact = { { 2.10, 0.77 }, { 3.94, 0.77 }, { 9.72, -1.06 }, { 20.31, -8.53 }, { 30.16, -2.55 }, { 39.12, 9.91 },
    { 49.51, 30.02 }, { 59.90, 49.95 }, { 70.46, 66.90 }, { 78.86, 78.87 }, { 84.78, 85.68 } },
  rebound = { { 2.15, 1.73 }, { 4.10, 2.96 }, { 9.83, 6.52 }, { 20.57, 12.21 }, { 30.29, 21.67 }, { 39.54, 32.61 },
    { 49.75, 45.13 }, { 60.21, 57.47 } },
}
-- Force [N], overlap [m], contact time [s]. [Chung & Ooi 2011, tests 1 and 2]
figures.benchmarks = {
  { name = "limestone spheres, +-10 m/s", R = 0.01, E = 20e9, nu = 0.25, rho = 2500, v = 20, pair = true, F = 7108,
    h0 = 368.3e-6, t_c = 54.20e-6 },
  { name = "glass spheres, +-10 m/s", R = 0.01, E = 48e9, nu = 0.20, rho = 2800, v = 20, pair = true, F = 10697,
    h0 = 274.1e-6, t_c = 40.34e-6 },
  { name = "Mg alloy on a rigid plane, 0.2 m/s", R = 0.1, E = 40e9, nu = 0.35, rho = 1800, v = 0.2, F = 7233,
    h0 = 52.12e-6, t_c = 767.1e-6 },
}

return figures
