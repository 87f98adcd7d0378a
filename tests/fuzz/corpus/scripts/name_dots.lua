local ricochet = require "ricochet"
ricochet.sweep { name = "../../evil", over = { a = {1} }, scene = function() end }:run()
