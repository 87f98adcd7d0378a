-- ricochet.waves: a space-time picture of an impact, and its numbers.
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
  local first, last, most = rows[1].time, rows[#rows].time, 0
  for _, row in ipairs(rows) do
    if row.velocity == row.velocity then most = math.max(most, math.abs(row.velocity)) end
  end
  local parts, low, high = {}, math.huge, -math.huge
  for body, lines in pairs(matrices(rows)) do
    local places, text = lines.places, {}
    for i, place in ipairs(places) do text[i] = table.concat(lines.of[place], " ") end
    local step = #places > 1 and places[2] - places[1] or 1
    local times = #lines.of[places[1]]
    low, high = math.min(low, places[1] - step / 2), math.max(high, places[#places] + step / 2)
    script:data("body" .. body, text)
    parts[#parts + 1] = ("$body%d matrix using (%.17g + $1 * %.17g):(%.17g + $2 * %.17g):3 with image notitle"):format(
      body, first, (last - first) / math.max(times - 1, 1), places[1], step)
  end
  local function label(column) return column.unit ~= "" and (" [" .. column.unit .. "]") or "" end
  local titles = {}
  if t.title then titles[1] = quoted(t.title) end
  if t.caption then titles[#titles + 1] = quoted(t.caption) end
  script:panels {
    count = 1, width = 800, height = 520 + 20 * #titles, font = 12, key = "off",
    title = #titles > 0 and table.concat(titles, '."\\n".') or "''",
    -- Blue and red about white: those who see no red tell them by blue.
    axes = "set palette defined (-1 '#0B3C8C', -0.5 '#6FA3DB', 0 '#FFFFFF', 0.5 '#F0A35E', 1 '#9C2A00')",
    draw = function()
      script:add("set xrange [%.17g:%.17g]\nset yrange [%.17g:%.17g]", first, last, low, high)
      script:add("set cbrange [%.17g:%.17g]", -most, most > 0 and most or 1)
      script:add("set xlabel %s\nset ylabel %s", quoted("time" .. label(columns[1])),
        quoted(t.along .. " at the first moment" .. label(columns[3])))
      script:add("set cblabel %s", quoted(("velocity along %s%s"):format(t.along, label(columns[4]))))
      script:add("plot " .. table.concat(parts, ", \\\n     "))
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
