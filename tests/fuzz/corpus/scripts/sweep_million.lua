local ricochet = require "ricochet"
ricochet.sweep { name = "s", over = { a = ricochet.range(1e6) }, scene = function(at) return ricochet.scene { projectile = ricochet.disk { nodes = 60, seed = at.a }, target = ricochet.wall { nodes = 150, width = 4 } } end }:run()
