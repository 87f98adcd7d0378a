local ricochet = require "ricochet"
print(ricochet.file.read("../../secret.txt"))
