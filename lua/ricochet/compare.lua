-- ricochet.compare: one impact with the projectile of springs, of elements and of modes, of the same outline, moduli
-- and density, side by side.
local core = require "ricochet.core"
local gnuplot = require "ricochet.gnuplot"
local moduli = require "ricochet.moduli"
local series = require("ricochet.series").series
local text = require "ricochet.compare_text"

-- What only springs know, and only elements; modes know those of what they are of, and their number.
local of_springs = { "stiffness", "quartic", "prestress", "mass" }
local of_mesh = { "h_min", "h_max", "grade", "fine_within", "fine_at" }
local of_elements = { "E", "nu", "law", table.unpack(of_mesh) }
local of_modes = { "modes", "modes_of" }

-- A body's fields without some.
local function without(fields, ...)
  local rest = {}
  for name, value in pairs(fields) do rest[name] = value end
  for _, names in ipairs { ... } do
    for _, name in ipairs(names) do rest[name] = nil end
  end
  return rest
end

-- The area of what an outline encloses, less that of its holes.
local function area_of(body)
  local function enclosed(points)
    local twice, last = 0, points[#points]
    for _, p in ipairs(points) do
      twice, last = twice + last[1] * p[2] - p[1] * last[2], p
    end
    return math.abs(twice) / 2
  end
  local area = enclosed(body.outline)
  for _, hole in ipairs(body.holes or {}) do area = area - enclosed(hole) end
  return area
end

local function refuse(message) core.fail("the projectile " .. message, "scene") end

-- The projectile of the scene, with what every interior is to have.
local function original_of(scene)
  local body = core.given(scene).projectile
  local fields = core.given(body)
  local t = core.check("body", fields, true)
  if t.state == "axisymmetric" then refuse "is axisymmetric, which lattices and modes cannot be" end
  for _, field in ipairs { "stiffness", "E", "nu", "density", "anchored" } do
    if type(fields[field]) == "function" then refuse(("has a function as its %s; give a number"):format(field)) end
  end
  if fields.points then refuse "has nodes that were given one by one, which suit one interior alone" end
  local area = area_of(fields)
  fields.interior, fields.placement = t.interior, t.h_min == nil and t.placement or nil
  return {
    fields = fields, area = area, nodes = core.nodes_of(body), material = t.material,
    is_lattice = t.interior == "springs" or (t.interior == "modes" and t.modes_of == "springs"),
    density = t.material and t.material.density or t.mass and t.mass * core.nodes_of(body) / area or t.density
      or 800 / math.pi,
  }
end

-- The moduli that all are to have: those of the scene's projectile.
local function asked_moduli(original)
  if original.material then return nil, nil end
  local fields = original.fields
  if not original.is_lattice then return fields.E, fields.nu end
  return moduli.of(fields, original.nodes / original.area)
end

-- The corner of a body's outline that lies lowest once the body is turned.
local function lowest(fields)
  local angle, found, least = math.rad(fields.angle or 0), nil, math.huge
  for _, p in ipairs(fields.outline) do
    local height = math.sin(angle) * p[1] + math.cos(angle) * p[2]
    if height < least then found, least = p, height end
  end
  return found
end

-- What each interior is of, beside what the user gives it alone.
local function made_of(original, interior, own)
  local fields = original.fields
  if interior == fields.interior then
    fields = without(fields, {})  -- as the scene has it
  elseif interior == "springs" then
    fields = without(fields, original.is_lattice and of_modes or of_springs, of_elements, of_modes)
  else
    fields = without(fields, of_springs, original.is_lattice and of_elements or of_modes, of_modes)
    fields.E, fields.nu = original.E, original.nu
    if interior == "modes" then
      fields.modes_of = "elements"
      fields.law = nil  -- small vibrations are those of every law
    end
  end
  fields.interior = interior
  fields.mass = (interior == "springs" or fields.modes_of == "springs") and fields.mass or nil
  if not (original.material or fields.mass) then fields.density = original.density end
  own = own or {}
  if own.nodes and not own.h_min then fields = without(fields, of_mesh) end
  for name, value in pairs(own) do
    if name == "interior" or name == "outline" or name == "material" then
      core.fail(("'%s' is of the scene's projectile, the same for all"):format(name), interior, name)
    end
    fields[name] = value
  end
  if fields.h_min then
    fields.nodes, fields.placement, fields.margin, fields.rim_spacing = nil, nil, nil, nil
    fields.fine_at = fields.fine_at or lowest(fields)
  end
  return fields
end

-- Springs of a stiffness that gives a band the modulus that is asked for.
local function stiffened(fields, original, nodes_an_area)
  if original.material or (original.is_lattice and fields.placement == original.fields.placement) then return end
  local unit = without(fields, {})
  unit.stiffness, unit.quartic = 1, 0
  fields.stiffness = original.E / moduli.of(unit, nodes_an_area)
end

local function scene_of(scene, fields, xi)
  local t = core.given(scene)
  t.projectile = core.own_body(fields)
  local contact = {}
  for name, value in pairs(t.contact or {}) do contact[name] = value end
  contact.xi = contact.xi or xi
  t.contact, t.accuracy, t.step, t.theta, t.method = contact, nil, nil, nil, nil
  return core.functions.scene(t)
end

-- What a correct digit of e costs: the impact at its usual step beside a quarter of it.
local function cost_of(scene, row)
  local method = core.conflict(scene, "pefrl") == "" and "pefrl" or "verlet"
  local specs = {}
  for i, share in ipairs { 1, 0.25 } do specs[i] = { method = method, step = share * row.step } end
  local runs = core.accuracy_runs(scene, specs, 1)
  local cost = { method = method, seconds = runs[1].wall_seconds, error = 0 / 0, a_digit = 0 / 0 }
  if runs[1].status == "finished" and runs[2].status == "finished" then
    cost.error = math.max(math.abs(runs[1].e - runs[2].e), 1e-15)
    cost.a_digit = cost.seconds / math.max(-math.log(cost.error, 10), 1)
  end
  return cost
end

-- Until the bodies first part: of a tilted body the rest of the run is flight.
local function greatest_force(scene, time, name)
  local rows = series { scene = scene, of = { "force_n", "vn", "overlap" }, points = 2000, duration = time,
    name = name }
  local most = 0
  for _, row in ipairs(rows) do most = math.max(most, row.force_n) end
  return most
end

-- The energies of modes { omega =, share = } by rising omega: those next to each other whose omega differ by less than
-- 2 % as one, a disk's pairs above all; the ten that hold most, the fullest first.
local function strongest(modes)
  local groups, last = {}, nil
  for _, mode in ipairs(modes) do
    if last and mode.omega < 1.02 * last.omega then
      last.share, last.modes = last.share + mode.share, last.modes + 1
    else
      last = { omega = mode.omega, share = mode.share, modes = 1 }
      groups[#groups + 1] = last
    end
  end
  table.sort(groups, function(a, b) return a.share > b.share end)
  return { table.unpack(groups, 1, 10) }
end

-- One impact of a projectile that moves as given.
local function entry_of(t, original, interior, xi)
  local fields = made_of(original, interior, t[interior])
  local body = core.own_body(fields)
  local nodes = core.nodes_of(body)
  if interior == "springs" then
    stiffened(fields, original, nodes / original.area)
    body = core.own_body(fields)
  end
  local is_linear = interior == "modes" or (interior == "elements" and fields.law == "linear")
  local entry = { interior = interior, density = original.density, nodes = nodes, is_linear = is_linear }
  entry.E, entry.nu = moduli.of(fields, nodes / original.area)
  entry.wave_speed = math.sqrt(entry.E / (entry.density * (1 - entry.nu ^ 2)))
  entry.scene = scene_of(t.scene, fields, xi)
  local row = entry.scene:run()
  if core.is_check() then return entry end
  if row.status ~= "finished" then
    core.fail(("with %s the impact ends %s: %s"):format(interior, row.status, row.reason), "scene")
  end
  entry.row = row
  entry.speed = math.abs(row.vn / row.e)  -- normal, before
  for _, column in ipairs { "e", "contact_time", "contact_time_energy", "inverted" } do entry[column] = row[column] end
  entry.force = greatest_force(entry.scene, row.time_first, t.name .. "_" .. interior)
  local rings = core.functions.ringing { scene = entry.scene, count = math.min(t.count, 2 * nodes - 3) }
  for _, mode in ipairs(rings) do mode.omega = mode.omega / entry.wave_speed end
  entry.ringing = strongest(rings)
  entry.cost = cost_of(entry.scene, row)
  return entry
end

-- The radius of a disk whose impact theory.modal_disk tells.
local function exact_radius(t, original)
  local given = core.given(t.scene)
  local launch, radius = given.launch or {}, nil
  local is_round = #original.fields.outline > 40  -- no polygon
  for _, p in ipairs(original.fields.outline) do
    local r = math.sqrt(p[1] ^ 2 + p[2] ^ 2)
    radius = radius or r
    is_round = is_round and math.abs(r / radius - 1) < 1e-9
  end
  local is_smooth = not original.fields.holes and (original.fields.roughness or 0) == 0
  local is_head_on = not (launch.psi1 or launch.angle or launch.tangential_speed or launch.height or launch.spin)
  if not (is_round and is_smooth and is_head_on and #(given.effects or {}) == 0
    and next(core.given(given.target)) == nil) then
    core.fail("'omega_most' is of a smooth disk, head on to a plane, without effects; leave it out", "omega_most")
  end
  return radius
end

-- That disk by its modes in closed form, with the moduli and the contact of another entry: by those below omega_most
-- and below half of it, from which follows what all give, whose lack falls as 1/omega_most.
local function exact_of(t, radius, like)
  local c = like.wave_speed
  local function impact(omega_most)
    return core.theory.modal_disk { nu = like.nu, speed = like.speed / c, alpha = like.row.xi * radius,
      omega_most = omega_most }
  end
  local whole = impact(t.omega_most)
  local is_enough, half = pcall(impact, t.omega_most / 2)
  if not is_enough then half = whole end  -- too few for so hard a wall: not extrapolated
  local function of_all(few, many) return 2 * many - few end
  local energy_by_few = {}
  for k in ipairs(half.omega) do energy_by_few[half.n[k] .. " " .. half.l[k]] = half.energy[k] end
  local modes = {}
  for k, omega in ipairs(whole.omega) do
    local few = energy_by_few[whole.n[k] .. " " .. whole.l[k]] or whole.energy[k]
    modes[k] = { omega = omega / radius, share = of_all(few, whole.energy[k]) }
  end
  table.sort(modes, function(a, b) return a.omega < b.omega end)
  return {
    interior = is_enough and "exact" or "nearly exact", E = like.E, nu = like.nu, density = like.density,
    wave_speed = c, nodes = 0, is_linear = true, speed = like.speed,
    e = of_all(half.e, whole.e), contact_time = 0 / 0,
    contact_time_energy = of_all(half.contact_time, whole.contact_time) * radius / c, force = 0 / 0, inverted = 0,
    ringing = strongest(modes),
  }
end

local known = { springs = true, elements = true, modes = true }

local function check_interiors(interiors)
  local seen = {}
  for _, interior in ipairs(interiors) do
    if not known[interior] then
      local near = core.did_you_mean(interior, { "springs", "elements", "modes" })
      core.fail(("'interiors' holds springs, elements and modes, not '%s'%s"):format(interior, near), "interiors")
    end
    if seen[interior] then core.fail(("'interiors' names %s twice"):format(interior), "interiors") end
    seen[interior] = true
  end
  if #interiors < 2 then core.fail("'interiors' needs two or more to compare", "interiors") end
end

local function compare(given)
  local t = core.check("compare", given)
  gnuplot.script(t.name)  -- refuses a name that is none
  check_interiors(t.interiors)
  local original = original_of(t.scene)
  original.E, original.nu = asked_moduli(original)
  local radius = t.omega_most and exact_radius(t, original)
  local list, xi = {}, nil
  for i, interior in ipairs(t.interiors) do
    list[i] = entry_of(t, original, interior, xi)
    xi = xi or (list[i].row and list[i].row.xi)
  end
  if core.is_check() then return nil end
  if radius then list[#list + 1] = exact_of(t, radius, list[#list]) end
  text.print(list)
  core.functions["file.write"](t.name .. ".csv", text.csv(list))
  for _, entry in ipairs(list) do core.strict(entry, "an entry of compare") end
  return list
end

return { compare = compare }
