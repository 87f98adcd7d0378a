-- Rows of a sweep: an array of tables, one an impact, with summaries.
local core = require "ricochet.core"
local bootstrap = require "ricochet.bootstrap"
local long_rows = require "ricochet.long_rows"
local outcomes = require "ricochet.outcomes"
local paired = require "ricochet.paired"
local power_law = require "ricochet.power_law"
local statistics = require "ricochet.statistics"
local is_data = statistics.is_data

local Rows, Summary = { __name = "rows", __metatable = false }, { __name = "a summary", __metatable = false }
Summary.__index = function(summary, name)
  if type(name) == "number" then
    if name == #summary + 1 then return nil end  -- where ipairs ends
    core.fail_here(("there is no group %s; the summary has 1 to %d"):format(tostring(name), #summary))
  end
  return rawget(Summary, name) or core.unknown("a summary", name, { "print" })
end
Rows.__index = function(rows, name)
  if type(name) == "number" then
    local long = long_rows.of(rows)
    if long and math.tointeger(name) and name >= 1 and name <= long.count then return long.row(math.tointeger(name)) end
    if name == #rows + 1 then return nil end  -- where ipairs ends
    core.fail_here(("there is no row %s; the rows are 1 to %d"):format(tostring(name), #rows))
  end
  if rawget(Rows, name) then return rawget(Rows, name) end
  if #rows > 0 and core.peek(rows[1], name) ~= nil then
    core.fail_here(("'%s' is a column of each row: rows[i].%s"):format(name, name))
  end
  core.unknown("the table of rows", name, { "summary", "where", "power_law", "paired", "peak", "save" })
end
Rows.__len = function(rows)
  local long = long_rows.of(rows)
  return long and long.count or rawlen(rows)
end
Rows.__newindex = function(rows, name, value)
  local long = long_rows.of(rows)
  if long and math.type(name) and not (math.tointeger(name) and name >= 1 and name <= long.count) then
    core.fail_here(("there is no row %s; the rows are 1 to %d"):format(tostring(name), #rows))
  end
  rawset(rows, name, value)
end
Rows.__pairs = function(rows)
  if not long_rows.of(rows) then return next, rows, nil end
  return ipairs(rows)
end
-- The list itself of rows that are read from a file; nil of others.
function Rows.whole(rows)
  if not long_rows.of(rows) then return nil end
  local list = {}
  for i, row in ipairs(rows) do list[i] = row end
  return list
end
Rows.__call = function() core.fail_here "rows are a list; write: for _, row in ipairs(rows) do" end

local function known_column(rows, name, ...)
  if #rows == 0 or core.peek(rows[1], name) ~= nil then return end
  local names = {}
  for column in pairs(rows[1]) do names[#names + 1] = column end
  core.fail(("the rows have no column '%s'%s"):format(name, core.did_you_mean(name, names)), ...)
end

local function is_less(a, b)
  if type(a) == "boolean" then return a and not b end
  return a < b
end

-- Groups of finished rows by columns, in rising order: { { keys, members = {...}, failed = n }, ... }.
local function groups(rows, by)
  local list, of = {}, {}
  for _, row in ipairs(rows) do
    local keys, at = {}, of
    for i, column in ipairs(by) do
      local key = row[column]
      if key ~= key then core.fail(("column '%s' is undefined in some rows and cannot group them"):format(column)) end
      keys[i], at[key] = key, at[key] or {}
      at = at[key]
    end
    if not at.group then
      at.group = { keys = keys, members = {}, failed = 0 }
      list[#list + 1] = at.group
    end
    local group = at.group
    if is_data(row) then group.members[#group.members + 1] = row else group.failed = group.failed + 1 end
  end
  table.sort(list, function(a, b)
    for i, key in ipairs(a.keys) do
      if key ~= b.keys[i] then return is_less(key, b.keys[i]) end
    end
    return false
  end)
  return list
end

-- Mean, deviation, standard error, count and units of a column of these rows.
local function statistics_of(members, column)
  for _, row in ipairs(members) do
    if type(row[column]) ~= "number" then core.fail(("column '%s' holds no numbers"):format(column)) end
  end
  return statistics.of_units(members, column)
end

-- What a sweep varied in its rows, and in which units: { names =, units = } of a list of rows.
local varied = setmetatable({}, { __mode = "k" })

-- The unit that a sweep gave its own parameter.
local function unit_of(rows, column) return varied[rows] and (varied[rows].units or {})[column] end

-- What means by some columns are taken over: "sample (8 values), rough (2 values)"; "" if nothing else varies.
local function averaged(rows, by)
  local parts, grouped = {}, {}
  for _, column in ipairs(by) do grouped[column] = true end
  for _, name in ipairs(outcomes.shared) do grouped[name] = grouped[name] or grouped["over_" .. name] end
  for _, name in ipairs(varied[rows] and varied[rows].names or {}) do
    local count, seen = 0, {}
    for _, row in ipairs(rows) do
      local value = core.peek(row, name)  -- rows that a script put there may lack it
      if value == value and value ~= nil and not seen[value] then count, seen[value] = count + 1, true end
    end
    if not grouped[name] and count > 1 then parts[#parts + 1] = ("%s (%d values)"):format(name, count) end
  end
  return table.concat(parts, ", ")
end

-- `fields`: what the user's call names `by` and `of`, for its mistakes.
local function summarise(rows, by, of, fields)
  for _, column in ipairs(by) do known_column(rows, column, fields.by) end
  for _, column in ipairs(of) do
    known_column(rows, column, fields.of)
    for _, grouped in ipairs(by) do
      if column == grouped then core.fail(("'%s' is what the rows are grouped by"):format(column), fields.of) end
    end
  end
  -- Of columns in the rows' units; nothing of those that a script added.
  local units = outcomes.units(rows[1] and core.peek(rows[1], "units"))
  local summary = setmetatable({ by = by, of = of, units = units, over = averaged(rows, by) }, Summary)
  for i, group in ipairs(groups(rows, by)) do
    local line = { count = #group.members, failed = group.failed }
    for k, column in ipairs(by) do line[column] = group.keys[k] end
    for _, column in ipairs(of) do line[column] = statistics_of(group.members, column) end
    summary[i] = line
  end
  return summary
end

Rows.summary = core.wrap(function(self, given)
  if not core.is(self, Rows) then core.fail "is a method of rows: write rows:summary { ... }, with a colon" end
  local t = core.check("rows:summary", given)
  return summarise(self, type(t.by) == "string" and { t.by } or t.by, t.of, { by = "by", of = "of" })
end)

-- The column whose equal values share a lattice: that which the call names, sample if the rows have it, else seed.
local function lattice_column(rows, named)
  if named then known_column(rows, named, "unit") end
  return named or #rows > 0 and core.peek(rows[1], "sample") ~= nil and "sample" or "seed"
end

Rows.paired = core.wrap(function(self, given)
  if not core.is(self, Rows) then core.fail "is a method of rows: write rows:paired { ... }, with a colon" end
  local t = core.check("rows:paired", given)
  known_column(self, t.by, "by")
  known_column(self, t.of, "of")
  if #t.at ~= 2 then core.fail(("'at' takes two values of %s, has %d"):format(t.by, #t.at), "at") end
  return core.strict(paired(self, t.by, t.of, t.at, lattice_column(self, t.unit)), "the table of a paired difference")
end)

Rows.power_law = core.wrap(function(self, given)
  if not core.is(self, Rows) then core.fail "is a method of rows: write rows:power_law { ... }, with a colon" end
  local t = core.check("rows:power_law", given)
  known_column(self, t.x, "x")
  known_column(self, t.y, "y")
  local unit = lattice_column(self, t.unit)
  local list = {}
  for _, row in ipairs(self) do
    if is_data(row) then list[#list + 1] = row end
  end
  return core.strict(power_law(list, t.x, t.y, unit), "the table of a power law")
end)

Rows.peak = core.wrap(function(self, given)
  if not core.is(self, Rows) then core.fail "is a method of rows: write rows:peak { ... }, with a colon" end
  local t = core.check("rows:peak", given)
  known_column(self, t.x, "x")
  known_column(self, t.of, "of")
  for _, row in ipairs(self) do
    if is_data(row) and (type(row[t.x]) ~= "number" or row[t.x] ~= row[t.x]) then
      core.fail(("column '%s' holds what is no number"):format(t.x), "x")
    end
  end
  return core.strict(bootstrap.peak(self, t.x, t.of, lattice_column(self, t.unit), t.resamples, t.seed, t.share),
    "the table of a peak")
end)

local rows_of

-- Equal, or a number as a script writes it and as it was computed: 0.3 and 3 * 0.1.
local function same(a, b)
  if a == b then return true end
  if type(a) ~= "number" or type(b) ~= "number" then return false end
  return math.abs(a - b) <= 1e-12 * math.max(math.abs(a), math.abs(b)) and math.abs(a) < math.huge
end

--- Those rows whose columns have the given values, to twelve digits.
Rows.where = core.wrap(function(self, wanted)
  if not core.is(self, Rows) then core.fail "is a method of rows: write rows:where { ... }, with a colon" end
  if type(wanted) ~= "table" then core.fail "takes a table of column = value" end
  wanted = core.plain(wanted)
  for column in pairs(wanted) do known_column(self, tostring(column)) end
  local list = {}
  for _, row in ipairs(self) do
    local alike = true
    for column, value in pairs(wanted) do alike = alike and same(row[column], value) end
    if alike then list[#list + 1] = row end
  end
  return rows_of(list, varied[self])
end)

--- Columns as files.
Rows.save = core.wrap(function(self, given)
  if not core.is(self, Rows) then core.fail "is a method of rows: write rows:save { ... }, with a colon" end
  local t = core.check("rows:save", given)
  if #t.columns == 0 then core.fail("'columns' is empty; name at least one", "columns") end
  local units, columns = outcomes.units(self[1] and core.peek(self[1], "units")), {}
  local named = {}
  for i, name in ipairs(t.columns) do
    known_column(self, name, "columns")
    if named[name] then core.fail(("'columns' names %s twice"):format(name), "columns") end
    named[name] = true
    columns[i] = { name = name, unit = unit_of(self, name) or units[name] or "" }
  end
  core.save_rows(t.name, columns, self)
end)

local function shown(value)
  if type(value) == "number" then return value == value and ("%.4g"):format(value) or "-" end
  return tostring(value)
end

--- One line a group: mean +- standard error (standard deviation), finished and failed samples.
function Summary:__tostring()
  local header = { table.unpack(self.by) }
  for _, column in ipairs(self.of) do
    local unit = self.units[column]
    header[#header + 1] = column .. (unit and unit ~= "" and " [" .. unit .. "]" or "") .. " +- se (sd)"
  end
  header[#header + 1], header[#header + 2] = "finished", "failed"
  local lines = { header }
  for _, line in ipairs(self) do
    local cells = {}
    for i, column in ipairs(self.by) do cells[i] = shown(line[column]) end
    for _, column in ipairs(self.of) do
      local s = line[column]
      local small = s.mean ~= 0 and math.abs(s.mean) < 0.01  -- four places would show next to nothing
      local cell = s.count == 0 and "-" or (small and "%.4g +- %s (%s)" or "%.4f +- %s (%s)"):format(s.mean,
        shown(s.se), shown(s.sd))
      -- The others have no such number: what is left may be no fair choice.
      if s.count < line.count then cell = ("%s of %d"):format(cell, s.count) end
      cells[#cells + 1] = cell
    end
    cells[#cells + 1], cells[#cells + 2] = tostring(line.count), tostring(line.failed)
    lines[#lines + 1] = cells
  end
  local widths = {}
  for _, cells in ipairs(lines) do
    for i, cell in ipairs(cells) do widths[i] = math.max(widths[i] or 0, #cell) end
  end
  local text = {}
  for _, cells in ipairs(lines) do
    local padded = {}
    for i, cell in ipairs(cells) do padded[i] = (" "):rep(widths[i] - #cell) .. cell end
    text[#text + 1] = table.concat(padded, "  ")
  end
  if self.over ~= "" then text[#text + 1] = "averaged over " .. self.over end
  return table.concat(text, "\n")
end

--- Prints it.
function Summary:print()
  if not core.is(self, Summary) then
    core.fail_here "print is a method of a summary: write summary:print(), with a colon"
  end
  print(tostring(self))
end

--- How many there are, what varies in them, and where to look for the rest.
function Rows:__tostring()
  local finished = 0
  for _, row in ipairs(self) do
    if core.peek(row, "status") == "finished" then finished = finished + 1 end
  end
  return ("%d rows, %d finished; rows[1] shows one, rows:summary { by = ..., of = { ... } } their means"):format(#self,
    finished)
end

function rows_of(list, of_sweep)
  varied[list] = of_sweep
  return setmetatable(list, Rows)
end

return { rows_of = rows_of, summarise = summarise, known_column = known_column, averaged = averaged, unit_of = unit_of }
