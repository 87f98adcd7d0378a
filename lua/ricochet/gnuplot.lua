-- Pictures by gnuplot: NAME.png and NAME.svg, and the script that drew them, NAME.gp.
local core = require "ricochet.core"

local gnuplot = {}

-- Colours that the colour-blind can tell apart [Okabe & Ito 2008].
gnuplot.colours = { "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9" }

--- A user's text as it is; a table, which may call anything when it is joined to another, is refused.
function gnuplot.text(text)
  if type(text) ~= "string" then core.fail(("takes texts for names and labels, one is a %s"):format(type(text))) end
  return text
end

--- A user's text, in single quotes: within double ones gnuplot runs what stands in backquotes as a shell command. An
--- apostrophe is a text of its own: doubled, as gnuplot's manual has it, none could begin a text.
function gnuplot.quoted(text)
  return "'" .. gnuplot.text(text):gsub("%c", " "):gsub("'", [[' . "\047" . ']]) .. "'"
end

local Script = {}
Script.__index = Script

--- A script to be written, of a picture that is called `name`.
function gnuplot.script(name)
  if not name:match "^[%w_%-]+$" then
    core.fail(("'name' must be letters, digits, _ and -, is '%s'"):format(name), "name")
  end
  return setmetatable({ name = name, lines = {} }, Script)
end

--- Adds a line; with values, as text:format(...) has it.
function Script:add(text, ...)
  self.lines[#self.lines + 1] = select("#", ...) > 0 and text:format(...) or text
end

--- Adds a block of data that plots name as $name; each row is a text of its cells.
function Script:data(name, rows)
  self:add("$%s << END", name)
  for _, row in ipairs(rows) do self:add(row) end
  self:add "END"
end

-- Grey lines behind all else, and axes on two sides.
local plain = 'set encoding utf8\nset grid lt 1 lw 0.5 lc rgb "#cccccc"\nset tics nomirror\nset border 3'

--- Draws t.count panels below each other under t.title (as gnuplot has it), t.width by t.height pixels, once for each
--- kind of file. t.key: where the key stands; t.axes: lines about the axes; t.draw adds what the panels plot. With
--- t.panel, their height, there are lines t.below under them, and t.draw gets a function that begins panel i.
function Script:panels(t)
  local under = t.panel and 16 * #t.below + 14 or 0
  local height = t.panel and under + t.count * t.panel + (t.has_title and 36 or 10) or t.height
  self:add(plain .. "\nset key " .. t.key)
  if t.axes then self:add(t.axes) end
  for _, kind in ipairs { { "pngcairo", "png", "" }, { "svg", "svg", ' background "white"' } } do
    self:add('set terminal %s size %d,%d font "DejaVu Sans,%d"%s', kind[1], t.width, height, t.font, kind[3])
    self:add("set output %s", gnuplot.quoted(self.name .. "." .. kind[2]))
    if t.panel then
      self:add("set multiplot title %s noenhanced", t.title)
      t.draw(function(i)
        self:add("set size 1,%.6g\nset origin 0,%.6g", t.panel / height, (under + (t.count - i) * t.panel) / height)
        -- The lines below belong to the first panel: set once, they would be drawn by each.
        for k, line in ipairs(i == 1 and t.below or {}) do
          self:add("set label %d %s at screen 0.02,%.6g left font ',10' noenhanced", 100 + k, gnuplot.quoted(line),
            (under - 16 * k + 6) / height)
        end
        if i == 2 then for k in ipairs(t.below) do self:add("unset label %d", 100 + k) end end
      end)
      if t.count == 1 then for k in ipairs(t.below) do self:add("unset label %d", 100 + k) end end
    else
      self:add("set multiplot layout %d,1 title %s noenhanced", t.count, t.title)
      t.draw()
    end
    self:add "unset multiplot"
  end
end

--- Writes the script and lets gnuplot draw it.
function Script:draw()
  core.gnuplot(self.name, table.concat(self.lines, "\n") .. "\n")
end

return gnuplot
