local ricochet = require "ricochet"
ricochet.file.write("../../evil.txt", "x")
