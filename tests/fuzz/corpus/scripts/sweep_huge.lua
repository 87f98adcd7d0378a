local ricochet = require "ricochet"
local r = ricochet.range(1e7)
ricochet.sweep { name = "s", over = { a = r, b = r, c = r }, scene = function() end }:run()
