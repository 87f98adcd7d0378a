local ricochet = require "ricochet"
ricochet.sweep { name = "s", over = { a = {1} }, scene = function() while true do end end }:run()
