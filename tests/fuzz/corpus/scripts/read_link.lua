local ricochet = require "ricochet"
print(ricochet.file.read("link.txt"))
