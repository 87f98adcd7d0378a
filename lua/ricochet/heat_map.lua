-- ricochet.heat_map: the mean of a column over two others, as coloured cells.
local core = require "ricochet.core"
local gnuplot = require "ricochet.gnuplot"
local axes = require "ricochet.axes"
local plot = require "ricochet.plot"
local rows_module = require "ricochet.rows"

-- Viridis: even steps for the eye, from dark to light, also for the colour-blind. [van der Walt & Smith 2015]
local viridis = { "#440154", "#482878", "#3E4989", "#31688E", "#26828E", "#1F9E89", "#35B779", "#6DCD59", "#B4DE2C",
  "#FDE725" }
-- What cells have of a picture: a number needs as many pixels. The panel is that large, less its margins.
local width, height, digit, line = 800, 520, 8.5, 18
local inner = { x = width - 252, y = height - 90 }

local function rising(set)
  local list = {}
  for value in pairs(set) do list[#list + 1] = value end
  table.sort(list)
  return list
end

-- The cells along an axis meet in the middle between two values; the outermost are as wide as their neighbours.
local function edges_of(values, log)
  local at, back = log and math.log or function(v) return v end, log and math.exp or function(v) return v end
  local edges, n = {}, #values
  for i = 2, n do edges[i] = back((at(values[i - 1]) + at(values[i])) / 2) end
  local alone = log and math.log(4) or values[1] ~= 0 and math.abs(values[1]) or 1
  local first = n > 1 and at(values[2]) - at(values[1]) or alone
  local last = n > 1 and at(values[n]) - at(values[n - 1]) or first
  edges[1], edges[n + 1] = back(at(values[1]) - first / 2), back(at(values[n]) + last / 2)
  return edges
end

-- An axis of the map: { values =, edges =, log =, pixels = function (i), of cell i }.
local function axis_of(t, summary, letter)
  local column, set = t[letter], {}
  for _, cell in ipairs(summary) do
    local value = cell[column]
    if type(value) ~= "number" then
      core.fail(("'%s' must be a column of numbers, '%s' is not"):format(letter, column), letter)
    end
    set[value] = true
  end
  local axis = { column = column, letter = letter, log = t.log:find(letter) ~= nil, values = rising(set),
    names = t[letter .. "names"] }
  if axis.names and #axis.names ~= #axis.values then
    core.fail(("'%snames' has %d names for %d values of %s"):format(letter, #axis.names, #axis.values, column),
      letter .. "names")
  end
  if axis.log and axis.values[1] <= 0 then
    core.fail(("'log' along %s needs values above 0, %s goes down to %g"):format(letter, column, axis.values[1]), "log")
  end
  axis.edges = edges_of(axis.values, axis.log)
  axis.power = plot.power_of(column, t.rows, axis.edges[1], axis.edges[#axis.edges], axis.log)
  local at = axis.log and math.log or function(v) return v end
  local range = at(axis.edges[#axis.edges]) - at(axis.edges[1])
  function axis.pixels(from, to) return (at(to) - at(from)) / range * inner[letter] end
  return axis
end

-- A tick at each value, if they do not cover each other.
local function tics_of(axis)
  local values, edges, texts = axis.values, axis.edges, {}
  if axis.names then
    for i, value in ipairs(values) do
      local room = axis.letter == "y" and math.huge or axis.pixels(edges[i], edges[i + 1]) / digit - 2
      local lines = plot.wrapped(axis.names[i], room)
      for k, text in ipairs(lines) do lines[k] = gnuplot.quoted(text) end
      axis.lines = math.max(axis.lines or 1, #lines)
      texts[i] = ("%s %.17g"):format(table.concat(lines, ' . "\\n" . '), value)
    end
    return ("set %stics (%s) noenhanced"):format(axis.letter, table.concat(texts, ", "))
  end
  for i, value in ipairs(values) do
    local text = ("%.5g"):format(value / 10 ^ axis.power)
    texts[i] = ("'%s' %.17g"):format(text, value)
    axis.longest = math.max(axis.longest or 0, #text)
    local room = i > 1 and axis.pixels(values[i - 1], value) or math.huge
    if room < (axis.letter == "y" and line or digit * (#text + 1)) then
      return axis.log and axes.log_tics(axis.letter, edges[1], edges[#edges], axis.power)
        or axes.tics(axis.letter, edges[1], edges[#edges], axis.power)
    end
  end
  return ("set %stics (%s)"):format(axis.letter, table.concat(texts, ", "))
end

-- The cells: means, and those that have none, with what is told of all of them.
local function cells_of(t, summary, xs, ys)
  local of, found = {}, { full = {}, empty = {}, finished = 0, failed = 0, se = 0 / 0, low = math.huge,
    high = -math.huge, most = 0, least = math.huge }
  for _, cell in ipairs(summary) do
    of[cell[t.x]] = of[cell[t.x]] or {}
    of[cell[t.x]][cell[t.y]] = cell
    found.finished, found.failed = found.finished + cell.count, found.failed + cell.failed
  end
  for i, x in ipairs(xs.values) do
    for j, y in ipairs(ys.values) do
      local cell = of[x] and of[x][y]
      local s = cell and cell[t.of] or { count = 0 }
      local box = { x = x, y = y, i = i, j = j, mean = s.mean }
      if s.count == 0 then
        found.empty[#found.empty + 1] = box
        found.undefined = found.undefined or cell ~= nil and cell.count > 0
      else
        found.full[#found.full + 1] = box
        found.low, found.high = math.min(found.low, s.mean), math.max(found.high, s.mean)
        found.most, found.least = math.max(found.most, s.count), math.min(found.least, s.count)
        if s.count > 1 and not (s.se <= found.se) then found.se = s.se end
      end
    end
  end
  return found
end

-- A line of gnuplot's data for each cell: middle, edges and mean.
local function boxes(list, xs, ys)
  local lines = {}
  for k, c in ipairs(list) do
    lines[k] = ("%.17g %.17g %.17g %.17g %.17g %.17g %.17g"):format(c.x, c.y, xs.edges[c.i], xs.edges[c.i + 1],
      ys.edges[c.j], ys.edges[c.j + 1], c.mean or 0)
  end
  return lines
end

-- Three digits of the greatest, and as many places of all.
local function format_of(found)
  local most = math.max(math.abs(found.low), math.abs(found.high)) / 10 ^ found.power
  if most >= 1e5 or most < 1e-2 then return "%.2g" end
  return ("%%.%df"):format(math.max(0, 2 - math.floor(math.log(most, 10) + 1e-9)))
end

-- The numbers of the cells, if all have room for them: { dark = lines, light = lines }, by the colour behind.
local function numbers(found, xs, ys)
  local lines, form = { dark = {}, light = {} }, format_of(found)
  local function middle(axis, k)
    local a, b = axis.edges[k], axis.edges[k + 1]
    return axis.log and math.sqrt(a * b) or (a + b) / 2
  end
  for _, c in ipairs(found.full) do
    local text = form:format(c.mean / 10 ^ found.power)
    local fits = xs.pixels(xs.edges[c.i], xs.edges[c.i + 1]) >= digit * (#text + 1)
      and ys.pixels(ys.edges[c.j], ys.edges[c.j + 1]) >= line
    if not fits then return { dark = {}, light = {} } end
    local part = found.high > found.low and (c.mean - found.low) / (found.high - found.low) or 0.5
    table.insert(part < 0.6 and lines.dark or lines.light, ("%.17g %.17g %s"):format(middle(xs, c.i), middle(ys, c.j),
      text))
  end
  return lines
end

local function texts_of(t, found)
  local below = t.caption and plot.wrapped(t.caption, 100) or {}
  if #t.rows > 0 and core.peek(t.rows[1], "status") == nil then return below end  -- data, no impacts
  local over = rows_module.averaged(t.rows, { t.x, t.y })
  local text = ("%d impacts, %d failed"):format(found.finished, found.failed)
  if found.most > 0 then
    text = text .. (found.least == found.most and ("; mean of %d a cell"):format(found.most)
      or ("; mean of %d to %d a cell"):format(found.least, found.most))
  end
  if over ~= "" then text = text .. ", averaged over " .. over end
  if found.se == found.se then text = text .. ("; greatest standard\u{A0}error\u{A0}%.2g%s"):format(
    found.se / 10 ^ found.power, found.unit) end
  for _, part in ipairs(plot.wrapped(text, 100)) do below[#below + 1] = part end
  return below
end

-- What the names or values of a y axis need beside what numbers usually have. [characters]
local function longest(axis)
  local most = axis.longest or 0
  for _, name in ipairs(axis.names or {}) do most = math.max(most, utf8.len(name)) end
  return math.max(0, most - 6)
end

local function draw(t, xs, ys, found)
  local script = gnuplot.script(t.name)
  local tics = { [xs] = tics_of(xs), [ys] = tics_of(ys) }
  local beside = longest(ys)
  found.power, found.unit = plot.power_of(t.of, t.rows, found.low, found.high)
  local parts, shown = {}, numbers(found, xs, ys)
  if #found.full > 0 then
    script:data("cells", boxes(found.full, xs, ys))
    parts[1] = "$cells using 1:2:3:4:5:6:7 with boxxyerror lc palette fs solid 1 noborder notitle"
  end
  if #found.empty > 0 then
    script:data("missing", boxes(found.empty, xs, ys))
    parts[#parts + 1] = ("$missing using 1:2:3:4:5:6 with boxxyerror lc rgb '#808080' fs pattern 4 border title '%s'")
      :format(found.undefined and "no finished row, or none with a value" or "no finished row")
  end
  for kind, colour in pairs { dark = "#FFFFFF", light = "#000000" } do
    if #shown[kind] > 0 then
      script:data(kind, shown[kind])
      parts[#parts + 1] = ("$%s using 1:2:3 with labels font ',11' textcolor rgb '%s' notitle"):format(kind, colour)
    end
  end
  local palette, low, high = {}, found.low, found.high
  for i, colour in ipairs(viridis) do palette[i] = ("%d '%s'"):format(i - 1, colour) end
  if low > high then low, high = 0, 1 end
  local room = high > low and 0 or math.max(1e-9, math.abs(low) / 100)
  low, high = low - room, high + room
  local quoted = gnuplot.quoted
  script:panels {
    count = 1, width = width + math.ceil(beside * digit), font = 12,
    key = "outside top left horizontal Left reverse samplen 2",
    panel = height, title = t.title and quoted(t.title) or "''", has_title = t.title ~= nil, below = texts_of(t, found),
    axes = ("unset grid\nset palette defined (%s)\nset cbrange [%.17g:%.17g]%s"):format(table.concat(palette, ", "),
      low, high, t.log ~= "none" and "\nset logscale " .. t.log or ""),
    draw = function(place)
      place(1)
      script:add("set lmargin %d\nset rmargin 6\nset border 3\nset tics out", 11 + beside)
      for _, axis in ipairs { xs, ys } do
        script:add("set %srange [%.17g:%.17g]", axis.letter, axis.edges[1], axis.edges[#axis.edges])
        script:add(tics[axis])
        -- Names say what they are of.
        local label = axis.names and "" or plot.label(axis.column, t.rows, axis.log, axis.power)
        script:add("set %slabel %s enhanced", axis.letter, quoted(label))
      end
      if xs.lines then script:add("set bmargin %d", 2 + xs.lines) end
      script:add(axes.tics("cb", low, high, found.power))
      script:add("set cblabel %s enhanced", quoted(plot.label(t.of, t.rows, false, found.power)))
      script:add("plot " .. table.concat(parts, ", \\\n     "))
    end,
  }
  script:draw()
end

local function heat_map(given)
  local t = core.check("heat_map", given)
  gnuplot.script(t.name)  -- refuses a name that is none
  if t.x == t.y then core.fail(("'x' and 'y' are both '%s'"):format(t.x), "y") end
  local summary = rows_module.summarise(t.rows, { t.x, t.y }, { t.of }, { by = "x", of = "of" })
  if core.is_check() then return end
  if #t.rows == 0 then core.fail "there are no rows to draw" end
  local xs, ys = axis_of(t, summary, "x"), axis_of(t, summary, "y")
  draw(t, xs, ys, cells_of(t, summary, xs, ys))
end

return { heat_map = heat_map }
