-- ricochet.waves: a space-time picture of an impact, and its numbers.
local axes = require "ricochet.axes"
local core = require "ricochet.core"
local gnuplot = require "ricochet.gnuplot"
local rows_of = require("ricochet.rows").rows_of

local quoted = gnuplot.quoted

-- The columns of the rows, as a file holds them.
local function columns_of(units)
  local unit = {}
  for _, quantity in ipairs(core.quantities(units)) do unit[quantity.name] = quantity.unit end
  return {
    { name = "time", unit = unit.time, doc = "since the rims came within reach of each other" },
    { name = "body", unit = "", doc = "1: the projectile, 2: the target" },
    { name = "place", unit = unit.height, doc = "of the slice's middle along the axis, in the first moment" },
    { name = "velocity", unit = unit.vn, doc = "along the axis, the mean of the slice's mass" },
  }
end

-- The rows of each body as a matrix, a line a slice, and where it lies: { rows =, low =, step =, slices = }.
local function matrices(rows)
  local bodies = {}
  for _, row in ipairs(rows) do
    local lines = bodies[row.body] or { of = {}, places = {} }
    bodies[row.body] = lines
    if not lines.of[row.place] then
      lines.of[row.place] = {}
      lines.places[#lines.places + 1] = row.place
    end
    local line = lines.of[row.place]
    line[#line + 1] = row.velocity == row.velocity and ("%.6g"):format(row.velocity) or "NaN"
  end
  return bodies
end

local function draw(t, rows, columns)
  local script = gnuplot.script(t.name)
  local first, last, fastest = rows[1].time, rows[#rows].time, {}
  for _, row in ipairs(rows) do
    if row.velocity == row.velocity then
      fastest[row.body] = math.max(fastest[row.body] or 0, math.abs(row.velocity))
    end
  end
  local panels = {}
  for body, lines in pairs(matrices(rows)) do
    local places, text = lines.places, {}
    for i, place in ipairs(places) do text[i] = table.concat(lines.of[place], " ") end
    local step = #places > 1 and places[2] - places[1] or 1
    local times = #lines.of[places[1]]
    script:data("body" .. body, text)
    panels[#panels + 1] = {
      most = fastest[body] or 0, low = places[1] - step / 2, high = places[#places] + step / 2,
      name = body == 1 and "projectile" or "target",
      plot = ("$body%d matrix using (%.17g + $1 * %.17g):(%.17g + $2 * %.17g):3 with image notitle"):format(body, first,
        (last - first) / math.max(times - 1, 1), places[1], step),
    }
  end
  -- Bodies beside each other along the axis share a panel; those that overlap have one each.
  table.sort(panels, function(p, q) return p.high > q.high end)
  if #panels == 2 and panels[1].low > panels[2].low and panels[1].low >= panels[2].high - 0.1 * (panels[2].high
    - panels[2].low) then
    panels = { { low = panels[2].low, high = panels[1].high, most = math.max(panels[1].most, panels[2].most),
      plot = panels[1].plot .. ", \\\n     " .. panels[2].plot } }
  end
  -- Sets the range and the ticks of an axis; the unit for its label, in the power of ten that the ticks are told in.
  local function told(axis, low, high, column)
    local power = axes.power_of(low, high, column.unit)
    script:add("set %srange [%.17g:%.17g]\n%s", axis, low, high, axes.tics(axis, low, high, power))
    local unit = axes.scaled_unit(column.unit, power)
    return unit ~= "" and (" [" .. unit .. "]") or ""
  end
  local titles = {}
  if t.title then titles[1] = quoted(t.title) end
  if t.caption then titles[#titles + 1] = quoted(t.caption) end
  script:panels {
    count = #panels, width = 800, height = 20 * #titles + (#panels == 1 and 520 or 400 * #panels), font = 12,
    key = "off", title = #titles > 0 and table.concat(titles, '."\\n".') or "''",
    -- Blue and orange about white: those who see no red tell them by blue. Grey: nothing is there.
    axes = "set palette defined (-1 '#0B3C8C', -0.5 '#6FA3DB', 0 '#FFFFFF', 0.5 '#F0A35E', 1 '#9C2A00')\n"
      .. "set object rectangle from graph 0, 0 to graph 1, 1 behind fillcolor rgb '#C8C8C8' fillstyle solid noborder",
    draw = function()
      for _, panel in ipairs(panels) do
        script:add("set xlabel %s", quoted("time" .. told("x", first, last, columns[1])))
        script:add("set cblabel %s", quoted(("velocity along %s%s"):format(t.along,
          told("cb", -panel.most, panel.most > 0 and panel.most or 1, columns[4]))))
        script:add("set ylabel %s", quoted(("%s%s at the first moment%s"):format(panel.name and panel.name .. ", "
          or "", t.along, told("y", panel.low, panel.high, columns[3]))))
        script:add("plot " .. panel.plot)
      end
    end,
  }
  script:draw()
end

local function waves(given)
  local t = core.check("waves", given)
  local units = core.given(t.scene).units or "paper"
  gnuplot.script(t.name)  -- refuses a name that is none
  local rows, columns = core.wave_rows(t), columns_of(units)
  for _, row in ipairs(rows) do
    row.units = units
    core.strict(row, "a row of waves")
  end
  if core.is_check() then return rows_of(rows) end
  if #rows == 0 then core.fail("'scene' holds no body that moves", "scene") end
  core.store_series(t.scene, t.name, columns, rows)
  draw(t, rows, columns)
  return rows_of(rows)
end

return { waves = waves }
