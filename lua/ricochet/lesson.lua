-- ricochet.lesson: the impacts of a sweep as one page for a class. Here its words are checked and joined with numbers
-- of the rows; src/script/lesson.cpp makes the page, render/report/lesson.js shows it.
local core = require "ricochet.core"
local designs = require "ricochet.designs"
local known_column = require("ricochet.rows").known_column
local contents = require("ricochet.sweep").contents

local least_settings = 12
-- What the page's link says beside the sliders.
local names_in_link = { t = true, tried = true, nogl = true }

-- A value of a slider, as it is told and may be written in a text.
local function text_of(value) return type(value) == "number" and ("%.10g"):format(value) or tostring(value) end

-- Whether a text means a value: a number by what it is worth, to the digits that are told.
local function is_meant(value, text)
  if type(value) ~= "number" then return tostring(value) == text end
  local number = tonumber(text)
  return number ~= nil and (number == value or text_of(number) == text_of(value))
end

-- "height = 1, floor = stone"
local function place_of(row, names)
  local parts = {}
  for i, name in ipairs(names) do parts[i] = ("%s = %s"):format(name, tostring(row[name])) end
  return table.concat(parts, ", ")
end

-- Decimals of a number of which so many digits count.
local function decimals_of(value, digits)
  local size = value == 0 and 0 or math.floor(math.log(math.abs(value), 10) + 1e-12)
  return math.max(0, digits - 1 - size)
end

-- With so many decimals; without a sign if nothing is left of it.
local function shown(value, decimals)
  if type(value) ~= "number" then return tostring(value) end
  local text = ("%%.%df"):format(decimals):format(value)
  if not text:find "[1-9]" then text = text:gsub("^%-", "") end
  return (text:gsub("^%-", "−"))
end

-- A column of a row, as `field` of the lesson needs it.
local function cell(row, column, ...)
  known_column({ row }, column, ...)
  return row[column]
end

-- The rows of the grid of which the placeholder's conditions are true.
local function rows_meant(inner, lesson, fail)
  local rows, extreme = lesson.rows, nil
  local rest = inner:gsub("([%w_]+)%s*=%s*'([^']*)'", function(name, text)
    rows = lesson.filter(rows, name, text, fail)
    return ""
  end)
  for name, text in rest:gmatch "([%w_]+)%s*=%s*(%S+)" do
    if name == "greatest" or name == "least" then
      extreme = { sign = name == "greatest" and 1 or -1, column = text }
    else
      rows = lesson.filter(rows, name, text, fail)
    end
  end
  if not extreme then return rows end
  local best
  for _, row in ipairs(rows) do
    local value = cell(row, extreme.column, lesson.field)
    if type(value) ~= "number" then fail(("'%s' holds no numbers"):format(extreme.column)) end
    if value == value and (not best or extreme.sign * value > extreme.sign * best[extreme.column]) then best = row end
  end
  return best and { best } or {}
end

-- One placeholder's inside as the number it stands for: { text =, of =, hash = }.
local function number_of(inner, lesson)
  local function fail(what) core.fail(("{%s}: %s"):format(inner, what), lesson.field) end
  local column, digits, rest = inner:match "^%s*([%a_][%w_]*):?(%d*)(.*)$"
  if not column or rest:gsub("[%w_]+%s*=%s*'[^']*'", ""):gsub("[%w_]+%s*=%s*%S+", ""):match "%S" then
    fail "write a column and the values of the sliders: {e angle=60 floor='soft mat'}"
  end
  local rows = rows_meant(rest, lesson, fail)
  if #rows == 0 then fail "no setting is there" end
  if #rows > 1 then
    fail(("%d settings are there, the first two at %s and %s; say which"):format(#rows, place_of(rows[1], lesson.names),
      place_of(rows[2], lesson.names)))
  end
  local value = cell(rows[1], column, lesson.field)
  if value ~= value then fail("undefined at " .. place_of(rows[1], lesson.names)) end
  local text = lesson.texts(column, value)
    or shown(value, not tonumber(digits) and lesson.decimals[column] or decimals_of(value, tonumber(digits) or 3))
  return { text = text, of = column, value = value, hash = rows[1].scene_hash }
end

-- A text as its parts: strings, and numbers of the rows.
local function parts_of(text, lesson)
  local parts, at = {}, 1
  while at <= #text do
    local open = text:find("{", at, true) or #text + 1
    if open > at then parts[#parts + 1] = text:sub(at, open - 1) end
    if open > #text then break end
    local close = text:find("}", open, true)
    if not close then core.fail(("'{' is not closed: %.40s"):format(text:sub(open)), lesson.field) end
    parts[#parts + 1] = number_of(text:sub(open + 1, close - 1), lesson)
    at = close + 1
  end
  return parts
end

local function all_parts(texts, lesson)
  local list = {}
  for i, text in ipairs(texts) do list[i] = parts_of(text, lesson) end
  return list
end

-- The sliders as the page has them: label, unit, values and what stands for them.
local function sliders_of(t, grid)
  local sliders, seen = {}, {}
  for i, slider in ipairs(t.sliders) do
    local values = grid.over[slider.of]
    if not values then
      core.fail(("sliders[%d]: the grid varies no '%s'%s"):format(i, slider.of,
        core.did_you_mean(slider.of, grid.names)), "sliders")
    end
    if seen[slider.of] then core.fail(("sliders[%d]: '%s' has a slider before"):format(i, slider.of), "sliders") end
    if slider.texts and #slider.texts ~= #values then
      core.fail(("sliders[%d]: %d texts for the %d values of %s"):format(i, #slider.texts, #values, slider.of),
        "sliders")
    end
    if names_in_link[slider.of] then
      core.fail(("sliders[%d]: the page's link says something else by '%s'; take another name in 'over'"):format(i,
        slider.of), "sliders")
    end
    seen[slider.of] = true
    local texts = slider.texts or {}
    for k, value in ipairs(slider.texts and {} or values) do texts[k] = text_of(value) end
    sliders[i] = { of = slider.of, label = slider.label, unit = slider.unit or "", values = values, texts = texts }
  end
  for _, name in ipairs(grid.names) do
    if #grid.over[name] > 1 and not seen[name] then
      core.fail(("'%s' varies and has no slider"):format(name), "sliders")
    end
  end
  if #sliders > 3 then
    core.fail(("%d sliders; three are the most that a pupil can follow"):format(#sliders), "sliders")
  end
  return sliders
end

-- Where each row stands: the numbers (from 0) of its values along the sliders.
local function places_of(rows, sliders)
  local places = {}
  for i, row in ipairs(rows) do
    places[i] = {}
    for k, slider in ipairs(sliders) do
      for number, value in ipairs(slider.values) do
        if row[slider.of] == value then places[i][k] = number - 1 end
      end
    end
  end
  return places
end

-- Every setting has an impact of its own, which finished.
local function check_settings(rows, names)
  if #rows < least_settings then
    core.fail(("the grid has %d settings; a lesson has at least %d"):format(#rows, least_settings), "grid")
  end
  local of_hash = {}
  for _, row in ipairs(rows) do
    local where = place_of(row, names)
    if row.status ~= "finished" then
      core.fail(("the impact at %s ended %s: %s; each setting of a lesson must finish"):format(where, row.status,
        row.reason), "grid")
    end
    if of_hash[row.scene_hash] then
      core.fail(("the settings %s and %s are the same impact; leave out what changes nothing"):format(
        of_hash[row.scene_hash], where), "grid")
    end
    of_hash[row.scene_hash] = where
  end
end

local function results_of(t, rows)
  local results = {}
  for i, result in ipairs(t.results) do
    local values, most = {}, 0
    for k, row in ipairs(rows) do
      values[k] = cell(row, result.of, "results")
      if type(values[k]) ~= "number" then
        core.fail(("results[%d]: the column '%s' holds no numbers"):format(i, result.of), "results")
      end
      if values[k] == values[k] then most = math.max(most, math.abs(values[k])) end
    end
    results[i] = { of = result.of, label = result.label, unit = result.unit or "", values = values,
      decimals = decimals_of(most, result.digits or 3) }
  end
  return results
end

local function number_among(list, of, field)
  local names = {}
  for i, entry in ipairs(list) do
    if entry.of == of then return i end
    names[i] = entry.of
  end
  core.fail(("'of' is '%s', which is not among the results%s"):format(of, core.did_you_mean(of, names)), field, "of")
end

local function guess_of(t, results, rows, names)
  local guess = t.guess
  if not (guess.from < guess.to) then core.fail("'from' must be below 'to'", "guess", "from") end
  local number = number_among(results, guess.of, "guess")
  for i, value in ipairs(results[number].values) do
    if value ~= value then
      core.fail(("'%s' is undefined at %s, and cannot be guessed"):format(guess.of, place_of(rows[i], names)),
        "guess", "of")
    end
    if value < guess.from or value > guess.to then
      core.fail(("'%s' is %.4g at %s, outside of %g to %g"):format(guess.of, value, place_of(rows[i], names),
        guess.from, guess.to), "guess", value < guess.from and "from" or "to")
    end
  end
  return { question = guess.question, from = guess.from, to = guess.to, step = guess.step, result = number - 1 }
end

local function graph_of(t, sliders)
  local function slider_named(field)
    local names = {}
    for i, slider in ipairs(sliders) do
      if slider.of == t.graph[field] then return slider end
      names[i] = slider.of
    end
    core.fail(("'%s' is '%s', and no slider is of that name%s"):format(field, t.graph[field],
      core.did_you_mean(t.graph[field], names)), "graph", field)
  end
  local x = t.graph.x ~= "tries" and slider_named "x" or nil
  if t.graph.by and slider_named "by" == x then core.fail("'by' and 'x' are the same slider", "graph", "by") end
  if t.graph.log then
    for _, value in ipairs(x and x.values or { 0 }) do
      if type(value) ~= "number" or value <= 0 then
        core.fail("a logarithmic axis needs a slider of numbers above 0", "graph", "log")
      end
    end
  end
  return { x = t.graph.x, by = t.graph.by, log = t.graph.log or false }
end

-- What placeholders in texts look at: the rows, and how they are filtered.
local function reading(rows, names, sliders, results)
  local lesson = { rows = rows, names = names, decimals = {} }
  for _, result in ipairs(results) do lesson.decimals[result.of] = result.decimals end
  -- Values of sliders stand as the sliders have them.
  function lesson.texts(column, value)
    for _, slider in ipairs(sliders) do
      for k, known in ipairs(slider.values) do
        if slider.of == column and known == value then return slider.texts[k] end
      end
    end
  end
  function lesson.filter(among, name, text, fail)
    local list, known = {}, false
    for _, row in ipairs(rows) do known = known or is_meant(row[name], text) end
    if not known then fail(("no setting has %s = %s%s"):format(name, text, core.did_you_mean(name, names))) end
    for _, row in ipairs(among) do
      if is_meant(row[name], text) then list[#list + 1] = row end
    end
    return list
  end
  return lesson
end

local function words_of(t, grid, rows)
  local sliders = sliders_of(t, grid)
  check_settings(rows, grid.names)
  local results = results_of(t, rows)
  local lesson = reading(rows, grid.names, sliders, results)
  local function of(field, make, given)
    lesson.field = field
    return make(given, lesson)
  end
  local questions = {}
  for i, question in ipairs(t.questions) do
    questions[i] = { ask = of("questions", parts_of, question.ask),
      answer = of("questions", parts_of, question.answer) }
  end
  return {
    minutes = t.minutes, processor_time = t.processor_time, names = t.names, sliders = sliders,
    places = places_of(rows, sliders), results = results, guess = guess_of(t, results, rows, grid.names),
    graph = graph_of(t, sliders), questions = questions,
    intro = of("intro", all_parts, t.intro), teacher = of("teacher", all_parts, t.teacher),
    intuition = { wrong = of("intuition", parts_of, t.intuition.wrong),
      right = of("intuition", parts_of, t.intuition.right) },
  }
end

local function lesson(given)
  local t = core.check("lesson", given)
  local grid = contents(t.grid)
  if grid.by_error then core.fail("the grid chooses its samples by error; give it a list of all values", "grid") end
  designs.refuse_groups(grid.factors, "a lesson", "grid")
  if not grid.rows then core.fail("the grid has not run; call run() of the sweep first", "grid") end
  if #t.names ~= 2 then core.fail("takes two: { what flies, what it meets }", "names") end
  if core.is_check() then return end
  core.write_lesson(grid.name, t.name, t.title, words_of(t, grid, grid.rows), t.frames)
end

return { lesson = lesson }
