local ricochet = require "ricochet"
ricochet.file.write("link.txt", "x")
