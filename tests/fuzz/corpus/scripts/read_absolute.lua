local ricochet = require "ricochet"
print(ricochet.file.read("/etc/passwd"))
